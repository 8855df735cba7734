"""Identify the Modelica function that each call site of the Solve IR calls.

The Solve IR identifies the callee only by the number of the call site. rumoca numbers the sites in the
order in which it visits the calls in the equations of the DAE, outer calls before those in their arguments.
The sorted sites in the programs of one equation therefore match the calls in the equation's expressions in
that order. Some calls have no site: rumoca evaluates constant ones and writes out small functions. A match is
accepted only if signatures and constancy leave no other function for a site.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from fmu_build.codegen.lowered import LoweredModel

_SpanKey = tuple[int, int, int]
_REFERENCES = ("residual", "bodies", "expression", "message")


@dataclass(frozen=True, slots=True)
class _Site:
    """A call site: its number, its shapes, and whether its arguments are constants, if that is known."""

    owner: int
    shapes: Mapping[str, Any]
    is_constant: bool | None


class CallSites:
    """Maps the call sites of one model to functions."""

    def __init__(self, model: LoweredModel) -> None:
        self._model = model
        self._functions = {function["id"]: function for function in model.dae["functions"]}
        self._expressions = {expression["id"]: expression for expression in model.dae["expressions"]}
        self._types = [entry["value_type"] for entry in model.dae["value_types"]]
        relations = model.dae["systems"]["conditions"]["relations"]
        self._relations = {relation["expression"] for relation in relations}
        self._found = self._match_all()

    def function_of(self, site: Mapping[str, Any], span: dict[str, int] | None) -> int:
        """Return the id of the function; raises `UnsupportedModelError` if it is ambiguous."""
        found = self._found.get(site["owner"])
        if found is not None:
            return found
        called: set[int] = {call["function"] for call in self._all_calls()}
        # Functions that no equation calls come from differentiation: rumoca calls the function in an
        # annotation.
        for those in (called, self._functions.keys() - called):
            fitting = {number for number in those if self._fits(number, site)}
            if len(fitting) == 1:
                return fitting.pop()
            if fitting:
                break
        names = sorted({self._functions[number]["name"] for number in fitting})
        what = f"one of {', '.join(names)}" if names else "none of the model's functions"
        raise self._model.unsupported(f"a function call that cannot be identified: it fits {what}", span)

    def _match_all(self) -> dict[int, int]:
        """Return {number of the call site: id of the function} for all equations whose call sites match."""
        roots = self._roots_by_span()
        found: dict[int, int] = {}
        for span, sites in self._sites_by_span().items():
            calls = [self._expressions[call] for call in self._calls_below(roots.get(span, []))]
            ordered = [sites[owner] for owner in sorted(sites)]
            for site, functions in zip(ordered, self._candidates(ordered, calls), strict=True):
                if len(functions) == 1:
                    found[site.owner] = functions.pop()
        return found

    def _candidates(self, sites: Sequence[_Site], calls: Sequence[Mapping[str, Any]]) -> list[set[int]]:
        """Return the functions that each site can call if the sites are in the order of the calls."""
        fits = [[k for k, call in enumerate(calls) if self._can_be(site, call)] for site in sites]
        first, last = _earliest(fits), _latest(fits, len(calls))
        if any(low > high for low, high in zip(first, last, strict=True)):
            return [set() for _ in sites]
        return [
            {calls[k]["operation"]["function"] for k in row if low <= k <= high}
            for row, low, high in zip(fits, first, last, strict=True)
        ]

    def _can_be(self, site: _Site, call: Mapping[str, Any]) -> bool:
        """Return whether shapes and constancy agree; rumoca substitutes constants for some parameters."""
        possible = {True: ("constant", "parameter"), False: ("parameter", "discrete", "continuous")}
        return self._fits(call["operation"]["function"], site.shapes) and (
            site.is_constant is None or call["variability"] in possible[site.is_constant]
        )

    def _sites_by_span(self) -> dict[_SpanKey, dict[int, _Site]]:
        sites: dict[_SpanKey, dict[int, _Site]] = {}
        for table in _tables(self._model.solve):
            for program, span in zip(table["programs"], table.get("program_spans") or [], strict=False):
                if span is not None:
                    for site in _sites(program):
                        sites.setdefault(_key(span), {})[site.owner] = site
        return sites

    def _roots_by_span(self) -> dict[_SpanKey, list[int]]:
        """Return the root expressions at each source span, in the order of the DAE."""
        roots: dict[_SpanKey, list[int]] = {}
        for entry in _placed(self._model.dae["systems"]):
            for name in _REFERENCES:
                value = entry.get(name)
                if value is not None:
                    roots.setdefault(_key(entry["provenance"]["span"]), []).extend(
                        value if isinstance(value, list) else [value]
                    )
        for variable in self._model.dae["variables"]:
            attributes = variable["attributes"]
            value = attributes["start"] if attributes["binding"] is None else attributes["binding"]
            if value is not None:
                roots.setdefault(_key(variable["declaration"]["span"]), []).append(value)
        return roots

    def _calls_below(self, roots: Sequence[int]) -> list[int]:
        """Return the calls in the roots, outer calls first; a call with several results counts once."""
        calls: list[int] = []
        seen: set[int] = set()
        met: set[tuple[int, tuple[int, ...]]] = set()

        def visit(number: int, is_root: bool) -> None:
            if number in seen or (number in self._relations and not is_root):
                return  # the equation reads the memory of the relation, which has its own row
            seen.add(number)
            operation = self._expressions[number]["operation"]
            if operation["kind"] == "call":
                call = (operation["function"], tuple(operation["arguments"]))
                if call not in met:
                    met.add(call)
                    calls.append(number)
            for operand in operands(operation):
                visit(operand, is_root=False)

        for root in roots:
            visit(root, is_root=True)
        return calls

    def _all_calls(self) -> Iterator[Mapping[str, Any]]:
        for expression in self._expressions.values():
            if expression["operation"]["kind"] == "call":
                yield expression["operation"]

    def _fits(self, number: int, site: Mapping[str, Any]) -> bool:
        """Return whether the inputs and results of the function have the shapes of the call site."""
        function = self._functions[number]
        inputs = [self._dimensions(parameter["value_type"]) for parameter in function["parameters"]]
        results = [list(shape) for kind in function["result_types"] for shape in shapes(self._types, kind)]
        given = [
            output["value_type"]["dimensions"] for output in site["outputs"] if output["kind"] == "result"
        ]
        return inputs == [value["dimensions"] for value in site["inputs"]] and results == given

    def _dimensions(self, kind: int) -> list[int]:
        return list(self._types[kind]["dimensions"])


def shapes(types: Sequence[Mapping[str, Any]], kind: int) -> list[tuple[int, ...]]:
    """Return the array sizes of a value of a type or, for a record, of all its fields."""
    fields = types[kind]["record_fields"]
    if types[kind]["scalar"] != "record":
        return [tuple(types[kind]["dimensions"])]
    return [shape for field in fields for shape in shapes(types, field["value_type"])]


def operands(operation: Mapping[str, Any]) -> Iterator[int]:
    """Yield the direct operands of an operation of the DAE in source order."""
    for name in ("operand", "lhs", "rhs", "base", "body", "value"):
        if isinstance(operation.get(name), int) and operation["kind"] != "function_value":
            yield operation[name]
    for name in ("operands", "arguments", "elements", "fields"):
        yield from operation.get(name, ())
    for subscript in operation.get("subscripts", ()):
        if "expression" in subscript:
            yield subscript["expression"]
    for name in ("start", "explicit_step", "stop"):
        bound = operation.get(name)
        if isinstance(bound, dict) and bound["expression"] is not None:
            yield bound["expression"]


def _tables(tree: Any) -> Iterator[Mapping[str, Any]]:
    """Yield every table of programs except those of derivatives, whose call sites are numbered separately."""
    if isinstance(tree, dict):
        if "programs" in tree and "program_spans" in tree:
            yield tree
        for name, child in tree.items():
            if name != "artifacts":
                yield from _tables(child)
    elif isinstance(tree, list):
        for child in tree:
            yield from _tables(child)


def _earliest(rows: Sequence[Sequence[int]]) -> list[int]:
    """For each row, return the smallest member above the previous choice; beyond all members if none is."""
    found: list[int] = []
    for row in rows:
        found.append(next((k for k in row if not found or k > found[-1]), sys.maxsize))
    return found


def _latest(rows: Sequence[Sequence[int]], end: int) -> list[int]:
    """For each row, return the largest member below the one chosen for the next row; -1 if there is none."""
    mirrored = [[end - k for k in reversed(row)] for row in reversed(rows)]
    return [end - k if k < sys.maxsize else -1 for k in reversed(_earliest(mirrored))]


def _sites(tree: Any) -> Iterator[_Site]:
    """Yield the call sites in a program, including its conditional parts."""
    if isinstance(tree, dict):
        tree = list(tree.values())
    if not isinstance(tree, list):
        return
    constancy: dict[int, bool | None] = {}
    for part in tree:
        kind, fields = next(iter(part.items())) if isinstance(part, dict) and len(part) == 1 else ("", part)
        if kind == "PureCall":
            site = fields["site"]
            given = [
                constancy.get(start + i)
                for start, value in zip(fields["input_starts"], site["inputs"], strict=True)
                for i in range(value["scalar_count"])
            ]
            yield _Site(site["owner"], site, _all_constant(given))
            count = sum(output["value_type"]["scalar_count"] for output in site["outputs"])
            first = fields["dst_start"]
            constancy.update(dict.fromkeys(range(first, first + count), _all_constant(given)))
        elif kind in ("Const", "LoadY", "LoadP", "LoadTime"):
            constancy[fields["dst"]] = kind == "Const"
        elif kind in ("Unary", "Binary", "Compare"):
            read = [constancy.get(fields[name]) for name in ("arg", "lhs", "rhs") if name in fields]
            constancy[fields["dst"]] = _all_constant(read)
        else:
            yield from _sites(fields)


def _all_constant(parts: Sequence[bool | None]) -> bool | None:
    """Return whether a value computed from these parts is constant; None if that is not known."""
    return False if False in parts else None if None in parts else True


def _placed(tree: Any) -> Iterator[Mapping[str, Any]]:
    if isinstance(tree, dict):
        if isinstance(tree.get("provenance"), dict) and tree["provenance"].get("span"):
            yield tree
        tree = list(tree.values())
    if isinstance(tree, list):
        for child in tree:
            yield from _placed(child)


def _key(span: Mapping[str, int]) -> _SpanKey:
    return span["source"], span["start"], span["end"]
