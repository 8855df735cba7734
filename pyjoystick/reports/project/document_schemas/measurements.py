"""Documents of ``pyjoystick import``."""

from __future__ import annotations

from typing import Final

from pyjoystick import model
from pyjoystick.reports.project.document_schemas.blocks import (
    COUNT,
    INTERVAL,
    NUMBER,
    entry,
    or_null,
    parameters,
    rows,
    si,
)
from pyjoystick.reports.project.editor_schemas.blocks import TEXT, Schema, about, array

_FILE: Final = about(TEXT, "what was read")
_UNCERTAIN: Final = entry(value=NUMBER, standard_uncertainty=NUMBER)
_ESTIMATE: Final[dict[str, Schema]] = {
    "standard_uncertainty": NUMBER,
    "degrees_of_freedom": about(NUMBER, "null: infinite"),
    "interval": about(INTERVAL, "of 95 %"),
    "contributions": rows(name=TEXT, standard_uncertainty=NUMBER),
}
_ESTIMATES: Final = parameters(unit=TEXT, **_ESTIMATE)
RECORD: Final[dict[str, Schema]] = {
    "file": _FILE,
    "form": about(TEXT, "format of the file, in words"),
    "heading_line": about({"type": ["integer", "null"]}, "line of the headings; null: none"),
    "samples": about(COUNT, "number of samples"),
    "rate": si("Hz"),
    "columns": about(
        rows(name=TEXT, heading=TEXT, unit=about(TEXT, "in the file"), minimum=NUMBER, maximum=NUMBER),
        "minimum and maximum in SI units",
    ),
    "lines_left_out": about(array({"type": "integer"}, 0), "numbers of lines without a number"),
}
MARKERS: Final[dict[str, Schema]] = {
    "file": _FILE,
    "record": about(TEXT, "name of the record"),
    "frames": about(COUNT, "number of frames"),
    "rate": si("Hz"),
    "duration": si("s"),
    "markers": rows(name=TEXT, frames_without=COUNT, residual=si("m", "rms, as the cameras state it")),
    "direction": about(array(NUMBER, 3, 3), "x, y and z of the main direction of motion"),
    "out_of_plane": about(NUMBER, "largest excursion out of the plane over that along it"),
    "pivot_to_top": si("m", "radius of the arc"),
    "pivot_to_top_error": si("m", "standard error"),
    "noise_across_arc": si("m"),
    "noise": si("rad", "standard deviation of the angle's noise"),
    "theta_min": si("rad"),
    "theta_max": si("rad"),
    "motion": about(
        entry(
            samples=COUNT,
            rate=si("Hz"),
            bridged=about(COUNT, "samples in gaps that are bridged"),
            gaps=rows(start=si("s"), end=si("s")),
            filter_order=COUNT,
            cutoff=si("Hz"),
            half_power_frequency=si("Hz", "-3 dB of both passes"),
            largest_omega=si("rad/s"),
            largest_alpha=si("rad/s2"),
        ),
        "what came out of the signal chain",
    ),
}
ACCELEROMETER: Final[dict[str, Schema]] = {
    "file": _FILE,
    "samples": about(COUNT, "of the whole file"),
    "rate": si("Hz"),
    "smallest": si("m/s2"),
    "largest": si("m/s2"),
    "distance": si("m"),
    "delay": si("s"),
    "zero": si("m/s2", "reading at rest"),
    "gravity_share": about(NUMBER, "largest component of gravity over the peak"),
    "alpha": rows(name=TEXT, peak=si("rad/s2"), rms_difference=si("rad/s2", "to the differentiated angle")),
    "differentiated": entry(peak=si("rad/s2"), rms=si("rad/s2")),
    "correlation": about(NUMBER, "with the differentiated angle"),
    "lag": si("s", "to be added to the delay"),
}
LOAD_CURVE: Final[dict[str, Schema]] = {
    "file": _FILE,
    "side": about(or_null({"enum": list(model.SIDES)}), "forward or backward; null: not given"),
    "segments": rows(
        x=si("m"), x_error=si("m", "standard error"), k=si("N/m"), k_error=si("N/m", "standard error")
    ),
    "springs": about(
        parameters(unit=TEXT, standard_error=NUMBER), "of four segments; names begin with the side, if known"
    ),
    "friction": or_null(entry(value=si("N"), standard_error=si("N"))),
    "hysteresis_work": si("J", "of one cycle"),
    "zero": si("N", "force without load"),
    "travel_noise": si("m"),
    "force_noise": si("N"),
    "misfit": about(NUMBER, "distance to the fit over the noise, rms"),
    "misses": rows(name=TEXT, rms=si("N"), largest=si("N")),
}
SWING: Final[dict[str, Schema]] = {
    "measured_period": si("s"),
    "amplitude_factor": about(NUMBER, "measured period over that of small swings"),
    "period": about(entry(value=si("s"), **_ESTIMATE), "of small undamped swings"),
    "parameters": about(_ESTIMATES, "J, and friction.T_c where the decay was recorded"),
    "decay": or_null(
        entry(
            damping_ratio=_UNCERTAIN,
            friction_angle=about(_UNCERTAIN, "T_c/(m g h), in rad"),
            preferred=TEXT,
            models=rows(name=TEXT, bic_above_best=NUMBER),
        )
    ),
}
PARTS: Final[dict[str, Schema]] = {"parameters": _ESTIMATES}
