"""Schema of ``laboratory.toml``, table by table."""

from __future__ import annotations

import dataclasses
from typing import Final

from pyjoystick import laboratory, model
from pyjoystick.reports.project.editor_schemas.blocks import (
    COUNT,
    FLAG,
    NUMBER,
    TEXT,
    Schema,
    about,
    array,
    mapping,
    quantity,
    table,
)
from pyjoystick.reports.project.laboratory_file import AXES, KINDS

_TEXTS: Final = mapping(TEXT)
_INTERVAL: Final = array(NUMBER, 2, 2)
_SIDE: Final[Schema] = {"enum": list(model.SIDES)}
_AXIS: Final[Schema] = {"enum": list(AXES)}
_FILES: Final[Schema] = {
    "anyOf": [TEXT, array(TEXT)],
    "description": "name, pattern such as data/*.c3d, or list",
}
#: Keys for the layout of a table of numbers.
_LAYOUT: Final[dict[str, Schema]] = {
    **dict.fromkeys(("sheet", "delimiter", "encoding"), TEXT),
    "decimal": {"enum": ["", ".", ","]},
}


def laboratory_schema() -> Schema:
    """Return the schema of ``laboratory.toml``."""
    curve = _load_curve()
    return table(
        title=TEXT,
        implausible=about(FLAG, "take values that no joystick has"),
        parameters=about(TEXT, "parameter file with the values that are not measured"),
        **{name: _stated(keys) for name, keys in model.PLAIN_TABLES.items()},
        load_curve=table(forward=curve, backward=curve),
        parts=table(("file",), file=TEXT),
        swing=_swing(),
        markers=array(_markers()),
        record=array(_record()),
        accelerometer=array(_accelerometer()),
        signal_chain=_signal_chain(),
        fit=_fit(),
        results=table(release_angle=quantity("angle")),
        fmus=_fmus(),
    )


def _stated(keys: tuple[str, ...]) -> Schema:
    """Return the schema of stated quantities, each with its uncertainty."""
    places = {
        place: quantity(KINDS[key], text)
        for key in keys
        for place, text in ((key, ""), (f"u_{key}", "standard uncertainty"))
    }
    return table(**places, source=TEXT)


def _load_curve() -> Schema:
    return table(
        ("file",),
        file=TEXT,
        **_LAYOUT,
        columns=about(_TEXTS, "headings of travel and force"),
        units=_TEXTS,
        travel_noise=quantity("length", "of one sample"),
        force_noise=quantity("force", "of one sample"),
        friction=about(FLAG, "half the hysteresis is the dry friction along the plungers"),
    )


def _swing() -> Schema:
    return table(
        file=TEXT,
        times=array(NUMBER),
        swings=COUNT,
        **dict.fromkeys(("amplitude", "end_amplitude", "amplitude_uncertainty"), quantity("angle")),
        reaction_time=quantity("time"),
    )


def _markers() -> Schema:
    return table(
        ("files", "top", "base"),
        files=_FILES,
        top=about(TEXT, "marker on top of the joystick"),
        base=about(array(TEXT, 2, 2), "the two markers on the base"),
        forward=about(_AXIS, "axis of the laboratory that points forward"),
        up=about(_AXIS, "axis in the plane of motion"),
        middle=about(FLAG, "the pivot is the middle of the base markers"),
        radius=quantity("length", "measured distance from the pivot to the top marker"),
        u_radius=quantity("length", "its standard uncertainty"),
        moving_base=FLAG,
        rest=about(_INTERVAL, "a stretch at rest (s)"),
        rests=about(_SIDE, "side to which the joystick leans at rest"),
        released=about(_SIDE, "side of the release"),
        unit=about(TEXT, "of the coordinates, if the file gives none: m, cm, mm, um or in"),
    )


def _record() -> Schema:
    return table(
        ("files",),
        **{"files": _FILES, "from": quantity("time"), "to": quantity("time")},
        columns=about(_TEXTS, "headings of time, theta, omega, T, F"),
        units=_TEXTS,
        scales=about(_TEXTS, 'such as theta = "0.0879deg/count"'),
        zeros=mapping(NUMBER),
        samples_per_second=NUMBER,
        **_LAYOUT,
    )


def _accelerometer() -> Schema:
    return table(
        ("file", "record", "distance"),
        file=TEXT,
        record=about(TEXT, "the motion: its file without the suffix"),
        distance=quantity("length", "from the pivot"),
        column=TEXT,
        unit=TEXT,
        **dict.fromkeys(("samples_per_second", "sensitivity", "full_scale"), NUMBER),
        delay=quantity("time", "on its clock when that of the motion shows zero"),
        backward=FLAG,
        rest=_INTERVAL,
    )


def _signal_chain() -> Schema:
    numbers = {one.name: NUMBER for one in dataclasses.fields(laboratory.Chain) if one.name != "low_pass"}
    return table(**numbers, cutoff=NUMBER, order=COUNT, corrected=FLAG)


def _fit() -> Schema:
    return table(
        law={"enum": list(model.PAPER.laws)},
        settings=about(TEXT, "a file of your own"),
        known=about(array(TEXT), "measured parameters that the fit may change within their uncertainties"),
        u_scale=about(NUMBER, "relative standard uncertainty of the angle's scale"),
        u_time_base=about(NUMBER, "relative standard uncertainty of the clock of the records"),
        u_force_scale=about(NUMBER, "relative standard uncertainty of the load cell's scale"),
        even_if_doubtful=FLAG,
    )


def _fmus() -> Schema:
    return table(
        name=TEXT,
        fmi=array({"enum": [2, 3]}, 0),
        platforms=array(TEXT),
        **dict.fromkeys(("modelica", "json", "ssp"), FLAG),
    )
