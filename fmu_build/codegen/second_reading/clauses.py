"""Compare rumoca's when-clauses, assertions and algorithms with those of the classes in the source."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any, Final

from fmu_build.codegen.compiled import Span, expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.equations import mistaken_names, mistaken_numbers
from fmu_build.codegen.second_reading.givens import Scope
from fmu_build.codegen.second_reading.instances import Instances, around
from fmu_build.codegen.second_reading.sections import When, statements
from fmu_build.codegen.second_reading.syntax import Class

Difference = tuple[str, Span]
_OF_COMPONENT: Final = "algorithm from "


def mistaken_clauses(model: LoweredModel, instances: Instances) -> Iterator[Difference]:
    """Yield what is wrong with when-clauses, assertions and algorithms, and where these stand."""
    for kind in ("assert_equations", "initial_assert_equations", "algorithms", "initial_algorithms"):
        for one in model.flat[kind]:
            if one["span"]["source"] in model.sources:
                yield from _names(model, instances, one)
    yield from _when_clauses(model, instances)


def _names(model: LoweredModel, instances: Instances, one: Mapping[str, Any]) -> Iterator[Difference]:
    """Yield the names in an assertion or algorithm that mean variables of another component."""
    origin = one["origin"]
    if isinstance(origin, str):
        path = origin.removeprefix(_OF_COMPONENT) if origin.startswith(_OF_COMPONENT) else ""
    else:
        path = next(expressions(origin, "ComponentEquation"), {}).get("component", "")
    part = instances.parts.get(path)
    for owner in part.classes if part is not None else ():
        if owner.contains(*_place(model, one["span"])):
            for check in (mistaken_names, mistaken_numbers):
                for difference in check(model, instances, Scope(path, owner), dict(one)):
                    yield difference, one["span"]


def _place(model: LoweredModel, span: Span) -> tuple[int, int]:
    """Return the number of the file and the offset at which something stands."""
    return span["source"], model.offset(span)


def _when_clauses(model: LoweredModel, instances: Instances) -> Iterator[Difference]:
    """Yield when-clauses that are lost, or with variables of more than one component."""
    paths = defaultdict(list)
    for path, part in instances.parts.items():
        for owner in part.classes:
            paths[id(owner)].append((path, owner))
    found: dict[str, list[tuple[int, int]]] = defaultdict(list)
    chains = (one for one in model.flat["when_chains"] if one["span"]["source"] in model.sources)
    for chain in chains:
        place = _place(model, chain["span"])
        possible = [one for owners in paths.values() for one in owners if one[1].contains(*place)]
        scopes = [Scope(path, owner) for path, owner in possible]
        scopes = [scope for scope in scopes if _is_of(model, instances, scope, chain)]
        own = [scope.path for scope in scopes]
        if len(scopes) == 1:
            for difference in mistaken_numbers(model, instances, scopes[0], dict(chain)):
                yield difference, chain["span"]
        if possible and not own and _is_known(instances, chain):
            yield f"a when-clause of {possible[0][1].name} has variables of another component", chain["span"]
        for path in own:
            found[path].append(place)
    for path, owner in (one for owners in paths.values() for one in owners):
        yield from _lost(model, Scope(path, owner), found[path])


def _lost(model: LoweredModel, scope: Scope, found: Sequence[tuple[int, int]]) -> Iterator[Difference]:
    """Yield the when-clauses of a component that are not at these places."""
    owner = scope.around
    for start, end in _of_class(owner):
        if not any(file == owner.file and start <= place < end for file, place in found):
            where = f" of {scope.path}" if scope.path else ""
            yield f"a when-clause{where} is lost", model.span(owner.file, start, end)


def _is_known(instances: Instances, chain: Mapping[str, Any]) -> bool:
    """Return whether all components are known whose variables a when-clause has."""
    names = {one["name"]["name"] for one in expressions(dict(chain), "VarRef")} - {"time"}
    names |= {one["target"] for one in expressions(dict(chain), "Assign")}
    return all(["", *around(name)][-1] in instances.parts for name in names)


def _of_class(owner: Class) -> Iterator[tuple[int, int]]:
    """Yield the places of the when-clauses of a class that are neither in branches nor in loops."""
    with suppress(SyntaxError):
        for section in owner.sections:
            for one in statements(section):
                if isinstance(one, When):
                    yield one.start, one.end


def _is_of(model: LoweredModel, instances: Instances, scope: Scope, chain: Mapping[str, Any]) -> bool:
    """Return whether a when-clause may be that of a component: all its names mean variables there."""
    prefix = f"{scope.path}." if scope.path else ""
    targets = [one["target"] for one in expressions(dict(chain), "Assign")]
    return all(target.startswith(prefix) for target in targets) and not any(
        mistaken_names(model, instances, scope, dict(chain))
    )
