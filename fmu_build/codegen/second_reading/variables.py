"""Compare the variables that rumoca makes, and their dimensions, with those of the source."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from contextlib import suppress
from typing import Final

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.givens import NOTHING, Scope, around, joined, plain
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.syntax import Tokens

_DEEPEST: Final = 50


def mistaken_variables(model: LoweredModel, instances: Variables) -> Iterator[str]:
    """Yield the variables that are lost, that should not be there, or have other dimensions.

    rumoca keeps some arrays of components as components of arrays, which are not compared.
    """
    flat = model.flat["variables"]
    for name, leaf in instances.leaves.items():
        if name not in flat and plain(name) not in flat:
            yield f"the variable {name} is lost"
        elif name in flat and tuple(flat[name]["dims"]) != leaf.sizes:
            found, meant = (list(one) or "no dimensions" for one in (flat[name]["dims"], leaf.sizes))
            yield f"the sizes of {name} are {found} instead of {meant}"
    for name in flat:
        if name not in instances.leaves and not flat[name]["dims"]:
            yield from _not_meant(instances, name)


def _not_meant(instances: Variables, name: str) -> Iterator[str]:
    """Yield why there should be no variable of this name, if that is known."""
    paths = ["", *around(name), name]
    for outer, path in itertools.pairwise(paths):
        if outer not in instances.parts:
            return
        declared, _, subscripts = path.rpartition("[") if path.endswith("]") else (path, "", "")
        if declared in instances.absent:
            yield f"{name} should not be there, because the condition of {declared} is false"
        elif declared in instances.sizes and not _is_element(instances.sizes[declared], subscripts):
            meant = list(instances.sizes[declared])
            yield f"{name} should not be there, because the sizes of {declared} are {meant}"
        elif instances.dimensions.get(declared) and not subscripts and path != name:
            yield f"the array {declared} has become a single component, because its size is not evaluated"
        elif declared not in instances.sizes and subscripts and _is_ambiguous_size(instances, declared):
            yield f"the size of {declared} would be read from another variable of the same name"
        else:
            continue
        return


def _is_element(sizes: tuple[int, ...], subscripts: str) -> bool:
    """Return whether an array of components has an element, if the subscripts are those of all dimensions."""
    places = [int(one) for one in subscripts.rstrip("]").split(",")] if subscripts else []
    return len(places) == len(sizes) and all(
        1 <= place <= size for place, size in zip(places, sizes, strict=True)
    )


def _is_ambiguous_size(instances: Variables, path: str) -> bool:
    """Return whether a size of a component follows a qualified name that ends as a name of its class.

    This is so in ``A a; parameter Integer n = 3; S s[a.n]``.
    """
    with suppress(UnknownError):
        return any(_is_ambiguous(instances, *size, 0) for size in instances.dimensions.get(path, ()))
    return False


def _is_ambiguous(instances: Variables, tokens: Tokens, scope: Scope, depth: int) -> bool:
    own = instances.library.components(scope.around)
    for before, token, after in zip(("", *tokens), tokens, (*tokens[1:], ""), strict=False):
        if before == "." and after not in (".", "(") and token in own:
            return True
        leaf = instances.leaves.get(joined(scope.path, token))
        is_plain = "." not in (before, after) and depth < _DEEPEST
        given = leaf.given if leaf is not None and is_plain else NOTHING
        if given.scope is not None and _is_ambiguous(instances, given.value, given.scope, depth + 1):
            return True
    return False
