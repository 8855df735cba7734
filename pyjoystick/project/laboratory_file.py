"""Reading ``laboratory.toml``; docs/your-joystick.md describes it."""

from __future__ import annotations

import math
from collections.abc import Iterator
from os import PathLike
from typing import Any, Final

from pyjoystick import laboratory, model, motion, reports
from pyjoystick.project.laboratory import (
    AccelerometerSource,
    CurveSource,
    FitChoice,
    FmuChoice,
    Laboratory,
    MarkerSource,
    SwingSource,
    TableSource,
)
from pyjoystick.support import ParameterError, Table, finite, not_negative, positive, read_toml

#: Kinds of the quantities that a project may state by itself.
KINDS: Final = {
    "m": "mass",
    "h": "length",
    "J": "moment of inertia",
    "g": "acceleration",
    "a": "length",
    "b": "length",
    "pivot_to_top": "length",
}
#: The tables that only a project has.
TABLES: Final = (
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
_AXES: Final = ("x", "-x", "y", "-y", "z", "-z")
_RELEASE: Final = math.radians(-20.0)


def read_laboratory(path: str | PathLike[str] | Table) -> Laboratory:
    """Read the file of a project.

    Numbers are in SI units, or text with a unit: ``0.0241`` or ``"24.1 mm"``. Files are relative to the
    project; whether they are there is not asked.

    Raises:
        InputFileError: the file, or the parameter file that it names, cannot be read
        SettingsError: it is no TOML, or something in it is missing, unknown or not allowed
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
        parts=_file(root.table("parts")) if "parts" in root else "",
        swing=_swing(root.table("swing")) if "swing" in root else None,
        curves={side: _curve(curves.table(side)) for side in model.SIDES if side in curves},
        markers=tuple(_markers(one, chain) for one in _each(root, "markers")),
        tables=tuple(_record(one) for one in _each(root, "record")),
        accelerometers=tuple(_accelerometer(one, chain) for one in _each(root, "accelerometer")),
        fit=FitChoice(
            law="power-law" if _choice(fit, "law", ("constant", "power-law")) == "power-law" else "constant",
            file=fit.text("settings", ""),
            even_if_doubtful=fit.flag("even_if_doubtful"),
        ),
        scale=_relative(fit, "u_scale"),
        time_base=_default(_relative(fit, "u_time_base"), 0.0),
        release_angle=_default(_angle(results, "release_angle"), _RELEASE),
        fmus=_fmus(root.table("fmus")),
    )
    _require_one_source(root, laboratory)
    with root.table("geometry").at():
        values = laboratory.given.values
        laboratory.base.joystick.replace({name: values[name] for name in ("a", "b") if name in values})
    root.finish()
    return laboratory


def _each(root: Table, key: str) -> Iterator[Table]:
    """The tables written [[key]], perhaps none."""
    if key in root:
        yield from root.tables(key)


def _require_one_source(root: Table, found: Laboratory) -> None:
    """Refuse a quantity that is stated and measured too."""
    measured = {"m": "parts", "h": "parts"} if found.parts else {}
    measured |= {"J": "swing"} if found.swing else {"J": "parts"} if found.parts else {}
    for name, table in measured.items():
        if name in found.given.values:
            raise root.table("body").error(name, f"must be left out: [{table}] gives it")
    if found.fit.file and "law" in root.table("fit"):
        raise root.table("fit").error("law", "must be left out: the settings name the FMU")


def _given(root: Table) -> laboratory.MeasuredValues:
    """The values of [body], [gravity] and [geometry]."""
    values, uncertainties, sources = {}, {}, {}
    insist = not root.flag("implausible")
    for name, keys in model.PLAIN_TABLES.items():
        table = root.table(name)
        for key in keys:
            value = _quantity(table, key, KINDS[key])
            error = _quantity(table, f"u_{key}", KINDS[key])
            if error is not None:
                with table.at(f"u_{key}"):
                    uncertainties[laboratory.PLACES[key]] = not_negative(f"u_{key}", error)
                if value is None:
                    raise table.error(f"u_{key}", f"needs {key} beside it")
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
            raise table.error("source", "has no value beside it")
    return laboratory.MeasuredValues(values=values, uncertainties=uncertainties, sources=sources)


def _curve(table: Table) -> CurveSource:
    return CurveSource(
        file=_file(table),
        columns=_texts(table.table("columns")),
        units=_texts(table.table("units")),
        layout=_layout(table),
        travel_noise=_quantity(table, "travel_noise", "length"),
        force_noise=_quantity(table, "force_noise", "force"),
        friction=table.flag("friction"),
    )


def _swing(table: Table) -> SwingSource:
    if ("file" in table) == ("times" in table):
        raise table.error("", "needs file, a recorded swing, or times, readings of a stopwatch; one of them")
    if "file" in table:
        return SwingSource(file=_file(table))
    error = _default(_angle(table, "amplitude_uncertainty"), math.radians(1.0))
    first, last = _angle(table, "amplitude"), _angle(table, "end_amplitude")
    if first is None:
        raise table.error("amplitude", "is missing: the period depends on it")
    with table.at("times"):
        times = tuple(positive("times", one, "s") for one in table.entries("times"))
    return SwingSource(
        times=times,
        swings=table.integer("swings", 1, 1),
        amplitude=laboratory.Measured(first, error),
        end_amplitude=None if last is None else laboratory.Measured(last, error),
        reaction_time=_quantity(table, "reaction_time", "time"),
    )


def _markers(table: Table, chain: laboratory.Chain) -> MarkerSource:
    base = table.words("base")
    if len(base) != 2:
        raise table.error("base", "must be two names")
    radius, error = _quantity(table, "radius", "length"), _quantity(table, "u_radius", "length")
    if error is not None and radius is None:
        raise table.error("u_radius", "needs radius beside it")
    with table.at():
        setup = laboratory.MarkerSetup(
            top=table.text("top"),
            base=(base[0], base[1]),
            forward=_choice(table, "forward", _AXES) or "x",
            up=_choice(table, "up", _AXES),
            middle=table.flag("middle"),
            radius=None if radius is None else positive("radius", radius, "m"),
            moving_base=table.flag("moving_base"),
            rest=_interval(table, "rest"),
            rests=_side(table, "rests"),
            released=_side(table, "released"),
            unit=table.optional("unit") and table.text("unit"),
            chain=chain,
        )
        error = not_negative("u_radius", _default(error, 0.0), "m")
    return MarkerSource(files=_files(table), setup=setup, radius_uncertainty=error)


def _layout(table: Table) -> motion.Layout:
    """The form of a table of numbers."""
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
    for name, text in _texts(inner).items():
        with inner.at(name):
            scales[name] = motion.scale_of(name, text, zeros.pop(name, 0.0))
    for name in zeros:
        raise table.error("zeros", f"has {name}, of which there is no scale")
    return TableSource(
        files=_files(table),
        columns=_texts(table.table("columns")),
        units=_texts(table.table("units")),
        layout=_layout(table),
        scales=scales,
        rate=_quantity(table, "samples_per_second"),
        start=_quantity(table, "from", "time"),
        end=_quantity(table, "to", "time"),
    )


def _accelerometer(table: Table, chain: laboratory.Chain) -> AccelerometerSource:
    distance = _quantity(table, "distance", "length")
    if distance is None:
        raise table.error("distance", "is missing")
    with table.at():
        setup = laboratory.AccelerometerSetup(
            distance=positive("distance", distance, "m"),
            column=table.text("column", "acceleration"),
            unit=table.optional("unit") and table.text("unit"),
            rate=_quantity(table, "samples_per_second"),
            sensitivity=_quantity(table, "sensitivity"),
            full_scale=_quantity(table, "full_scale"),
            delay=_default(_quantity(table, "delay", "time"), 0.0),
            backward=table.flag("backward"),
            rest=_interval(table, "rest"),
            chain=chain,
        )
    return AccelerometerSource(file=_file(table), record=table.text("record"), setup=setup)


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


def _relative(table: Table, key: str) -> float | None:
    """A relative standard uncertainty."""
    value = _quantity(table, key)
    if value is None:
        return None
    with table.at(key):
        return not_negative(key, value)


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


def _file(table: Table) -> str:
    name = table.text("file")
    if not name:
        raise table.error("file", "must name a file")
    return name


def _files(table: Table) -> tuple[str, ...]:
    """One name or pattern, or a list of them."""
    given = table.value("files")
    names = (given,) if isinstance(given, str) else tuple(table.words("files"))
    if not all(names):
        raise table.error("files", "must name files")
    return names


def _texts(table: Table) -> dict[str, str]:
    return {name: table.text(name) for name, _ in table.items()}


def _choice(table: Table, key: str, allowed: tuple[str, ...]) -> str | None:
    return table.choice(key, allowed) if key in table else None


def _side(table: Table, key: str) -> model.Side | None:
    word = _choice(table, key, model.SIDES)
    return next((side for side in model.SIDES if side == word), None)


def _interval(table: Table, key: str) -> tuple[float, float] | None:
    if key not in table:
        return None
    entries = table.entries(key)
    with table.at(key):
        ends = tuple(finite(key, one, "s") for one in entries)
    if len(ends) != 2 or ends[0] >= ends[1]:
        raise table.error(key, "must be two instants (s), the first before the second")
    return ends[0], ends[1]


def _angle(table: Table, key: str) -> float | None:
    value = _quantity(table, key, "angle")
    if value is not None and abs(value) >= math.pi / 2.0:
        hint = f'did you mean "{value:g} deg"?' if abs(value) < 90.0 else ""
        raise table.error(key, "must lie between -90 and 90 degrees; a bare number is in rad", hint)
    return value


def _quantity(table: Table, key: str, kind: str = "") -> float | None:
    """A number in the SI unit, or text with a unit of the kind; None where the key is absent."""
    if key not in table:
        return None
    given: Any = table.value(key)
    units = motion.UNITS.get(kind, {})
    si = next(iter(units), "")
    with table.at(key):
        if isinstance(given, str) and units:
            try:
                return motion.amount(given, units)
            except (KeyError, ValueError):
                allowed = f"a number ({si}), or text with a unit: {', '.join(units)}"
                raise ParameterError(key, given, allowed) from None
        return finite(key, given, si)


def _default(value: float | None, default: float) -> float:
    return default if value is None else value
