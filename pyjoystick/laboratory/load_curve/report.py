"""Reports on a load-deflection curve."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from pyjoystick.laboratory.load_curve.cubic import misses
from pyjoystick.laboratory.load_curve.fit import LoadCurveFit
from pyjoystick.model import Side
from pyjoystick.support import TextTable, document_text

#: Half width of a 95 % interval in standard errors.
_SIGMAS: Final = 1.96
_GRID: Final = 5000
_SI_UNITS: Final = {"k_s": "N/m", "k_h": "N/m", "F_0": "N", "x_0": "m"}
_UNITS: Final = {"k_s": ("N/m", 1.0), "k_h": ("N/m", 1.0), "F_0": ("N", 1.0), "x_0": ("mm", 1e3)}


def load_curve_report(fit: LoadCurveFit) -> str:
    """Segments, springs if there are four segments, friction, noise, and the cubic for comparison."""
    rows = []
    for i, (value, error) in enumerate(zip(fit.table.x, fit.x_errors, strict=True)):
        rows.append(_row(f"x_{i}", "mm", 1e3 * value, 1e3 * float(error)))
    for i, (value, error) in enumerate(zip(fit.table.k, fit.k_errors, strict=True)):
        rows.append(_row(f"k_{i}", "N/m", value, float(error)))
    if fit.has_springs:
        for name, (value, error) in fit.springs().items():
            unit, factor = _UNITS[name.split(".")[1]]
            rows.append(_row(name, unit, factor * value, factor * error))
    if fit.curve.unloading is not None:
        rows.append(_row("friction", "N", fit.friction, fit.friction_error))
    missed = misses(fit)
    segments, cubic = missed["segments"], missed["cubic"]
    return "\n".join(
        (
            TextTable(["", "unit", "value", "standard error", "95 % interval"], rows).markdown(),
            "",
            f"Noise of one sample: {1e6 * fit.travel_noise:.3g} um of travel, {fit.force_noise:.3g} N; the "
            f"fit misses by {fit.misfit:.2f} times that.",
            *_hysteresis(fit),
            f"Force in contact: the segments miss by {segments.rms:.3g} N (rms), at most "
            f"{segments.largest:.3g} N, a cubic by {cubic.rms:.3g} N, at most {cubic.largest:.3g} N.",
        )
    )


def load_curve_json(fit: LoadCurveFit, side: Side | None = None, notes: Sequence[str] = ()) -> str:
    """The report as JSON text, in SI units.

    Args:
        fit: the fit
        side: side of the joystick, if known; names of springs then begin with it, as in the FMU
        notes: notes on the fit
    """
    segments = zip(fit.table.x, fit.x_errors, fit.table.k, fit.k_errors, strict=True)
    prefix = "" if side is None else f"{side}."
    with_unloading = fit.curve.unloading is not None
    content = {
        "file": str(fit.curve.source),
        "side": side,
        "segments": [
            {"x": x, "x_error": x_error, "k": k, "k_error": k_error} for x, x_error, k, k_error in segments
        ],
        "springs": [
            {
                "name": prefix + name,
                "value": value,
                "unit": _SI_UNITS[name.split(".")[1]],
                "standard_error": error,
            }
            for name, (value, error) in (fit.springs() if fit.has_springs else {}).items()
        ],
        "friction": {"value": fit.friction, "standard_error": fit.friction_error} if with_unloading else None,
        "hysteresis_work": hysteresis_work(fit),
        "zero": fit.zero,
        "travel_noise": fit.travel_noise,
        "force_noise": fit.force_noise,
        "misfit": fit.misfit,
        "misses": [
            {"name": name, "rms": one.rms, "largest": one.largest} for name, one in misses(fit).items()
        ],
    }
    return document_text("import load-curve", content, notes)


def hysteresis_work(fit: LoadCurveFit) -> float:
    """Energy dissipated in one cycle (J): area between loading and unloading; NaN without unloading."""
    if fit.curve.unloading is None:
        return float("nan")
    # Over the common travel: at the ends, noise of travel would count with the whole force.
    branches = fit.curve.branches
    first = max(float(np.min(branch.travel)) for branch in branches)
    last = min(float(np.max(branch.travel)) for branch in branches)
    travel = np.linspace(first, last, _GRID)
    forces = []
    for branch in branches:
        order = np.argsort(branch.travel)
        forces.append(np.interp(travel, branch.travel[order], branch.force[order]))
    return float(np.trapezoid(forces[0] - forces[1], travel))


def _hysteresis(fit: LoadCurveFit) -> tuple[str, ...]:
    if fit.curve.unloading is None:
        return ()
    apart, work = 2.0 * fit.friction, 1e3 * hysteresis_work(fit)
    return (f"Hysteresis: loading lies {apart:.3g} N above unloading; one cycle takes up {work:.3g} mJ.",)


def _row(name: str, unit: str, value: float, error: float) -> list[str]:
    """Format a value to two digits of its error."""
    digits = max(0, 1 - int(np.floor(np.log10(error)))) if error > 0.0 else 6
    half = _SIGMAS * error
    interval = f"{value - half:.{digits}f} to {value + half:.{digits}f}"
    return [name, unit, f"{value:.{digits}f}", f"{error:.{digits}f}", interval]
