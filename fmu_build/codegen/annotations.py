"""The class annotations that rumoca does not hand on, read from the Modelica source."""

from __future__ import annotations

import re

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.description import DefaultExperiment
from fmu_build.source_text import STRING, blanked

_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}


def default_experiment(model: LoweredModel) -> DefaultExperiment:
    """The ``experiment`` annotation; what it leaves out keeps the runtime's default."""
    match = re.search(r"\bexperiment\s*\(([^()]*)\)", _class_text(model, keep_strings=False))
    settings = dict(re.findall(r"(\w+)\s*=\s*([-+.\deE]+)", match.group(1))) if match else {}
    defaults = DefaultExperiment()
    return DefaultExperiment(
        start_time=float(settings.get("StartTime", defaults.start_time)),
        stop_time=float(settings.get("StopTime", defaults.stop_time)),
        tolerance=float(settings.get("Tolerance", defaults.tolerance)),
        step_size=float(settings.get("Interval", defaults.step_size)),
    )


def documentation(model: LoweredModel) -> str:
    """The HTML of the ``Documentation`` annotation, an empty string where there is none."""
    text = _class_text(model, keep_strings=True)
    match = re.search(rf"\bDocumentation\s*\(\s*info\s*=\s*({STRING})", text, re.DOTALL)
    if match is None:
        return ""
    return re.sub(
        r"\\(.)", lambda m: _ESCAPES.get(m.group(1), m.group(1)), match.group(1)[1:-1], flags=re.DOTALL
    )


def _class_text(model: LoweredModel, keep_strings: bool) -> str:
    """The source of the model's class, from its keyword to its end."""
    parent, _, name = model.name.rpartition(".")
    begin = re.compile(rf"\b(?:model|block|class)\s+{re.escape(name)}\b")
    end = re.compile(rf"\bend\s+{re.escape(name)}\s*;")
    enclosing = re.compile(
        rf"\b(?:within\s+(?:[\w.]+\.)?|package\s+){re.escape(parent.rpartition('.')[2])}\b"
    )
    for _, _, text in model.source_files:
        blank = blanked(text)
        first, last = begin.search(blank), end.search(blank)
        if first and last and (not parent or enclosing.search(blank)):
            return (text if keep_strings else blank)[first.start() : last.end()]
    return ""
