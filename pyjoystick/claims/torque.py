"""Sections 5 and 6: the torque of a motion forward and back."""

from __future__ import annotations

from typing import Final

from scipy.optimize import brentq

from pyjoystick.claims.claim import Finding, claim, verdict
from pyjoystick.claims.workbench import Workbench
from pyjoystick.forced_motion import ForwardAndReturn, Samples, TorqueMeasures, measure, torque_by_reference
from pyjoystick.parameters import NOMINAL, NOMINAL_POWER_LAW, STOP_ANGLE, JoystickParameters

#: Strokes between which the one is looked for whose inertia torque is comparable to its stiffness torque (s).
_STROKES: Final = (0.05, 2.0)
#: Comparable: the smaller peak is this part of the larger one.
_COMPARABLE: Final = 0.5


@claim("5, 6, Fig. 15", "inertia torque comparable to stiffness torque")
def inertia_and_stiffness(bench: Workbench) -> Finding:
    """The stroke to the stop that is quick enough for that."""
    stroke = _comparable_stroke()
    slow = _measures(NOMINAL, 2.0 * stroke).peak_ratio("inertia", "stiffness")
    here = (
        f"true of quick strokes: a minimum-jerk stroke to 20 degrees in {1e3 * stroke:.0f} ms has "
        "peaks in the ratio "
        f"{_COMPARABLE:g}, one in {2e3 * stroke:.0f} ms has {slow:.2f}"
    )
    remark = (
        "the paper's motion, Fig. 14, is not published as numbers; the next two lines take the quick stroke"
    )
    return Finding(verdict(stroke > 0.5, stroke > 0.1), here, remark)


@claim("5, 6, Fig. 15b", "the damping torque is about 10 % of the total")
def damping_part(bench: Workbench) -> Finding:
    """Peaks of damping torque over those of the total, with both laws."""
    stroke = _comparable_stroke()
    parts = [100.0 * _measures(one, stroke).peak_ratio("damping") for one in (NOMINAL, NOMINAL_POWER_LAW)]
    here = f"{parts[0]:.0f} % with C = 0.045, {parts[1]:.0f} % with eq. (11)"
    return Finding(
        verdict(all(5.0 <= part <= 20.0 for part in parts), any(5.0 <= p <= 20.0 for p in parts)), here
    )


@claim("5, Fig. 15b", "eq. (11) gives about twice the damping torque of C = 0.045")
def damping_laws(bench: Workbench) -> Finding:
    """Ratio of the largest damping torques, and of the works that they take."""
    stroke = _comparable_stroke()
    constant, power_law = (_measures(one, stroke) for one in (NOMINAL, NOMINAL_POWER_LAW))
    peaks = power_law.parts["damping"].peak / constant.parts["damping"].peak
    works = power_law.loss / constant.loss
    here = f"{peaks:.2f} times the peak, {works:.2f} times the work, for a motion forward"
    remark = "the same coefficients, backward, give " + (
        f"{_measures(NOMINAL_POWER_LAW, stroke, -1.0).loss / _measures(NOMINAL, stroke, -1.0).loss:.2f} "
        "times the work"
    )
    return Finding(verdict(abs(peaks - 2.0) < 0.3, peaks > 1.3), here, remark)


def _comparable_stroke() -> float:
    """The time of the stroke (s) to the stop at which the inertia torque is comparable."""

    def excess(stroke: float) -> float:
        return _measures(NOMINAL, stroke).peak_ratio("inertia", "stiffness") - _COMPARABLE

    return float(brentq(excess, *_STROKES, xtol=1e-6))


def _measures(joystick: JoystickParameters, stroke: float, side: float = 1.0) -> TorqueMeasures:
    samples = Samples.of(ForwardAndReturn(amplitude=side * STOP_ANGLE, rise=stroke), joystick)
    return measure(joystick, samples, torque_by_reference(joystick, samples))


CLAIMS = (inertia_and_stiffness, damping_part, damping_laws)
