"""Compare the values and start values of a model's variables with a second reading of its source."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import suppress
from typing import Any, Final

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.arithmetic import UnknownError, Value
from fmu_build.codegen.second_reading.instances import Instances, Leaf
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.support.errors import ModelicaError

_ROUNDING: Final = 1e-9


def reject_other_values(model: LoweredModel) -> None:
    """Raise an error for the first variable to which rumoca gives another value than the source.

    Raises:
        ModelicaError: a modifier names what does not exist, or changes what is final
        UnsupportedModelError: a modifier is lost or misplaced
    """
    try:
        instances = Instances(Library(text for _, text in model.sources.values()), model.name)
    except (SyntaxError, UnknownError):
        return  # The checks that look for single constructs remain.
    for mistake in instances.mistakes:
        raise ModelicaError(f"{model.name}: {mistake}")
    for variable in model.dae["variables"]:
        leaf = instances.leaves.get(variable["name"])
        if leaf is not None:
            for what, found, meant in _differences(instances, leaf, variable):
                raise model.unsupported(
                    f"the compiler gives {variable['name']} the {what} {found:g}, but the source says "
                    f"{meant:g}: a modifier is lost or misplaced; declare the value in a class of its own",
                    variable["declaration"]["span"],
                )


def _differences(
    instances: Instances, leaf: Leaf, variable: dict[str, Any]
) -> Iterator[tuple[str, float, float]]:
    attributes = variable["attributes"]
    compared = []
    if leaf.is_constant and leaf.given.value:
        compared.append(("value", leaf.given, attributes["binding_values"]))
    elif "start" in leaf.given.inner:
        compared.append(("start value", leaf.given.inner["start"], attributes["start_values"]))
    for what, given, found in compared:
        with suppress(UnknownError):
            meant = _flat(instances.value(given))
            if found and len(meant) in (1, len(found)):
                pairs = zip(found, meant if len(meant) > 1 else meant * len(found), strict=True)
                yield from ((what, a, b) for a, b in pairs if not math.isclose(a, b, rel_tol=_ROUNDING))


def _flat(value: Value) -> list[float]:
    return [one for element in value for one in _flat(element)] if isinstance(value, list) else [value]
