"""A second reading of the model's source, with which everything that rumoca makes of it is compared.

`check` is the entrance. It leans on, from the ground up:

- reading texts: `syntax` (classes), `sections` (equations and statements), `expressions`;
- names: `scopes` (classes), `lookup` (in components), `redeclarations`, `functions`;
- variables: `givens` (modifiers), `record_values`, `known_variables`, `instances`, which finds them all;
- values: `operations`, `arithmetic`, `gathered` (components), `points` (random values of all variables),
  `records` and `called_functions`;
- comparisons: `agreement`, of a text (`residuals`, `clause_values`) with rumoca's tree (`compiled_values`),
  for `values`, `equations`, `clauses` and `function_bodies`; `variables`, `connections` and `packages` by
  names; `captures` and `invalid` for what the others cannot see;
- results: `carried_out` (functions), `moments` (the values of an FMU), `results`, the second entrance, which
  finds whatever goes wrong after all of these.

`UnknownError` means "not known" everywhere: no guess is compared.
"""
