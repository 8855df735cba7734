"""The description of an FMU as JSON."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.support import document_text


def description_json(description: FmuDescription, notes: Sequence[str] = ()) -> str:
    """The model, interfaces, platforms and all variables of an FMU as JSON text."""
    content = {
        "fmu": description.identity,
        "about": description.description,
        "fmi_version": description.fmi_version,
        "interfaces": list(description.interfaces),
        "platforms": description.platforms,
        "sources": description.has_sources,
        "experiment": dataclasses.asdict(description.experiment),
        "variables": [_variable(one) for one in description.variables.values()],
    }
    return document_text("info", content, notes)


def _variable(variable: Variable) -> dict[str, Any]:
    return {
        "name": variable.name,
        "type": variable.type,
        "causality": variable.causality,
        "variability": variable.variability,
        "unit": variable.unit,
        "start": _start(variable),
        # A tiny minimum stands for "above 0", which FMI cannot express.
        "minimum": 0.0 if variable.must_be_positive else variable.minimum,
        "exclusive_minimum": variable.must_be_positive,
        "maximum": variable.maximum,
        "description": variable.description,
    }


def _start(variable: Variable) -> float | str | None:
    """A number if possible, with integers exact; text, Booleans and arrays as written in the file."""
    if variable.start is None or variable.type in ("String", "Boolean"):
        return variable.start
    for kind in (int, float):
        with suppress(ValueError):
            return kind(variable.start)
    return variable.start
