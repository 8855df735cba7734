"""Reading of ``laboratory.toml``, which docs/your-joystick.md describes."""

from __future__ import annotations

import math
from collections.abc import Iterator
from os import PathLike
from typing import Final

from pyjoystick import laboratory, model, motion, reports
from pyjoystick.reports.project.entries import (
    angle_of,
    choice_of,
    file_of,
    files_of,
    interval_of,
    quantity_of,
    relative_of,
    side_of,
)
from pyjoystick.reports.project.laboratory import (
    AccelerometerSource,
    CurveSource,
    FitChoice,
    FmuChoice,
    Laboratory,
    MarkerSource,
    SwingSource,
    TableSource,
)
from pyjoystick.support import Table, finite, not_negative, positive, read_toml

#: Kinds of the quantities that ``laboratory.toml`` may state directly.
KINDS: Final = {
    "m": "mass",
    "h": "length",
    "J": "moment of inertia",
    "g": "acceleration",
    "a": "length",
    "b": "length",
    "pivot_to_top": "length",
}
#: Tables that only the file of a project has.
LABORATORY_TABLES: Final = (
    "load_curve",
    "parts",
    "swing",
    "markers",
    "record",
    "accelerometer",
    "signal_chain",
    "fit",
    "results",
    "fmus",
)
_INSIST: Final = "implausible = true above the tables accepts it"
_LAWS: Final = ("constant", "power-law")
#: Directions along the axes of the laboratory.
AXES: Final = ("x", "-x", "y", "-y", "z", "-z")
_RELEASE: Final = math.radians(-20.0)


def read_laboratory(path: str | PathLike[str] | Table) -> Laboratory:
    """Read the ``laboratory.toml`` of a project.

    Quantities are numbers in SI units or text with a unit: ``0.0241`` or ``"24.1 mm"``. File names are
    relative to the project; whether these files exist is not checked.

    Raises:
        InputFileError: the file, or the parameter file that it names, cannot be read
        SettingsError: the file is not TOML, or an entry is missing, unknown or not allowed
    """
    root = read_toml(path)
    base_file = root.text("parameters", "")
    curves = root.table("load_curve")
    chain = _chain(root.table("signal_chain"))
    fit, results = root.table("fit"), root.table("results")
    laboratory = Laboratory(
        path=root.path,
        title=root.text("title", ""),
        base=model.read_parameter_file(root.path.parent / base_file) if base_file else model.PAPER,
        base_file=base_file,
        asks=not root.flag("implausible"),
        given=_given(root),
        parts=file_of(root.table("parts")) if "parts" in root else "",
        swing=_swing(root.table("swing")) if "swing" in root else None,
        curves={side: _curve(curves.table(side)) for side in model.SIDES if side in curves},
        markers=tuple(_markers(one, chain) for one in _each(root, "markers")),
        tables=tuple(_record(one) for one in _each(root, "record")),
        accelerometers=tuple(_accelerometer(one, chain) for one in _each(root, "accelerometer")),
        fit=FitChoice(
            law="power-law" if choice_of(fit, "law", _LAWS) == "power-law" else "constant",
            file=fit.text("settings", ""),
            known=tuple(fit.words("known")) if "known" in fit else (),
            even_if_doubtful=fit.flag("even_if_doubtful"),
        ),
        scale=relative_of(fit, "u_scale"),
        time_base=_default(relative_of(fit, "u_time_base"), 0.0),
        force_scale=_default(relative_of(fit, "u_force_scale"), 0.0),
        release_angle=_default(angle_of(results, "release_angle"), _RELEASE),
        fmus=_fmus(root.table("fmus")),
    )
    _require_one_source(root, laboratory)
    with root.table("geometry").at():
        values = laboratory.given.values
        laboratory.base.joystick.replace({name: values[name] for name in ("a", "b") if name in values})
    root.finish()
    return laboratory


def _each(root: Table, key: str) -> Iterator[Table]:
    """Yield the tables [[key]], if there are any."""
    if key in root:
        yield from root.tables(key)


def _require_one_source(root: Table, found: Laboratory) -> None:
    """Refuse quantities that are both stated and measured, and a law together with settings of the fit."""
    measured = {"m": "parts", "h": "parts"} if found.parts else {}
    measured |= {"J": "swing"} if found.swing else {"J": "parts"} if found.parts else {}
    for name, table in measured.items():
        if name in found.given.values:
            raise root.table("body").error(name, f"must be left out: [{table}] gives it")
    if found.fit.file and "law" in root.table("fit"):
        raise root.table("fit").error("law", "must be left out: the settings name the FMU")


def _given(root: Table) -> laboratory.MeasuredValues:
    """Read the values of [body], [gravity] and [geometry]."""
    values, uncertainties, sources = {}, {}, {}
    insist = not root.flag("implausible")
    for name, keys in model.PLAIN_TABLES.items():
        table = root.table(name)
        for key in keys:
            value = quantity_of(table, key, KINDS[key])
            error = quantity_of(table, f"u_{key}", KINDS[key])
            if error is not None:
                with table.at(f"u_{key}"):
                    uncertainties[laboratory.PLACES[key]] = not_negative(f"u_{key}", error)
                if value is None:
                    raise table.error(f"u_{key}", f"is given without {key}")
            if value is None:
                continue
            values[key] = value
            if insist:
                with table.at(key):
                    model.require_plausible(key, value, insist=_INSIST)
        source = table.text("source", "")
        if any(key in values for key in keys):
            sources[name] = source or f"as stated in {root.path.name}"
        elif source:
            raise table.error("source", "is given without a value")
    return laboratory.MeasuredValues(values=values, uncertainties=uncertainties, sources=sources)


def _curve(table: Table) -> CurveSource:
    return CurveSource(
        file=file_of(table),
        columns=table.table("columns").texts(),
        units=table.table("units").texts(),
        layout=_layout(table),
        travel_noise=quantity_of(table, "travel_noise", "length"),
        force_noise=quantity_of(table, "force_noise", "force"),
        friction=table.flag("friction"),
    )


def _swing(table: Table) -> SwingSource:
    if ("file" in table) == ("times" in table):
        raise table.error("", "needs either file, a recorded swing, or times, readings of a stopwatch")
    if "file" in table:
        return SwingSource(file=file_of(table))
    error = _default(angle_of(table, "amplitude_uncertainty"), math.radians(1.0))
    first, last = angle_of(table, "amplitude"), angle_of(table, "end_amplitude")
    if first is None:
        raise table.error("amplitude", "is missing: the period depends on it")
    with table.at("times"):
        times = tuple(positive("times", one, "s") for one in table.entries("times"))
    return SwingSource(
        times=times,
        swings=table.integer("swings", 1, 1),
        amplitude=laboratory.Measured(first, error),
        end_amplitude=None if last is None else laboratory.Measured(last, error),
        reaction_time=quantity_of(table, "reaction_time", "time"),
    )


def _markers(table: Table, chain: laboratory.Chain) -> MarkerSource:
    base = table.words("base")
    if len(base) != 2:
        raise table.error("base", "must be two names")
    radius, error = quantity_of(table, "radius", "length"), quantity_of(table, "u_radius", "length")
    if error is not None and radius is None:
        raise table.error("u_radius", "is given without radius")
    with table.at():
        setup = laboratory.MarkerSetup(
            top=table.text("top"),
            base=(base[0], base[1]),
            forward=choice_of(table, "forward", AXES) or "x",
            up=choice_of(table, "up", AXES),
            middle=table.flag("middle"),
            radius=None if radius is None else positive("radius", radius, "m"),
            moving_base=table.flag("moving_base"),
            rest=interval_of(table, "rest"),
            rests=side_of(table, "rests"),
            released=side_of(table, "released"),
            unit=table.optional("unit") and table.text("unit"),
            chain=chain,
        )
        error = not_negative("u_radius", _default(error, 0.0), "m")
    return MarkerSource(files=files_of(table), setup=setup, radius_uncertainty=error)


def _layout(table: Table) -> motion.Layout:
    """Read the layout of a table of numbers."""
    decimal = table.text("decimal", "")
    if decimal not in ("", ".", ","):
        raise table.error("decimal", 'must be "." or ","')
    return motion.Layout(
        table.text("delimiter", ""), decimal, table.text("encoding", ""), table.text("sheet", "")
    )


def _record(table: Table) -> TableSource:
    zeros = {key: finite(f"zeros.{key}", value) for key, value in table.table("zeros").items()}
    scales: dict[str, motion.Scale] = {}
    inner = table.table("scales")
    for name, text in inner.texts().items():
        with inner.at(name):
            scales[name] = motion.scale_of(name, text, zeros.pop(name, 0.0))
    for name in zeros:
        raise table.error("zeros", f"has {name}, for which there is no scale")
    return TableSource(
        files=files_of(table),
        columns=table.table("columns").texts(),
        units=table.table("units").texts(),
        layout=_layout(table),
        scales=scales,
        rate=quantity_of(table, "samples_per_second"),
        start=quantity_of(table, "from", "time"),
        end=quantity_of(table, "to", "time"),
    )


def _accelerometer(table: Table, chain: laboratory.Chain) -> AccelerometerSource:
    distance = quantity_of(table, "distance", "length")
    if distance is None:
        raise table.error("distance", "is missing")
    with table.at():
        setup = laboratory.AccelerometerSetup(
            distance=positive("distance", distance, "m"),
            column=table.text("column", "acceleration"),
            unit=table.optional("unit") and table.text("unit"),
            rate=quantity_of(table, "samples_per_second"),
            sensitivity=quantity_of(table, "sensitivity"),
            full_scale=quantity_of(table, "full_scale"),
            delay=_default(quantity_of(table, "delay", "time"), 0.0),
            backward=table.flag("backward"),
            rest=interval_of(table, "rest"),
            chain=chain,
        )
    return AccelerometerSource(file=file_of(table), record=table.text("record"), setup=setup)


def _chain(table: Table) -> laboratory.Chain:
    usual = laboratory.Chain()
    with table.at():
        return laboratory.Chain(
            rate=table.number("rate", usual.rate),
            low_pass=laboratory.LowPass(
                table.number("cutoff", usual.low_pass.cutoff),
                table.integer("order", 1, usual.low_pass.order),
                table.flag("corrected"),
            ),
            velocity_points=table.integer("velocity_points", 3, usual.velocity_points),
            acceleration_points=table.integer("acceleration_points", 3, usual.acceleration_points),
            longest_gap=table.number("longest_gap", usual.longest_gap),
        )


def _fmus(table: Table) -> FmuChoice:
    versions = table.value("fmi") if "fmi" in table else [2]
    if not isinstance(versions, list) or any(one not in (2, 3) or isinstance(one, bool) for one in versions):
        raise table.error("fmi", "must be a list: [2], [3], [2, 3], or [] for no FMUs")
    if table.flag("ssp") and not versions:
        raise table.error("ssp", "needs FMUs: fmi must not be empty")
    name = table.optional("name") and table.text("name")
    if name is not None:
        with table.at("name"):
            reports.check_name(name)
    return FmuChoice(
        name=name,
        versions=tuple(dict.fromkeys(versions)),
        platforms=tuple(table.words("platforms")) if "platforms" in table else (),
        modelica=table.flag("modelica"),
        json=table.flag("json"),
        ssp=table.flag("ssp"),
    )


def _default(value: float | None, default: float) -> float:
    return default if value is None else value
