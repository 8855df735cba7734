"""Schemas of parameter files, and of the settings of sweeps, fits and live pages."""

from __future__ import annotations

import dataclasses
from typing import Any

from pyjoystick import identification, model
from pyjoystick.reports.project.editor_schemas.blocks import (
    AMOUNT,
    COUNT,
    FLAG,
    NUMBER,
    TEXT,
    VALUE,
    Schema,
    about,
    array,
    mapping,
    table,
)


def parameter_schema() -> Schema:
    """Return the schema of a parameter file."""

    def numbers(keys: tuple[str, ...], optional: tuple[str, ...] = ()) -> Schema:
        found = {name: one for key in keys for name, one in ((key, NUMBER), (f"u_{key}", NUMBER))}
        return table(tuple(one for one in keys if one not in optional), **found, source=TEXT)

    segments = array(NUMBER, 4, 4)
    side = table(("x", "k"), x=segments, k=segments, u_x=segments, u_k=segments, source=TEXT)
    laws = {
        name: numbers(tuple(one.name for one in dataclasses.fields(law)), ("eps_theta", "eps_omega"))
        for name, law in model.PAPER.laws.items()
    }
    tables = {name: numbers(keys, ("pivot_to_top",)) for name, keys in model.PLAIN_TABLES.items()}
    damping = table(("law",), law={"enum": list(laws)}, **laws)
    friction = tuple(name.removeprefix("friction.") for name in model.FRICTION_NAMES)
    stops = tuple(name.removeprefix("stops.") for name in model.STOP_NAMES)
    required = (*model.PLAIN_TABLES, *model.SIDES, "damping")
    return table(
        required,
        title=TEXT,
        implausible=FLAG,
        **tables,
        **dict.fromkeys(model.SIDES, side),
        damping=damping,
        friction=numbers(friction, friction),
        stops=numbers(stops, stops),
    )


def sweep_schema() -> Schema:
    """Return the schema of the settings of a sweep."""
    experiment = ("start", "duration", "output_interval", "tolerance", "time_limit")
    vary = table(
        values=array(VALUE),
        **{"from": AMOUNT},
        **dict.fromkeys(("to", "low", "high", "mean", "deviation", "median"), AMOUNT),
        count={"type": "integer", "minimum": 2},
        spacing={"enum": ["linear", "log"]},
        distribution={"enum": ["uniform", "loguniform", "normal", "lognormal"]},
        log_deviation=NUMBER,
    )
    forms = [{"required": one} for one in (["values"], ["from", "to", "count"], ["distribution"])]
    sampling = table(
        ("method",),
        method={"enum": ["grid", "random", "latin-hypercube", "sobol", "saltelli"]},
        count=COUNT,
        seed={"type": "integer", "minimum": 0},
    )
    result = table(
        ("kind", "variable"),
        kind={"enum": ["peaks", "final", "extremes", "loss"]},
        variable=TEXT,
        derivative=TEXT,
        count=COUNT,
        minimum_height=AMOUNT,
        minimum_prominence=AMOUNT,
    )
    return table(
        ("fmu", "vary", "sampling", "results"),
        title=TEXT,
        fmu=table(("path",), path=TEXT, parameters=TEXT),
        experiment=table(**dict.fromkeys(experiment, NUMBER), input_file=TEXT),
        parameters=mapping(VALUE),
        inputs=mapping(VALUE),
        vary=mapping(vary | {"anyOf": forms}),
        sampling=sampling,
        results=array(result),
    )


def explore_schema() -> Schema:
    """Return the schema of the table ``[explore]`` for `fmu_build`; the file may have other tables."""
    above_zero = {"type": "number", "exclusiveMinimum": 0}
    ends = table(("min", "max"), min=NUMBER, max=NUMBER, scale={"enum": ["linear", "log"]})
    names, values = array(TEXT, 0), mapping(NUMBER)
    explored = table(
        title=TEXT,
        stop_time=about(above_zero, "s"),
        step=about(above_zero, "between two rows (s)"),
        first=about(names, "names of the values above the groups"),
        ranges=mapping(ends),
        values=about(values, "with which the page starts"),
        input_tables=about(FLAG, "false: inputs keep their start values"),
        plots=array(table(("y",), x=TEXT, y=array(TEXT)), 0),
        presets=array(table(("name",), name=TEXT, values=values), 0),
    )
    return {"type": "object", "properties": {"explore": explored}}


def fit_schema() -> Schema:
    """Return the schema of the settings of a fit."""
    free = table(**dict.fromkeys(("start", "minimum", "maximum", "uncertainty"), AMOUNT), per_record=FLAG)
    names = array(TEXT, 0)
    special = {
        "sigma": mapping(AMOUNT),
        "level": NUMBER,
        "profiles": names,
        "scan": names,
        "resampling": {"enum": ["records", "residuals"]},
        "stages": array(NUMBER, 0),
        "exchanges": array(array(TEXT, 2, 2), 0),
    }

    def of(kind: type[Any]) -> Schema:
        """Return the schema of a table whose keys are the fields of a dataclass."""
        plain = {"bool": FLAG, "int": {"type": "integer"}}
        keys = {one.name: special.get(one.name) or plain[str(one.type)] for one in dataclasses.fields(kind)}
        return table(**keys)

    return table(
        ("fmu", "free"),
        fmu=table(("path",), path=TEXT, parameters=TEXT, tolerance=NUMBER),
        parameters=mapping(VALUE),
        free=mapping(free),
        ties=mapping(TEXT),
        noise=of(identification.Noise),
        compare=table(
            what={"enum": ["trajectory", "peaks"]},
            outputs=array(TEXT),
            inputs=array(TEXT),
            peaks={"type": "integer", "minimum": 2},
            derivatives=mapping(TEXT),
        ),
        search=of(identification.Search),
        uncertainty=of(identification.Uncertainty),
    )
