"""The page: one HTML file that needs no network and may run only its own script."""

from __future__ import annotations

import base64
import gzip
import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, replace
from html import escape
from importlib import resources
from pathlib import Path
from typing import Any

from fmu_build.explore.addition import Addition
from fmu_build.explore.bundle import bundle
from fmu_build.explore.model import MOST_ROWS, PageModel, PageVariable, page_model, run_length
from fmu_build.explore.settings import PlotChoice, Settings
from fmu_build.packaging import wasm_module
from fmu_build.support.errors import BuildError

_ASSETS = Path(str(resources.files("fmu_build"))) / "explore" / "assets"
#: Default number of curves per plot; the user may add more.
_MOST_CURVES = 6


def explore_page(fmu: Path, settings: Settings | None = None, addition: Addition | None = None) -> str:
    """Return the page for an FMU of this project: HTML with module, script and style embedded.

    Args:
        fmu: FMU with FMI 2 Co-Simulation
        settings: what the page shows; everything not set is derived from the FMU
        addition: extensions by another package

    Raises:
        BuildError: the FMU cannot be read, has no module and no sources to build one from, or lacks a
            variable that the settings name
    """
    settings = settings or Settings()
    model = _with_settings(page_model(fmu), settings)
    stop, step = run_length(
        model.start_time, settings.stop_time or model.stop_time, settings.step or model.step
    )
    data = {
        "title": settings.title or model.name.rpartition(".")[2],
        "model": model.name,
        "text": model.text,
        "experiment": {
            "start": model.start_time,
            "stop": stop,
            "step": step,
            "tolerance": model.tolerance,
        },
        "most_rows": MOST_ROWS,
        "variables": [_compact(asdict(one)) for one in model.variables],
        "tables": model.tables if settings.input_tables else {},
        "first": settings.first or _first(model),
        "plots": [asdict(plot) for plot in settings.plots or _plots(model)],
        "presets": [asdict(preset) for preset in settings.presets],
        "addition": addition.data if addition else None,
    }
    folders = [*([addition.assets] if addition else []), _ASSETS]
    style = "\n".join(file.read_text("utf-8") for folder in reversed(folders) for file in _styles(folder))
    script = bundle(addition.entry if addition else "main", folders)
    parts = {
        "title": escape(str(data["title"])),
        "style": style,
        "script": script,
        "worker": bundle("worker", folders),
        "data": _json(data),
        "module": base64.b64encode(gzip.compress(wasm_module(fmu), 9, mtime=0)).decode(),
        "policy": _policy(script, style),
    }
    return _filled((_ASSETS / "page.html").read_text("utf-8"), parts)


def _filled(template: str, parts: Mapping[str, str]) -> str:
    for name in ("script", "worker", "style"):
        if "</" + ("style" if name == "style" else "script") in parts[name].lower():
            raise BuildError(f"internal error: the {name} of the page would end early")
    pieces = template.split("{{")
    filled = [pieces[0]]
    for piece in pieces[1:]:
        name, _, rest = piece.partition("}}")
        filled += [parts[name], rest]
    return "".join(filled)


def _policy(script: str, style: str) -> str:
    """The Content Security Policy: allows this script, this style and the module, and nothing external."""
    return "; ".join(
        (
            "default-src 'none'",
            f"script-src {_hash(script)} 'wasm-unsafe-eval'",
            f"style-src {_hash(style)}",
            "worker-src blob:",
            "base-uri 'none'",
            "form-action 'none'",
        )
    )


def _hash(text: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}'"


def _json(data: Any) -> str:
    """Return JSON that cannot close the HTML element around it, whatever texts a model contains."""
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _compact(variable: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in variable.items() if value or (value == 0 and value is not False)}


def _styles(folder: Path) -> list[Path]:
    return sorted(folder.glob("*.css"))


def _with_settings(model: PageModel, settings: Settings) -> PageModel:
    """Return the model with ranges and start values of the settings; all names must exist in the model."""
    presets = [(f"presets {preset.name!r}", name) for preset in settings.presets for name in preset.values]
    set_here = [("ranges", n) for n in settings.ranges] + [("values", n) for n in settings.values] + presets
    for place, name in [*set_here, *(("first", name) for name in settings.first)]:
        one = model.variable(name)
        if one is None or not one.settable:
            raise BuildError(
                f"explore.{place}: {name!r} is no parameter, input or start value of {model.name}"
            )
    for plot in settings.plots:
        for name in (*plot.y, *([plot.x] if plot.x else [])):
            if model.variable(name) is None:
                raise BuildError(f"explore.plots: {name!r} is no variable of {model.name}")
    return replace(model, variables=tuple(_adjusted(one, settings) for one in model.variables))


def _adjusted(one: PageVariable, settings: Settings) -> PageVariable:
    start = settings.values.get(one.name, one.start)
    return replace(one, range=settings.ranges.get(one.name, one.range), start=start, given=start != one.start)


def _first(model: PageModel) -> list[str]:
    """The variables shown before the groups: inputs, and parameters without a dot in their name."""
    inputs = [one.name for one in model.variables if one.settable and one.causality == "input"]
    plain = [one.name for one in model.variables if one.settable and "." not in one.name]
    return list(dict.fromkeys(plain + inputs))


def _plots(model: PageModel) -> list[PlotChoice]:
    """One plot per unit of the variables shown, and the first phase plane.

    Outputs are shown; if there are none, the states; if there are none either, the inner variables.
    """
    states = [one for one in model.variables if one.derivative is not None]
    outputs, inner = ([o for o in model.variables if o.causality == kind] for kind in ("output", "local"))
    shown = outputs or states or inner
    units: dict[str, list[str]] = {}
    for one in shown:
        units.setdefault(one.unit or one.kind, []).append(one.name)
    plots = [PlotChoice(tuple(names[:_MOST_CURVES])) for names in units.values()]
    planes = [
        PlotChoice((_shown_as(one.derivative, model),), one.name) for one in states[:1] if one.derivative
    ]
    return plots[:1] + planes + plots[1:]


def _shown_as(rate: str, model: PageModel) -> str:
    """Return the name under which a derivative is shown.

    If the derivative of a state is itself a state, such as a velocity, this is the name of that state.
    """
    one = model.variable(rate)
    same = [
        other.name
        for other in model.variables
        if one is not None and other.derivative is not None and other.unit == one.unit and other.unit
    ]
    return same[0] if len(same) == 1 else rate
