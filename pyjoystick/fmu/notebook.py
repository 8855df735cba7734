"""Display of FMUs and batches in notebooks, as text."""

from __future__ import annotations

from functools import singledispatch
from typing import Final

import numpy as np

from pyjoystick.fmu.batch import BatchResult
from pyjoystick.fmu.cosimulation import Fmu
from pyjoystick.fmu.description import Variable
from pyjoystick.support import TextTable

_KINDS: Final = ("input", "output", "parameter")
_HEADER: Final = ("name", "start", "unit", "description")
#: Maximum number of failed runs that are listed.
_NAMED: Final = 5


@singledispatch
def summary(one: object) -> str:
    """Markdown that is also readable as plain text."""
    raise TypeError(type(one))


@summary.register
def _(one: Fmu) -> str:
    description = one.description
    title = f"**{description.model_name}**: {description.description}" if description.description else ""
    facts = f"{description.path.name}, FMI {description.fmi_version}, {', '.join(description.interfaces)}"
    tool = f"; made by {description.generation_tool}" if description.generation_tool else ""
    parts = [title or f"**{description.model_name}**", f"{facts}{tool}."]
    for kind in _KINDS:
        rows = [_row(description.variables[name]) for name in description.names(kind)]
        if rows:
            parts += [f"{kind.capitalize()}s:", TextTable(_HEADER, rows).markdown()]
    others = [
        name for name in description.settable_names() if description.variables[name].causality not in _KINDS
    ]
    if others:
        parts.append(f"Start values: {', '.join(others)}.")
    return "\n\n".join(parts)


@summary.register
def _(one: BatchResult) -> str:
    runs, failed = len(one.done), np.flatnonzero(one.failed)
    parts = [f"{int(np.sum(one.done))} of {runs} runs done, {len(failed)} failed."]
    if one.interrupted:
        parts[0] += " The batch was stopped."
    parts += [f"- run {one.parameters.index[i]}: {one.messages[i]}" for i in failed[:_NAMED]]
    if one.reduced is not None and len(one.reduced.columns):
        units = one.reduced.attrs.get("units", {})
        rows = [
            [
                str(name),
                *(f"{number:.6g}" for number in (column.min(), column.mean(), column.max())),
                units.get(name, ""),
            ]
            for name, column in one.reduced.items()
        ]
        parts += ["", TextTable(("result", "smallest", "mean", "largest", "unit"), rows).markdown()]
    return "\n".join(parts)


def _row(variable: Variable) -> list[str]:
    unit = variable.unit if variable.unit != "1" else ""
    return [variable.name, variable.start or "", unit, variable.description.replace("|", "\\|")]
