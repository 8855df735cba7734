"""JSON schemas of all TOML files, with which editors complete keys and mark mistakes.

A schema knows names, types and choices. What depends on an FMU or on several values together only the reader
finds, `pyjoystick check`. No schema refuses what its reader takes.
"""

from __future__ import annotations

import dataclasses
import json
from os import PathLike
from pathlib import Path
from typing import Any, Final

from pyjoystick import identification, laboratory, model, motion
from pyjoystick.project.laboratory_file import KINDS
from pyjoystick.support import write_text

Schema = dict[str, Any]

_TEXT: Final[Schema] = {"type": "string"}
_NUMBER: Final[Schema] = {"type": "number"}
_FLAG: Final[Schema] = {"type": "boolean"}
_COUNT: Final[Schema] = {"type": "integer", "minimum": 1}
#: A number, or text with a unit.
_AMOUNT: Final[Schema] = {"type": ["number", "string"]}
_SIDE: Final[Schema] = {"enum": list(model.SIDES)}
_AXIS: Final[Schema] = {"enum": ["x", "-x", "y", "-y", "z", "-z"]}


def schemas() -> dict[str, Schema]:
    """The schemas by file name: ``laboratory.schema.json`` and so on."""
    titled = {
        "laboratory": ("A project of pyjoystick: what a laboratory's files are", laboratory_schema()),
        "joystick": ("The parameters of a joystick, in SI units", parameter_schema()),
        "sweep": ("The settings of a sweep", sweep_schema()),
        "fit": ("The settings of a fit", fit_schema()),
        "explore": ("What the live page of a model shows, in SI units", explore_schema()),
    }
    draft = {"$schema": "http://json-schema.org/draft-07/schema#"}
    return {f"{name}.schema.json": draft | {"title": title} | one for name, (title, one) in titled.items()}


def write_schemas(folder: str | PathLike[str]) -> list[Path]:
    """Write all schemas into a folder; returns the files, and raises OutputFileError."""
    paths = []
    for name, schema in schemas().items():
        paths.append(Path(folder) / name)
        write_text(paths[-1], json.dumps(schema, indent=1, ensure_ascii=False) + "\n")
    return paths


def _table(required: tuple[str, ...] = (), /, **keys: Schema) -> Schema:
    found: Schema = {"type": "object", "properties": keys, "additionalProperties": False}
    return found | ({"required": list(required)} if required else {})


def _map(values: Schema) -> Schema:
    return {"type": "object", "additionalProperties": values}


def _list(of: Schema, least: int = 1, most: int | None = None) -> Schema:
    return {"type": "array", "items": of, "minItems": least} | ({} if most is None else {"maxItems": most})


def _about(schema: Schema, text: str) -> Schema:
    return schema | {"description": text}


def _quantity(kind: str, text: str = "") -> Schema:
    """A number in the SI unit, or text with a unit of that kind."""
    si, *others = motion.UNITS[kind]
    unit = f"{si}, or text with a unit: {', '.join(others)}" if others else si
    return _about(_AMOUNT, f"{text} ({unit})".strip())


def parameter_schema() -> Schema:
    """The schema of a parameter file."""

    def numbers(keys: tuple[str, ...], optional: tuple[str, ...] = ()) -> Schema:
        found = {name: one for key in keys for name, one in ((key, _NUMBER), (f"u_{key}", _NUMBER))}
        return _table(tuple(one for one in keys if one not in optional), **found, source=_TEXT)

    segments = _list(_NUMBER, 4, 4)
    side = _table(("x", "k"), x=segments, k=segments, u_x=segments, u_k=segments, source=_TEXT)
    laws = {
        name: numbers(tuple(one.name for one in dataclasses.fields(law)), ("eps_theta", "eps_omega"))
        for name, law in model.PAPER.laws.items()
    }
    tables = {name: numbers(keys, ("pivot_to_top",)) for name, keys in model.PLAIN_TABLES.items()}
    damping = _table(("law",), law={"enum": list(laws)}, **laws)
    friction = tuple(name.removeprefix("friction.") for name in model.FRICTION_NAMES)
    stops = tuple(name.removeprefix("stops.") for name in model.STOP_NAMES)
    required = (*model.PLAIN_TABLES, *model.SIDES, "damping")
    return _table(
        required,
        title=_TEXT,
        implausible=_FLAG,
        **tables,
        **dict.fromkeys(model.SIDES, side),
        damping=damping,
        friction=numbers(friction, friction),
        stops=numbers(stops, stops),
    )


def laboratory_schema() -> Schema:
    """The schema of ``laboratory.toml``."""
    given = {
        name: _table(
            **{
                place: _quantity(KINDS[key], text)
                for key in keys
                for place, text in ((key, ""), (f"u_{key}", "standard uncertainty"))
            },
            source=_TEXT,
        )
        for name, keys in model.PLAIN_TABLES.items()
    }
    files = {"anyOf": [_TEXT, _list(_TEXT)], "description": "name, pattern such as data/*.c3d, or list"}
    texts, interval = _map(_TEXT), _list(_NUMBER, 2, 2)
    layout = {
        **dict.fromkeys(("sheet", "delimiter", "encoding"), _TEXT),
        "decimal": {"enum": ["", ".", ","]},
    }
    curve = _table(
        ("file",),
        file=_TEXT,
        **layout,
        columns=_about(texts, "headings of travel and force"),
        units=texts,
        travel_noise=_quantity("length", "of one sample"),
        force_noise=_quantity("force", "of one sample"),
        friction=_about(_FLAG, "half the hysteresis is the dry friction along the plungers"),
    )
    chain = dataclasses.fields(laboratory.Chain)
    return _table(
        title=_TEXT,
        implausible=_about(_FLAG, "take values that no joystick has"),
        parameters=_about(_TEXT, "parameter file with the values that are not measured"),
        **given,
        load_curve=_table(forward=curve, backward=curve),
        parts=_table(("file",), file=_TEXT),
        swing=_table(
            file=_TEXT,
            times=_list(_NUMBER),
            swings=_COUNT,
            **dict.fromkeys(("amplitude", "end_amplitude", "amplitude_uncertainty"), _quantity("angle")),
            reaction_time=_quantity("time"),
        ),
        markers=_list(
            _table(
                ("files", "top", "base"),
                files=files,
                top=_about(_TEXT, "marker on top of the joystick"),
                base=_about(_list(_TEXT, 2, 2), "the two markers on the base"),
                forward=_about(_AXIS, "axis of the laboratory that points forward"),
                up=_about(_AXIS, "axis in the plane of motion"),
                middle=_about(_FLAG, "the pivot is the middle of the base markers"),
                radius=_quantity("length", "measured distance from the pivot to the top marker"),
                u_radius=_quantity("length", "its standard uncertainty"),
                moving_base=_FLAG,
                rest=_about(interval, "a stretch at rest (s)"),
                rests=_about(_SIDE, "side to which the joystick leans at rest"),
                released=_about(_SIDE, "side of the release"),
                unit={"enum": ["m", "cm", "mm"]},
            )
        ),
        record=_list(
            _table(
                ("files",),
                **{"files": files, "from": _quantity("time"), "to": _quantity("time")},
                columns=_about(texts, "headings of time, theta, omega, T, F"),
                units=texts,
                scales=_about(texts, 'such as theta = "0.0879deg/count"'),
                zeros=_map(_NUMBER),
                samples_per_second=_NUMBER,
                **layout,
            )
        ),
        accelerometer=_list(
            _table(
                ("file", "record", "distance"),
                file=_TEXT,
                record=_about(_TEXT, "the motion: its file without the suffix"),
                distance=_quantity("length", "from the pivot"),
                column=_TEXT,
                unit=_TEXT,
                **dict.fromkeys(("samples_per_second", "sensitivity", "full_scale"), _NUMBER),
                delay=_quantity("time", "on its clock when that of the motion shows zero"),
                backward=_FLAG,
                rest=interval,
            )
        ),
        signal_chain=_table(
            **{one.name: _NUMBER for one in chain if one.name != "low_pass"},
            cutoff=_NUMBER,
            order=_COUNT,
            corrected=_FLAG,
        ),
        fit=_table(
            law={"enum": list(model.PAPER.laws)},
            settings=_about(_TEXT, "a file of your own"),
            u_scale=_about(_NUMBER, "relative standard uncertainty of the angle's scale"),
            u_time_base=_about(_NUMBER, "relative standard uncertainty of the clock of the records"),
            even_if_doubtful=_FLAG,
        ),
        results=_table(release_angle=_quantity("angle")),
        fmus=_table(
            name=_TEXT,
            fmi=_list({"enum": [2, 3]}, 0),
            platforms=_list(_TEXT),
            **dict.fromkeys(("modelica", "json", "ssp"), _FLAG),
        ),
    )


def sweep_schema() -> Schema:
    """The schema of the settings of a sweep."""
    experiment = ("start", "duration", "output_interval", "tolerance", "time_limit")
    value = {"type": ["number", "string", "boolean"]}
    vary = _table(
        values=_list(value),
        **{"from": _AMOUNT},
        **dict.fromkeys(("to", "low", "high", "mean", "deviation", "median"), _AMOUNT),
        count={"type": "integer", "minimum": 2},
        spacing={"enum": ["linear", "log"]},
        distribution={"enum": ["uniform", "loguniform", "normal", "lognormal"]},
        log_deviation=_NUMBER,
    )
    forms = [{"required": one} for one in (["values"], ["from", "to", "count"], ["distribution"])]
    sampling = _table(
        ("method",),
        method={"enum": ["grid", "random", "latin-hypercube", "sobol", "saltelli"]},
        count=_COUNT,
        seed={"type": "integer", "minimum": 0},
    )
    result = _table(
        ("kind", "variable"),
        kind={"enum": ["peaks", "final", "extremes", "loss"]},
        variable=_TEXT,
        derivative=_TEXT,
        count=_COUNT,
        minimum_height=_AMOUNT,
        minimum_prominence=_AMOUNT,
    )
    return _table(
        ("fmu", "vary", "sampling", "results"),
        title=_TEXT,
        fmu=_table(("path",), path=_TEXT, parameters=_TEXT),
        experiment=_table(**dict.fromkeys(experiment, _NUMBER), input_file=_TEXT),
        parameters=_map(value),
        inputs=_map(value),
        vary=_map(vary | {"anyOf": forms}),
        sampling=sampling,
        results=_list(result),
    )


def explore_schema() -> Schema:
    """The schema of the table ``[explore]``, which `fmu_build` reads from a file that may have others."""
    above_zero = {"type": "number", "exclusiveMinimum": 0}
    ends = _table(("min", "max"), min=_NUMBER, max=_NUMBER, scale={"enum": ["linear", "log"]})
    names, values = _list(_TEXT, 0), _map(_NUMBER)
    table = _table(
        title=_TEXT,
        stop_time=_about(above_zero, "s"),
        step=_about(above_zero, "between two rows (s)"),
        first=_about(names, "names of the values above the groups"),
        ranges=_map(ends),
        values=_about(values, "with which the page starts"),
        input_tables=_about(_FLAG, "false: inputs keep their start values"),
        plots=_list(_table(("y",), x=_TEXT, y=_list(_TEXT)), 0),
        presets=_list(_table(("name",), name=_TEXT, values=values), 0),
    )
    return {"type": "object", "properties": {"explore": table}}


def fit_schema() -> Schema:
    """The schema of the settings of a fit."""
    free = _table(**dict.fromkeys(("start", "minimum", "maximum", "uncertainty"), _AMOUNT), per_record=_FLAG)
    value = {"type": ["number", "string", "boolean"]}
    names = _list(_TEXT, 0)
    special = {
        "sigma": _map(_AMOUNT),
        "level": _NUMBER,
        "profiles": names,
        "scan": names,
        "resampling": {"enum": ["records", "residuals"]},
        "stages": _list(_NUMBER, 0),
        "exchanges": _list(_list(_TEXT, 2, 2), 0),
    }

    def of(kind: type[Any]) -> Schema:
        """A table whose keys are the fields of a dataclass."""
        plain = {"bool": _FLAG, "int": {"type": "integer"}}
        keys = {one.name: special.get(one.name) or plain[str(one.type)] for one in dataclasses.fields(kind)}
        return _table(**keys)

    return _table(
        ("fmu", "free"),
        fmu=_table(("path",), path=_TEXT, parameters=_TEXT, tolerance=_NUMBER),
        parameters=_map(value),
        free=_map(free),
        ties=_map(_TEXT),
        noise=of(identification.Noise),
        compare=_table(
            what={"enum": ["trajectory", "peaks"]},
            outputs=_list(_TEXT),
            inputs=_list(_TEXT),
            peaks={"type": "integer", "minimum": 2},
            derivatives=_map(_TEXT),
        ),
        search=of(identification.Search),
        uncertainty=of(identification.Uncertainty),
    )
