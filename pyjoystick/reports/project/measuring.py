"""Steps from the files of the instruments to springs, inertia and records."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

from pyjoystick import laboratory, model, motion, support
from pyjoystick.reports.project.hysteresis import one_friction, put_down
from pyjoystick.reports.project.laboratory import (
    AccelerometerSource,
    CurveSource,
    Laboratory,
    MarkerSource,
    SwingSource,
    TableSource,
    plain,
)
from pyjoystick.reports.project.sources import table_of, table_sources
from pyjoystick.reports.project.steps import RESULTS, Done, Step, Tell, read_values, with_error, write_values
from pyjoystick.support import write_text

#: Parameter file of the joystick as measured before the fit.
MEASURED = f"{RESULTS}/measured.toml"


def fitted_curve(root: Path, source: CurveSource) -> laboratory.LoadCurveFit:
    """Read a load-deflection curve and fit it."""
    curve = laboratory.read_load_curve(
        root / source.file, columns=source.columns, units=source.units, layout=source.layout
    )
    return laboratory.fit_load_curve(
        curve, 4, travel_noise=source.travel_noise, force_noise=source.force_noise
    )


def curve_values(side: model.Side) -> str:
    """Return the file for the measured springs of a side."""
    return f"{RESULTS}/load_curves/{side}.json"


def load_curve(lab: Laboratory, side: model.Side, source: CurveSource) -> Step:
    """Return the step that determines the springs of one side from its load-deflection curve."""
    values = curve_values(side)
    figure, report = values.replace(".json", ".png"), values.replace(".json", ".md")

    def work(tell: Tell) -> Done:
        fit = fitted_curve(lab.root, source)
        name = Path(source.file).name
        found = laboratory.measured_springs(fit, side, f"load-deflection curve {name}")
        notes = list(fit.notes)
        if source.friction:
            found = found.with_more(laboratory.measured_friction(fit, f"hysteresis of {name}"))
        elif fit.friction > 3.0 * fit.friction_error > 0.0:
            notes.append(put_down(fit, side))
        _require_plausible(lab, found)
        title = f"Load-deflection curve, {name}"
        support.save_figure(laboratory.plot_load_curve(fit, title=title), lab.root / figure)
        write_text(lab.root / report, f"# {title}\n\n{laboratory.load_curve_report(fit)}\n")
        write_values(lab.root / values, found)
        preload, error = fit.springs()["returnSpring.F_0"]
        return Done(
            files=(values, figure, report),
            remark=f"return spring preloaded by {with_error(preload, error)} N",
            notes=tuple(notes),
        )

    return Step(
        name=f"load curve {side}",
        inputs=(source.file,),
        outputs=(values,),
        settings={**plain(source), **_asking(lab)},
        work=work,
    )


PARTS = f"{RESULTS}/parts.json"


def parts(lab: Laboratory) -> Step:
    """Return the step that computes mass, center of mass and a first moment of inertia from the parts."""
    report = PARTS.replace(".json", ".md")

    def work(tell: Tell) -> Done:
        body = laboratory.from_parts(laboratory.read_parts(lab.root / lab.parts))
        found = laboratory.measured_parts(body, f"parts {Path(lab.parts).name}")
        _require_plausible(lab, found)
        write_text(lab.root / report, f"# Parts\n\n{laboratory.estimates_report(body.estimates())}\n")
        write_values(lab.root / PARTS, found)
        mass, height = (with_error(one.value, one.uncertainty) for one in (body.m, body.h))
        return Done(files=(PARTS, report), remark=f"m = {mass} kg, h = {height} m", notes=body.notes)

    return Step(name="parts", inputs=(lab.parts,), outputs=(PARTS,), settings=_asking(lab), work=work)


SWING = f"{RESULTS}/swing.json"


def swing(lab: Laboratory, source: SwingSource, *, with_parts: bool) -> Step:
    """Return the step that determines the moment of inertia from the swing test."""
    report = SWING.replace(".json", ".md")

    def work(tell: Tell) -> Done:
        known = _known(lab, read_values(lab.root / PARTS) if with_parts else None)
        period = _period(lab.root, source)
        inertia = laboratory.inertia_of_swing(period.period, *known.values())
        name = Path(source.file).name if source.file else f"{len(source.times)} readings"
        found = laboratory.measured_swing(inertia, {}, f"swing test {name}")
        _require_plausible(lab, found)
        estimates = laboratory.estimates_report({"T (s)": period.period, "J (kg m2)": inertia})
        write_text(lab.root / report, f"# Swing test\n\n{laboratory.swing_report(period)}\n\n{estimates}\n")
        write_values(lab.root / SWING, found)
        exact = [name for name, one in known.items() if one.uncertainty == 0.0 and name != "g"]
        notes = [f"{' and '.join(exact)} taken as exact: no uncertainty is stated"] if exact else []
        return Done(
            files=(SWING, report),
            remark=f"J = {with_error(inertia.value, inertia.uncertainty)} kg m2",
            notes=tuple(notes),
        )

    return Step(
        name="swing",
        inputs=tuple(filter(None, (source.file, PARTS if with_parts else "", lab.base_file))),
        outputs=(SWING,),
        settings={**plain(source), **_stated(lab, ("m", "h", "g")), **_asking(lab)},
        work=work,
    )


def _known(lab: Laboratory, of_parts: laboratory.MeasuredValues | None) -> dict[str, laboratory.Measured]:
    """Return m, h and g: as stated, else from the parts, else from the base joystick."""
    known = {}
    for name in ("m", "h", "g"):
        values, uncertainties = lab.base.joystick.to_names(), lab.base.uncertainties
        for one in filter(None, (of_parts, lab.given)):
            if name in one.values:
                values, uncertainties = dict(one.values), one.uncertainties
        known[name] = laboratory.Measured(values[name], uncertainties.get(laboratory.PLACES[name], 0.0))
    return known


def _period(root: Path, source: SwingSource) -> laboratory.SwingPeriod:
    if source.file:
        return laboratory.period_of_record(motion.read_record(root / source.file, free_oscillation=False))
    assert source.amplitude is not None
    return laboratory.period_of_readings(
        source.times,
        source.swings,
        source.amplitude,
        source.end_amplitude,
        reaction_time=laboratory.REACTION_TIME if source.reaction_time is None else source.reaction_time,
    )


def measured(lab: Laboratory, files: tuple[str, ...], sources: Mapping[str, str]) -> Step:
    """Return the step that writes the joystick as measured before the fit, completed by the base joystick."""

    def work(tell: Tell) -> Done:
        found = [*(read_values(lab.root / file) for file in files), lab.given]
        found.append(one_friction(found))
        values = {name: value for one in found for name, value in one.values.items()}
        errors = {place: model.rounded_error(u) for one in found for place, u in one.uncertainties.items()}
        top = values.pop("pivot_to_top", None)
        joystick = lab.base.joystick.replace(values)
        text = model.updated_text(
            lab.base,
            joystick,
            pivot_to_top=top,
            title="The joystick as measured before the fit",
            uncertainties=errors,
            sources=table_sources(sources, joystick, lab.base),
        )
        write_text(lab.root / MEASURED, text)
        tables = dict.fromkeys(table_of(name, joystick) for name in sources)
        return Done(files=(MEASURED,), remark=", ".join(tables) or "nothing measured")

    return Step(
        name="joystick before the fit",
        inputs=tuple(filter(None, (*files, lab.base_file))),
        outputs=(MEASURED,),
        settings={"given": plain(lab.given), "sources": dict(sources)},
        work=work,
    )


def record_file(file: str) -> str:
    """Return the record that is made from the file of a motion."""
    return f"{RESULTS}/records/{Path(file).stem}.csv"


def markers(lab: Laboratory, source: MarkerSource, file: str, *, with_curve: bool) -> Step:
    """Return the step that computes the record of the angle from a file of markers."""
    record, side = record_file(file), source.setup.rests
    filtered, report = f"{RESULTS}/motions/{Path(record).name}", record.replace(".csv", ".md")
    curve = (curve_values(side),) if side is not None and with_curve else ()

    def work(tell: Tell) -> Done:
        joystick = _leaning(lab, [read_values(lab.root / one) for one in curve])
        trial = laboratory.read_trial(
            lab.root / file, source.setup, name=Path(record).stem, joystick=joystick
        )
        trial.write(lab.root / record, lab.root / filtered)
        write_text(lab.root / report, f"# {Path(file).name}\n\n{trial.report()}\n")
        frames = len(trial.record.time)
        lost = len(trial.markers.time) - frames
        return Done(
            files=(record, filtered, report),
            remark=f"{frames} frames, {lost} lost, noise {math.degrees(trial.measured.noise):.2g} deg",
            notes=trial.record.notes,
        )

    stated = _stated(lab, ("a", "b")) if side is not None else {}
    base = (lab.base_file,) if side is not None and lab.base_file else ()
    return Step(
        name=f"record {Path(record).stem}",
        inputs=(file, *curve, *base),
        outputs=(record,),
        settings={**plain(source.setup), **stated},
        work=work,
    )


def _leaning(lab: Laboratory, curves: list[laboratory.MeasuredValues]) -> model.JoystickParameters:
    """Return the joystick with the measured geometry and clearance, which determine its angle at rest."""
    geometry = {name: lab.given.values[name] for name in ("a", "b") if name in lab.given.values}
    values = geometry | {name: value for one in curves for name, value in one.values.items()}
    return lab.base.joystick.replace(values)


def table(lab: Laboratory, source: TableSource, file: str) -> Step:
    """Return the step that makes a record from a table of time and angle."""
    record = record_file(file)
    figure, report = record.replace(".csv", ".png"), record.replace(".csv", ".md")

    def work(tell: Tell) -> Done:
        log = motion.read_log(
            lab.root / file,
            columns=source.columns,
            units=source.units,
            layout=source.layout,
            scales=source.scales,
            rate=source.rate,
            start=-math.inf if source.start is None else source.start,
            end=math.inf if source.end is None else source.end,
        )
        laboratory.write_log(log, lab.root / record)
        support.save_figure(laboratory.plot_log(log), lab.root / figure)
        write_text(lab.root / report, f"# {Path(file).name}\n\n{laboratory.log_report(log)}\n")
        names = ", ".join(name for name in log.series if name != "time")
        remark = f"{len(log.series['time'])} samples of {names}"
        return Done(files=(record, figure, report), remark=remark, notes=log.notes)

    settings = {key: value for key, value in plain(source).items() if key != "files"}
    return Step(
        name=f"record {Path(record).stem}", inputs=(file,), outputs=(record,), settings=settings, work=work
    )


def accelerometer(lab: Laboratory, source: AccelerometerSource, record: str) -> Step:
    """Return the step that compares an accelerometer with the record of the same motion."""
    stem = Path(source.file).stem
    result, report = (f"{RESULTS}/accelerometers/{stem}{suffix}" for suffix in (".csv", ".md"))

    def work(tell: Tell) -> Done:
        angle = motion.read_record(lab.root / record, free_oscillation=False)
        found = laboratory.compare_accelerometer(lab.root / source.file, angle, source.setup)
        found.write(lab.root / result)
        write_text(lab.root / report, f"# {Path(source.file).name}\n\n{found.report()}\n")
        rms = found.found.differences
        share = 100.0 * rms["less gravity"] / rms["differentiated"]
        remark = f"differs by {share:.1f} % rms, its clock by {found.found.lag:+.4f} s"
        return Done(files=(result, report), remark=remark, notes=found.notes)

    return Step(
        name=f"accelerometer {stem}",
        inputs=(source.file, record),
        outputs=(),
        settings=plain(source.setup),
        work=work,
    )


def _stated(lab: Laboratory, names: tuple[str, ...]) -> dict[str, object]:
    """Return the values and uncertainties that laboratory.toml states for some quantities."""
    given = lab.given
    values = {name: given.values.get(name) for name in names}
    errors = {f"u_{name}": given.uncertainties.get(laboratory.PLACES[name]) for name in names}
    return {name: value for name, value in (values | errors).items() if value is not None}


def _asking(lab: Laboratory) -> dict[str, object]:
    return {} if lab.asks else {"implausible": True}


def _require_plausible(lab: Laboratory, found: laboratory.MeasuredValues) -> None:
    """Refuse implausible values unless laboratory.toml accepts them."""
    for name, value in found.values.items() if lab.asks else ():
        model.require_plausible(name, value, insist="implausible = true in laboratory.toml accepts it")
