"""Array comprehensions whose iterator rumoca replaces by the position 1, 2, ... whatever the range is.

This happens to arrays that come from a modifier, and to arrays of records.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from fmu_build.codegen.modelica_source.clauses import (
    COMPONENT_CLAUSE,
    EXTENSION_CLAUSE,
    NAME,
    component_clauses,
)
from fmu_build.codegen.modelica_source.constructs import Construct, ModelText


def miscounted_comprehensions(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield an explanation and the clause of each affected comprehension in a modifier or record value."""
    for clause in text.find([COMPONENT_CLAUSE]):
        for component in component_clauses(clause.plain):
            value = component.value if component.type in text.records else ""
            for iterators in (*_miscounted(component.modifiers), *_miscounted(value)):
                yield _explanation(iterators), clause
    for clause in text.find([rf"{EXTENSION_CLAUSE}\("]):
        for iterators in _miscounted(clause.plain[clause.plain.index("(") :]):
            yield _explanation(iterators), clause


def _explanation(iterators: str) -> str:
    return (
        f"for {iterators} may count from 1 here, in an array that comes from a modifier or holds records; "
        "write the array out, or with one iterator whose range is 1:n"
    )


def _miscounted(modifiers: str) -> Iterator[str]:
    """Yield the iterators of comprehensions, not of reductions such as ``sum(...)``, that do not count up."""
    for found in re.finditer(r"\bfor\b", modifiers):
        end = _end(modifiers, found.end())
        if modifiers[end : end + 1] == "}":
            iterators = modifiers[found.end() : end].strip()
            if not re.fullmatch(rf"{NAME}(?:\s+in\s+1\s*:[^:,]*)?", iterators):
                yield iterators


def _end(text: str, start: int) -> int:
    """Return the position of the bracket that closes the innermost one open at `start`."""
    depth = 0
    for place in range(start, len(text)):
        depth += {"(": 1, "[": 1, "{": 1, ")": -1, "]": -1, "}": -1}.get(text[place], 0)
        if depth < 0:
            return place
    return len(text)
