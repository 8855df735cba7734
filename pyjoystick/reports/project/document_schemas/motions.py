"""Documents on computed motions and torques: free oscillation, torque, response, vibration."""

from __future__ import annotations

from typing import Final

from pyjoystick.reports.project.document_schemas.blocks import (
    COUNT,
    FMU,
    JOYSTICK,
    NUMBER,
    TEXTS,
    entry,
    rows,
    si,
)
from pyjoystick.reports.project.document_schemas.models import LAW
from pyjoystick.reports.project.editor_schemas.blocks import FLAG, TEXT, Schema, about, array

_TRUSTED: Final = si("s", "until then a small error stays small; null: to the end")
#: Only with --trusted.
FREE_OSCILLATION_OPTIONAL: Final = ("trusted_until",)
FREE_OSCILLATION: Final[dict[str, Schema]] = {
    "fmu": FMU,
    "parameters": JOYSTICK,
    "theta_start": si("rad"),
    "duration": si("s"),
    "tolerance": about(NUMBER, "of the FMU's integrator"),
    "peaks": rows(
        time=si("s"), theta=si("rad"), half_period=si("s", "since the peak before, if on the other side")
    ),
    "trusted_until": _TRUSTED,
}
_SHARES: Final[dict[str, Schema]] = {
    "highest": si("N.m"),
    "lowest": si("N.m"),
    "rms": si("N.m"),
    "impulse": si("N.m.s"),
    "work": si("J"),
    "share": about(NUMBER, "of the mean square of the torque"),
}
_CLOSED_FORM: Final = entry(
    kind={"const": "closed form"},
    amplitude=si("rad"),
    rise=si("s"),
    fall=si("s"),
    dwell=si("s"),
    rest=si("s"),
    shape=TEXT,
    flat=NUMBER,
)
_MEASURED: Final = entry(kind={"const": "measured"}, file=TEXT, differentiated=FLAG)
TORQUE: Final[dict[str, Schema]] = {
    "motion": {"oneOf": [_CLOSED_FORM, _MEASURED]},
    "laws": rows(
        damping=LAW,
        parameters=JOYSTICK,
        duration=si("s"),
        total=entry(**_SHARES),
        parts=rows(name=TEXT, **_SHARES),
        positive_work=si("J", "of the hand on the joystick"),
        negative_work=si("J", "of the joystick on the hand, below 0"),
        energy_change=si("J"),
        pivot_to_handle=si("m"),
        work=si("J"),
        loss=si("J"),
        peak_force=si("N"),
        difference_to_plain_python=about(NUMBER, "of the FMU, relative to the largest value"),
    ),
}
_DERIVATIVES: Final = about({"enum": ["exact", "differences"]}, "of the state after a period")
_COMPLEX: Final = about(array(array(NUMBER, 2, 2), 0), "real and imaginary part")
_PERIODIC: Final = entry(
    kind={"const": "periodic"},
    periods=about(COUNT, "of the torque"),
    largest=si("rad"),
    state=array(NUMBER, 2, 2),
    multipliers=_COMPLEX,
    exponents=about(_COMPLEX, "in 1/s"),
    derivatives=_DERIVATIVES,
    error=about(NUMBER, "of the monodromy matrix, in scales of the states; null: exact"),
)
_UNSETTLED: Final = entry(
    kind={"enum": ["not settled", "chaotic for a while", "chaotic"]},
    largest=si("rad"),
    exponent=si("1/s", "the largest"),
    exponent_error=si("1/s", "standard error"),
    settled=about(COUNT, "followed motions that are left out of the exponent: their chaos was a transient"),
    tolerance=NUMBER,
    trusted_until=_TRUSTED,
    section=about(array(array(NUMBER, 2, 2), 0), "theta and omega once a period, in rad and rad/s"),
)
#: Only with --vary. The varied parameter adds a column, so the rows of these tables allow other keys.
RESPONSE_OPTIONAL: Final = ("free", "limits", "branches", "points", "special")


def _varied(**columns: Schema) -> Schema:
    """Return the schema of a table that also has the column of the varied parameter, of any name."""
    row = entry(**columns)
    return array(row | {"additionalProperties": NUMBER}, 0)


RESPONSE: Final[dict[str, Schema]] = {
    "torque": si("N.m", "amplitude"),
    "frequency": si("Hz"),
    "parameters": JOYSTICK,
    "releases": rows(
        theta=si("rad"),
        omega=si("rad/s"),
        attractor=about({"type": "integer"}, "index, from 0; -1: the run failed"),
    ),
    "attractors": array({"oneOf": [_PERIODIC, _UNSETTLED]}, 0),
    "free": about(TEXT, "the varied parameter"),
    "limits": about(array(NUMBER, 2, 2), "of the varied parameter"),
    "branches": rows(branch=COUNT, periods=COUNT, ends=TEXTS, reasons=TEXTS),
    "points": _varied(
        branch=COUNT,
        periods=COUNT,
        theta=si("rad"),
        omega=si("rad/s"),
        theta_max=si("rad"),
        theta_min=si("rad"),
        amplitude=si("rad"),
        **{f"multiplier{i}{part}": NUMBER for i in (1, 2) for part in ("", "_imag")},
        stable=FLAG,
        derivatives=_DERIVATIVES,
        error=NUMBER,
    ),
    "special": _varied(branch=COUNT, kind=TEXT, amplitude=si("rad")),
}
VIBRATION: Final[dict[str, Schema]] = {
    "direction": about(TEXT, "in which the base shakes: horizontal, vertical or pitch"),
    "theta": si("rad", "angle at which the handle is held"),
    "hand": entry(stiffness=si("N.m/rad"), damping=si("N.m.s/rad"), mass=si("kg"), distance=si("m")),
    "parameters": JOYSTICK,
    "responses": rows(
        "theta_max",
        "theta_min",
        series=TEXT,
        frequency=si("Hz"),
        gain=si("rad per m/s2 of the base, with pitch rad per rad/s2"),
        phase=si("rad"),
        transmissibility=about(NUMBER, "of the top in space over the base; with pitch of the handle"),
        theta_max=si("rad", "of driven motions"),
        theta_min=si("rad", "of driven motions"),
    ),
}
