"""Reports on mass and inertia."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any, Final

from pyjoystick.laboratory.inertia.budget import Estimate, Measured
from pyjoystick.laboratory.inertia.decay import Decay
from pyjoystick.laboratory.inertia.parts import PartsResult
from pyjoystick.laboratory.inertia.swing import SwingPeriod
from pyjoystick.support import TextTable, document_text

#: Number of standard errors from which a value counts as significant.
_CLEAR: Final = 2.0


def swing_report(found: SwingPeriod) -> str:
    """The period of a swing test, and its corrections."""
    return (
        f"Period {found.measured:.6g} s as measured; the amplitude lengthens it by "
        f"{100.0 * (found.amplitude_factor - 1.0):.3g} %.\n"
        f"Period T of small undamped swings {found.period.value:.6g} s."
        f"{'' if found.decay is None else _decay(found.decay)}"
    )


def _decay(decay: Decay) -> str:
    ratio, friction = decay.damping_ratio, decay.friction_angle
    others = ", ".join(f"{name} {one:.1f} above" for name, one in decay.margins.items() if one > 0.0)
    off, error = math.degrees(2.0 * friction.value), math.degrees(2.0 * friction.uncertainty)
    dry = f"dry friction takes {off:.4f} degrees off every half swing (standard error {error:.1g})"
    if off < _CLEAR * error:
        most = max(off, 0.0) + _CLEAR * error
        dry = f"no dry friction is seen (below {most:.1g} degrees off every half swing)"
    return (
        f"\nDecay: damping ratio {ratio.value:.5f} (standard error {ratio.uncertainty:.1g}); {dry}.\n"
        f"The heights prefer {decay.preferred} (BIC: {others})."
    )


def estimates_report(estimates: Mapping[str, Estimate]) -> str:
    """Estimates by name as a table in Markdown, each with its uncertainty budget."""
    rows = []
    for name, one in estimates.items():
        low, high = one.interval
        rows.append([name, f"{one.value:.6g}", f"{one.uncertainty:.2g}", f"{low:.6g} to {high:.6g}"])
        rows += [
            [f"  from {quantity}", "", f"{part:.2g}", ""]
            for quantity, part in one.budget.items()
            if part > 0.0
        ]
    return TextTable(["", "value", "standard uncertainty", "95 % interval"], rows).markdown()


def swing_json(
    found: SwingPeriod, inertia: Estimate, friction: Estimate | None, notes: Sequence[str] = ()
) -> str:
    """A swing test as JSON text, in SI units.

    Args:
        found: the period
        inertia: J
        friction: T_c; None if the decay was not recorded
        notes: notes on the results
    """
    decay = found.decay
    parameters = [_parameter("J", "kg.m2", inertia)]
    if friction is not None:
        parameters.append(_parameter("friction.T_c", "N.m", friction))
    content = {
        "measured_period": found.measured,
        "amplitude_factor": found.amplitude_factor,
        "period": _estimate(found.period),
        "parameters": parameters,
        "decay": None
        if decay is None
        else {
            "damping_ratio": _measured(decay.damping_ratio),
            "friction_angle": _measured(decay.friction_angle),
            "preferred": decay.preferred,
            "models": [{"name": name, "bic_above_best": one} for name, one in decay.margins.items()],
        },
    }
    return document_text("import swing", content, notes)


def parts_json(found: PartsResult, notes: Sequence[str] = ()) -> str:
    """Mass, center of mass and moment of inertia as JSON text, in SI units."""
    units = {"m": "kg", "h": "m", "J": "kg.m2"}
    parameters = [_parameter(name, unit, getattr(found, name)) for name, unit in units.items()]
    return document_text("import parts", {"parameters": parameters}, notes)


def _measured(one: Measured) -> dict[str, float]:
    return {"value": one.value, "standard_uncertainty": one.uncertainty}


def _parameter(name: str, unit: str, one: Estimate) -> dict[str, Any]:
    return {"name": name, "unit": unit, **_estimate(one)}


def _estimate(one: Estimate) -> dict[str, Any]:
    return {
        "value": one.value,
        "standard_uncertainty": one.uncertainty,
        "degrees_of_freedom": one.freedom,
        "interval": one.interval,
        "contributions": [
            {"name": quantity, "standard_uncertainty": part} for quantity, part in one.budget.items()
        ],
    }
