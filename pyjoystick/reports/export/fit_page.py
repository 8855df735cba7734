"""The fit behind a joystick's values, for the documentation page of its FMUs."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from html import escape
from os import PathLike
from pathlib import Path
from typing import Any, Final

from pyjoystick.model import FmuValue
from pyjoystick.support import InputFileError, TextTable

#: Parameter files give fitted values to a hundredth of their standard error or uncertainty.
_SAME: Final = 0.1


def fit_page(path: str | PathLike[str], values: Sequence[FmuValue]) -> str:
    """Records and results of a fit, as HTML.

    Args:
        path: ``fit.json`` of the fit
        values: parameters of the resulting joystick

    Raises:
        InputFileError: the file is not a ``fit.json``, or is that of another joystick
    """
    path = Path(path)
    try:
        content = json.loads(path.read_text(encoding="utf-8"))
        shared = [one for one in content["parameters"] if one["record"] is None]
        _require_same(path, shared, {one.name: one for one in values})
        return _html(content, shared)
    except OSError as error:
        raise InputFileError(path, f"cannot be read: {error.strerror}") from error
    except (ValueError, KeyError, TypeError) as error:
        raise InputFileError(path, "is not a fit.json as `pyjoystick fit --output` writes it") from error


def _require_same(path: Path, fitted: list[dict[str, Any]], values: Mapping[str, FmuValue]) -> None:
    """Reject a fit that found other values."""
    for one in fitted:
        found = values.get(one["name"])
        if found is None:
            continue
        error = max(one["standard_error"] or 0.0, found.uncertainty or 0.0)
        if one["standard_error"] is not None and not abs(found.value - one["value"]) <= _SAME * error:
            reason = f"is of another joystick: its {found.name} is {one['value']:.9g}, not {found.value:.9g}"
            raise InputFileError(path, reason)


def _number(value: float | None, form: str, otherwise: str) -> str:
    """Convert to a number; null in JSON means infinite or not determined."""
    return otherwise if value is None else format(value, form)


def _html(content: dict[str, Any], fitted: list[dict[str, Any]]) -> str:
    level = 100.0 * content["settings"]["uncertainty"]["level"]
    rows = [
        [
            one["name"],
            f"{one['value']:.6g}",
            _number(one["standard_error"], ".2g", "not determined"),
            " to ".join(_number(end, ".6g", "unknown") for end in one.get("profile", one)["interval"]),
            one["unit"],
        ]
        for one in fitted
    ]
    header = ("parameter", "value", "standard error", f"{level:g} % interval", "unit")
    names = ", ".join(one["name"] for one in content["records"])
    samples = sum(len(one["data"]) for one in content["records"])
    failed = [f"{one['name']}: {one['message']}" for one in content["checks"] if not one["passed"]]
    checks = f"It failed {'; '.join(failed)}" if failed else "It passed every check"
    made = content["made_with"]["pyjoystick"]
    text = (
        f"Fitted to {names}, {samples} numbers in all. {checks}. Standard errors and intervals are those of "
        f"the noise of the records alone. Made with pyjoystick {made}."
    )
    table = TextTable(header, rows).html("Fitted parameters", prose=True)
    return f"<h2>The fit</h2>\n<p>{escape(text)}</p>\n{table}"
