"""Steps from records to the fit and the errors of its parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Final

from pyjoystick import fmu, identification, model, motion, runs, support
from pyjoystick.reports.project.laboratory import Laboratory, plain
from pyjoystick.reports.project.measuring import MEASURED, fitted_curve
from pyjoystick.reports.project.sources import table_of, table_sources
from pyjoystick.reports.project.steps import RESULTS, Done, Find, Step, Tell, content_of
from pyjoystick.support import PyJoystickError, read_toml, write_text

PEAKS: Final = f"{RESULTS}/peaks"
FIT: Final = f"{RESULTS}/fit"
BUDGET: Final = f"{RESULTS}/budget"
BUDGET_JSON: Final = f"{BUDGET}/budget.json"
FIT_JSON: Final = f"{FIT}/fit.json"
#: Parameter file of the fitted joystick, written if the fit passed its checks or doubtful fits are accepted.
FITTED: Final = f"{FIT}/joystick.toml"


def peaks(lab: Laboratory, records: tuple[str, ...], find: Find, *, inertia_known: bool) -> Step:
    """Return the step that estimates the damping from the peaks of releases, with its bias.

    The damping is proportional to J; if J is not known, its estimate from the swings is used.
    """
    report, table, figure = (f"{PEAKS}/peaks{suffix}" for suffix in (".md", ".json", ".png"))

    def work(tell: Tell) -> Done:
        joystick = model.read_parameter_file(lab.root / MEASURED).joystick
        read = motion.read_repeats([lab.root / one for one in records])
        joystick, notes = _swinging(joystick, read, inertia_known=inertia_known)
        releases = [motion.measured_peaks(record) for record in read]
        estimate = identification.estimate_damping(releases, joystick.J)
        with runs.SimulatedReleases() as simulate:
            tell("simulating")
            constants, lines = identification.biases(estimate, joystick, releases, simulate)
        text = "\n\n".join(
            (
                "# Damping from the peaks",
                identification.releases_report(releases),
                identification.damping_report(estimate, constants, lines),
            )
        )
        write_text(lab.root / report, f"{text}\n")
        write_text(lab.root / table, identification.damping_json(releases, estimate, constants, lines))
        constant = constants["both"].corrected
        support.save_figure(
            identification.plot_damping_estimate(estimate, constant=constant), lab.root / figure
        )
        return Done(files=(report, table, figure), remark=f"C = {constant:.4g} N m s/rad", notes=notes)

    # The bias of the method is determined from simulated releases with both damping laws.
    contents = {name: content_of(name, find) for name in standard_fmus(lab)}
    settings = {"FMUs": contents, "inertia known": inertia_known}
    return Step(name="peaks", inputs=(*records, MEASURED), outputs=(), settings=settings, work=work)


def _swinging(
    joystick: model.JoystickParameters, records: Sequence[motion.Record], *, inertia_known: bool
) -> tuple[model.JoystickParameters, tuple[str, ...]]:
    """Return the joystick, with J estimated from the swings if it is not known, and notes on J."""
    found = None if inertia_known else identification.swing_estimate(joystick, records)
    if found is None:
        return joystick, identification.inertia_doubts(joystick, records)
    note = (
        f"J is not measured: C is based on J = {found.J:.3g} kg m2, from the swings; the fit determines both"
    )
    return joystick.replace({"J": found.J}), (note,)


def fit(lab: Laboratory, records: tuple[str, ...], sources: Mapping[str, str], find: Find) -> Step:
    """Return the step that fits the joystick to the records."""
    choice = lab.fit

    def work(tell: Tell) -> Done:
        given = model.read_parameter_file(lab.root / MEASURED)
        settings = _settings(lab, find)
        with fmu.Fmu(find(settings.fmu)) as opened:
            joystick = given.with_law(runs.law_of_fmu(opened.description))
            settings = identification.with_values(
                settings, joystick.to_names(), replace_starts=not choice.file
            )
            known = identification.known_values(given, model.law_name(joystick.damping), choice.known)
            settings = identification.with_known(settings, *known)
            identification.require_joystick_in(settings)
            paths = [lab.root / one for one in records]
            read = identification.read_records(paths, settings, opened.description)
            if not choice.file:
                settings = identification.with_estimated_starts(settings, joystick, read)
            found = _fitted(read, settings, opened, tell)
        return _saved_fit(lab, found, given, joystick, records, sources)

    return Step(
        name="fit",
        inputs=tuple(filter(None, (*records, MEASURED, choice.file))),
        outputs=(FITTED, FIT_JSON),
        settings={**plain(choice), "sources": dict(sources), "FMU": _fmu_content(lab, find)},
        work=work,
    )


def _fmu_content(lab: Laboratory, find: Find) -> str:
    """Return the digest of the fit's FMU, which changes when the FMU is rebuilt."""
    if not lab.fit.file:
        return content_of(_standard(lab).fmu, find)
    try:
        name = str(read_toml(lab.root / lab.fit.file).table("fmu").text("path"))
    except PyJoystickError:  # the step itself reports the error
        return ""
    return content_of(name if name in fmu.MODELS else str((lab.root / lab.fit.file).parent / name), find)


def standard_fmus(lab: Laboratory) -> tuple[str, str]:
    """Return the FMUs for the laboratory's joystick, with constant damping and with eq. (11)."""
    joystick = lab.base.joystick
    if any(one.friction for one in lab.curves.values()):
        joystick = joystick.replace({"friction.F_c": 1.0})  # any value but 0; the curves determine it later
    constant, power_law = (
        runs.fmu_with_parts(runs.FMU_OF_LAW[law], joystick) for law in ("constant", "power-law")
    )
    return constant, power_law


def _standard(lab: Laboratory) -> identification.FitSettings:
    """Return the standard settings: a fit of J and C, which releases determine together, or of eq. (11)."""
    constant, power_law = standard_fmus(lab)
    settings = replace(identification.POWER_LAW_DAMPING, fmu=power_law)
    if lab.fit.law == "constant":
        free = (identification.Free("J"), identification.Free("damping.C", minimum=0.0))
        settings = identification.FitSettings(fmu=constant, free=(*free, *identification.RELEASE))
    return settings


def _settings(lab: Laboratory, find: Find) -> identification.FitSettings:
    if not lab.fit.file:
        return _standard(lab)
    root = read_toml(lab.root / lab.fit.file)
    if "parameters" in root.table("fmu"):
        allowed = "must be left out in a project: the fit uses the measured values"
        raise root.table("fmu").error("parameters", allowed)
    return identification.read_fit_settings(root, find)


def frees(lab: Laboratory, name: str) -> bool:
    """Return whether the fit determines a parameter."""
    if not lab.fit.file:
        return any(one.name == name for one in _standard(lab).free)
    try:
        return name in read_toml(lab.root / lab.fit.file).table("free").content
    except PyJoystickError:  # the step itself reports the error
        return True


def _fitted(
    records: list[motion.Record | identification.Measurement],
    settings: identification.FitSettings,
    opened: fmu.Fmu,
    tell: Tell,
) -> identification.Fit:
    """Run the fit; raise KeyboardInterrupt if it was interrupted."""

    def progress(stage: str, done: int, total: int) -> None:
        tell(f"{stage} {done}/{total}" if total > 1 else stage)

    found = identification.fit(records, settings, fmu=opened, on_progress=progress)
    if found.interrupted:
        raise KeyboardInterrupt
    return found


def _saved_fit(
    lab: Laboratory,
    found: identification.Fit,
    given: model.ParameterFile,
    joystick: model.JoystickParameters,
    records: tuple[str, ...],
    sources: Mapping[str, str],
) -> Done:
    """Write the report of a fit and, if it can be trusted or doubtful fits are accepted, its joystick."""
    names = ", ".join(Path(one).name for one in records)
    files = [path.name for path in identification.save_fit(found, lab.root / FIT, f"Fit to {names}")]
    failed = ", ".join(found.failed)
    if failed and not lab.fit.even_if_doubtful:
        (lab.root / FITTED).unlink(missing_ok=True)
        note = (
            f"do not trust this fit: it failed the checks {failed}; {FIT}/fit.md says why. "
            "set [fit] even_if_doubtful = true to continue anyway"
        )
        return Done(files=tuple(f"{FIT}/{one}" for one in files), remark=f"failed {failed}", notes=(note,))
    fitted = identification.fitted_joystick(found, joystick, given.uncertainties)
    source = f"fit to {names}" + (f"; doubtful: {failed}" if failed else "")
    before, after = joystick.to_names(), fitted.joystick
    changed = [name for name, value in after.to_names().items() if value != before.get(name, 0.0)]
    new = {
        name: source if table_of(name, after) in fitted.tables else f"as fixed in the {source}"
        for name in changed
    }
    text = model.updated_text(
        given,
        after,
        uncertainties={place: model.rounded_error(error) for place, error in fitted.uncertainties.items()},
        sources=table_sources({**sources, **new}, after, lab.base),
    )
    write_text(lab.root / FITTED, text)
    values = ", ".join(
        f"{name} = {model.rounded(value, found.error(name)):.9g}" for name, value in found.shared().items()
    )
    notes = (f"doubtful: it failed {failed}",) if failed else ()
    return Done(files=tuple(f"{FIT}/{one}" for one in (*files, "joystick.toml")), remark=values, notes=notes)


def budget(lab: Laboratory, records: tuple[str, ...], curves: tuple[model.Side, ...], find: Find) -> Step:
    """Return the step that computes what each measured quantity contributes to the errors of J and C."""
    report, csv, result = f"{BUDGET}/budget.md", f"{BUDGET}/budget.csv", BUDGET_JSON
    scale = lab.angle_scale()

    def work(tell: Tell) -> Done:
        file = model.read_parameter_file(lab.root / MEASURED)
        tell("load curves")
        bench = identification.Bench(
            joystick=file.with_law("constant"),
            curves={side: fitted_curve(lab.root, lab.curves[side]) for side in curves},
            uncertainties=identification.stated_uncertainties(file),
            scale=scale,
            time_base=lab.time_base,
            force_scale=lab.force_scale,
        )
        read = motion.read_repeats([lab.root / one for one in records], counted=False)
        tell("fitting")
        with fmu.Fmu(find(bench.fmu)) as opened:
            found, contributions = identification.fit_contributions(
                read, bench, opened, release_angle=lab.release_angle
            )
        table = identification.contribution_table(contributions)
        write_text(lab.root / report, f"# Error budget of J and C\n\n{table}\n")
        write_text(lab.root / csv, identification.contribution_csv(contributions))
        write_text(lab.root / result, identification.contribution_json(found, contributions, bench.exact))
        parts = zip(identification.FITTED, identification.combined(contributions), strict=True)
        return Done(
            files=(report, csv, result),
            remark=", ".join(f"{name} to {100.0 * part:.2g} %" for name, part in parts),
            notes=(f"taken as exact: {', '.join(bench.exact)}",) if bench.exact else (),
        )

    return Step(
        name="error budget",
        inputs=(*records, MEASURED, FITTED, *(lab.curves[side].file for side in curves)),
        outputs=(result,),
        settings={
            "curves": {side: plain(lab.curves[side]) for side in curves},
            "u_scale": scale,
            "u_time_base": lab.time_base,
            "u_force_scale": lab.force_scale,
            "release_angle": lab.release_angle,
            "FMU": content_of(standard_fmus(lab)[0], find),
        },
        work=work,
    )
