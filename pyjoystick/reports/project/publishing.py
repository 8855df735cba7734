"""Steps from the parameter file of the joystick to files for others: FMUs and a report."""

from __future__ import annotations

from pyjoystick import fmu, model, reports, runs
from pyjoystick.reports.project.concluding import JOYSTICK
from pyjoystick.reports.project.evaluating import BUDGET_JSON, FIT_JSON, standard_fmus
from pyjoystick.reports.project.laboratory import Laboratory, plain
from pyjoystick.reports.project.measuring import fitted_curve
from pyjoystick.reports.project.steps import RESULTS, Done, Find, Step, Tell, content_of
from pyjoystick.support import version_of, write_text

_FMUS = f"{RESULTS}/fmus"
_REPORT = f"{RESULTS}/report.html"


def fmus(lab: Laboratory, *, with_fit: bool) -> Step:
    """Return the step that exports the joystick as FMUs, and in the other formats that are chosen."""
    choice = lab.fmus
    fit = lab.root / FIT_JSON if with_fit else None

    def work(tell: Tell) -> Done:
        file = model.read_parameter_file(lab.root / JOYSTICK)
        name = choice.name or reports.default_name(file)
        several = len(choice.versions) > 1
        files = []
        for version in choice.versions:
            folder = f"{_FMUS}/fmi{version}" if several else _FMUS
            built = reports.export_fmus(
                file,
                lab.root / folder,
                name=name,
                fmi_version="3.0" if version == 3 else "2.0",
                platforms=choice.platforms,
                fit=fit,
                on_stage=tell,
            )
            files += [f"{folder}/{path.name}" for path in built]
            if choice.ssp:
                files.append(f"{folder}/{name}.ssp")
                reports.export_ssp(file, built[0], lab.root / files[-1])
        texts = {}
        if choice.modelica:
            texts[f"{_FMUS}/{name}.mo"] = reports.modelica_class(
                name, model.fmu_values(file), law=file.law, title=file.title
            )
        if choice.json:
            texts[f"{_FMUS}/{name}.json"] = model.values_json(file)
        for path, text in texts.items():
            write_text(lab.root / path, text)
        written = (*files, *texts)
        return Done(files=written, remark=", ".join(one.removeprefix(f"{_FMUS}/") for one in written))

    return Step(
        name="FMUs",
        inputs=(JOYSTICK, FIT_JSON) if with_fit else (JOYSTICK,),
        outputs=(),
        settings={**plain(choice), "rumoca": version_of("rumoca"), "ziglang": version_of("ziglang")},
        work=work,
    )


def report(
    lab: Laboratory,
    find: Find,
    *,
    sides: tuple[model.Side, ...],
    with_parts: bool,
    with_swing: bool,
    with_fit: bool,
    with_budget: bool,
) -> Step:
    """Return the step that writes the report, one page that includes the measurements.

    Args:
        lab: the laboratory
        find: function that returns the file for the name of an FMU
        sides: sides whose load-deflection curves were measured
        with_parts: whether there is a table of parts
        with_swing: whether there is a recorded swing
        with_fit: whether there is a fit
        with_budget: whether there is an error budget
    """
    contents = {name: content_of(name, find) for name in standard_fmus(lab)}
    swing = lab.swing.file if with_swing and lab.swing else ""
    files = {
        "fit": FIT_JSON if with_fit else "",
        "swing": swing,
        "parts": lab.parts if with_parts else "",
        "budget": BUDGET_JSON if with_budget else "",
    }
    given = {name: path for name, path in files.items() if path}
    curves = {side: lab.curves[side] for side in sides}

    def work(tell: Tell) -> Done:
        file = model.read_parameter_file(lab.root / JOYSTICK)
        with fmu.Fmu(find(runs.fmu_of_joystick(file.joystick))) as opened:
            study = reports.Study(file.joystick, opened, lab.release_angle, file.pivot_to_top)
            measurements = reports.read_measurements(
                file,
                curves={side: lab.root / one.file for side, one in curves.items()},
                curve_fits={side: fitted_curve(lab.root, one) for side, one in curves.items()},
                **{name: lab.root / path for name, path in given.items()},
            )
            text = reports.joystick_report(
                study, measurements=measurements, title=file.title, on_section=tell
            )
        write_text(lab.root / _REPORT, text)
        return Done(files=(_REPORT,), remark=f"{_REPORT}, {len(text.encode()) / 1e6:.1f} MB")

    return Step(
        name="report",
        inputs=(JOYSTICK, *given.values(), *(one.file for one in curves.values())),
        outputs=(),
        settings={
            "release_angle": lab.release_angle,
            "FMUs": contents,
            "curves": {side: plain(one) for side, one in curves.items()},
        },
        work=work,
    )
