"""``pyjoystick fit``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Final

import typer
from rich.progress import BarColumn, TextColumn, TimeElapsedColumn

from pyjoystick import fmu, identification, model, motion, runs, support
from pyjoystick.cli import joystick_choice, options, parsing
from pyjoystick.cli.console import (
    output,
    print_error,
    print_progress,
    print_warning,
    print_warnings,
    progress_bar,
    write_json,
)
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.invocation import INTERRUPTED, invocation
from pyjoystick.cli.parameter_updates import file_to_update, write_update
from pyjoystick.cli.plausibility import require_uncertainties

EXAMPLES: Final = """
Examples:

    pyjoystick fit trial1.csv trial2.csv trial3.csv trial4.csv
    pyjoystick fit trial*.csv --damping power-law --output results/fit
    pyjoystick fit trial*.csv --settings fit.toml --output results/fit
    pyjoystick fit trial*.csv --friction --output results/fit
    pyjoystick fit trial*.csv --parameters joystick.toml --friction --known friction.F_c
    pyjoystick fit hand*.csv --driven --output results/fit
    pyjoystick fit trial*.csv --parameters joystick.toml --update

Settings that fit J and C to releases, each with an angle and a time of its own:

    fmu.path = "Joystick"
    free.J = {}
    free."damping.C" = {}
    free.theta_start = { per_record = true }
    free.release_time = { per_record = true }
"""
#: Exit code of a fit that failed a check.
DOUBTFUL: Final = 3


def run(
    paths: options.Records,
    settings_file: Annotated[
        Path | None,
        typer.Option(
            "--settings",
            metavar="FILE",
            help="TOML file with the settings of the fit. "
            "Default: fit the damping and the release of each record.",
        ),
    ] = None,
    damping: Annotated[
        model.LawName | None,
        typer.Option("--damping", help="Damping law to fit. Default: that of --parameters, else constant."),
    ] = None,
    is_driven: Annotated[
        bool,
        typer.Option(
            "--driven",
            help="The records have a column T with the driving torque: fit J, the damping and "
            "the delay between the channels.",
        ),
    ] = False,
    friction: Annotated[
        bool,
        typer.Option("--friction", help="Also fit dry friction at the pivot (T_c)."),
    ] = False,
    parameters: options.Parameters = None,
    known: Annotated[
        list[str] | None,
        typer.Option(
            "--known",
            metavar="NAME",
            help="A parameter that --parameters gives with an uncertainty: fit it too, and count its value "
            "as one more measurement; repeatable. A pattern such as '*Spring.x_0' stands for several. It "
            "must have been measured without these records; a value saved by `fit --update` is refused.",
        ),
    ] = None,
    force_scale: Annotated[
        float | None,
        typer.Option(
            "--force-scale",
            metavar="PART",
            help="Relative standard uncertainty of the load cell's calibration, such as 0.005. The fit then "
            "varies all spring forces of --parameters by one common factor, and counts the calibration as "
            "one more measurement.",
        ),
    ] = None,
    update: Annotated[
        bool,
        typer.Option(
            "--update",
            help="Save the result in the file of --parameters if it passes every check; a new file starts "
            "with the paper's values.",
        ),
    ] = False,
    even_if_doubtful: Annotated[
        bool, typer.Option("--even-if-doubtful", help="Let --update save a result that failed a check.")
    ] = False,
    folder: Annotated[
        Path | None,
        typer.Option(
            "--output", "-o", metavar="FOLDER", help="Write fit.md, fit.json and the figures to this folder."
        ),
    ] = None,
    json: Annotated[Path | None, options.json("what --output writes to fit.json")] = None,
    both_sides: Annotated[
        bool, typer.Option("--both-sides", help="Accept records with releases from both sides.")
    ] = False,
    columns: options.Columns = None,
    units: options.Units = None,
) -> None:
    """Fit parameters to measured motion and report how certain they are.

    The exit code is 3 if the result failed a check; the reasons are printed. It is 130 after Ctrl-C and 143
    after SIGTERM; results found by then are printed and written.
    """
    _check_choice(settings_file, damping, is_driven=is_driven, friction=friction)
    measured = {"--known": known, "--force-scale": force_scale}
    _check_file(parameters, measured, update=update, even_if_doubtful=even_if_doubtful)
    headings = parsing.parse_headings(columns, units)
    support.check_outputs(parameters if update else None, None if folder is None else folder / "fit.md", json)
    given = file_to_update(parameters) if update else joystick_choice.parameter_file(parameters)
    settings = settings_of(settings_file, damping or given.law, is_driven=is_driven, friction=friction)
    if settings_file is None:
        settings = replace(settings, fmu=runs.fmu_with_parts(settings.fmu, given.joystick))
    if not identification.reads_releases(settings):
        _refuse_for_tables(
            settings, {"--both-sides": both_sides or None, "--column": columns, "--unit": units}
        )
    with fmu.Fmu(found_or_built(settings.fmu)) as opened:
        joystick = given.with_law(runs.law_of_fmu(opened.description)) if parameters is not None else None
        if joystick is not None:
            values = joystick.to_names()
            settings = identification.with_values(settings, values, replace_starts=settings_file is None)
            settings = _with_measured(settings, given, joystick, known or (), force_scale)
        if update:
            identification.require_joystick_in(settings)
        records = identification.read_records(
            paths, settings, opened.description, **headings, both_sides=both_sides
        )
        for record in records:
            print_warnings(record.name, record.notes if isinstance(record, motion.Record) else ())
        settings = _begun(settings, joystick if settings_file is None else None, records)
        try:
            with _progress() as tell:
                found = identification.fit(records, settings, fmu=opened, on_progress=tell)
        except (identification.FitInterruptedError, KeyboardInterrupt):
            print_error(str(identification.FitInterruptedError()))
            raise typer.Exit(INTERRUPTED) from None
    names = ", ".join(path.name for path in paths)
    _show(found, folder, names)
    write_json(json, lambda notes: identification.as_json(found, notes))
    if update and parameters is not None and joystick is not None:
        doubts = "it was stopped" if found.interrupted else ", ".join(found.failed)
        if doubts and not even_if_doubtful:
            print_warning(f"{parameters} is unchanged; --even-if-doubtful saves the result anyway")
        else:
            _update(parameters, found, joystick, given.uncertainties, names, doubts)
    if found.interrupted or not found.trusted:
        raise typer.Exit(INTERRUPTED if found.interrupted else DOUBTFUL)


def _begun(
    settings: identification.FitSettings,
    joystick: model.JoystickParameters | None,
    records: Sequence[motion.Record | identification.Measurement],
) -> identification.FitSettings:
    """The settings with starts as the records show them, where those of the file are far from that."""
    if joystick is None:
        return settings
    return identification.with_estimated_starts(settings, joystick, records)


def _with_measured(
    settings: identification.FitSettings,
    file: model.ParameterFile,
    joystick: model.JoystickParameters,
    known: Sequence[str],
    force_scale: float | None,
) -> identification.FitSettings:
    """The settings with measurements that the fit may change within their uncertainties."""
    settings = identification.with_known(settings, *_known(file, model.law_name(joystick.damping), known))
    if force_scale is None:
        return settings
    require_uncertainties({"force_scale": force_scale}, {"force_scale": 1.0}, option="--force-scale")
    return identification.with_force_scale(settings, joystick, force_scale)


def _known(
    file: model.ParameterFile, law: model.LawName, names: Sequence[str]
) -> tuple[Mapping[str, float], Mapping[str, float]]:
    """Values and standard uncertainties of parameters, by name."""
    try:
        return identification.known_values(file, law, names)
    except support.ParameterError as error:
        raise typer.BadParameter(f"{error.value} must be {error.allowed}", param_hint="--known") from error


def _check_choice(file: Path | None, law: model.LawName | None, *, is_driven: bool, friction: bool) -> None:
    """Reject options that the settings file decides."""
    if file is not None and law is not None:
        raise typer.BadParameter("use --settings or --damping, not both: the settings name the FMU")
    if file is not None and is_driven:
        raise typer.BadParameter('use --settings or --driven, not both: the settings say inputs = ["T"]')
    if file is not None and friction:
        raise typer.BadParameter("use --settings or --friction, not both: the settings name the FMU")


def _check_file(
    parameters: Path | None, measured: Mapping[str, object], *, update: bool, even_if_doubtful: bool
) -> None:
    """Reject options that need a file when --parameters is missing."""
    if parameters is None:
        parsing.refuse_given("needs --parameters", {"--update": update or None, **measured})
    if even_if_doubtful and not update:
        raise typer.BadParameter("is for --update", param_hint="--even-if-doubtful")


def settings_of(
    file: Path | None, law: model.LawName, *, is_driven: bool = False, friction: bool = False
) -> identification.FitSettings:
    """Settings of a file or, without one, of a damping law."""
    if file is not None:
        return identification.read_fit_settings(file, found_or_built)
    power_law = law == "power-law"
    settings = identification.POWER_LAW_DAMPING if power_law else identification.CONSTANT_DAMPING
    settings = identification.driven(settings) if is_driven else settings
    return identification.with_friction(settings) if friction else settings


def _refuse_for_tables(settings: identification.FitSettings, given: Mapping[str, object]) -> None:
    """Reject options for releases if records are tables, which have headings from the FMU and no side."""
    names = ", ".join(("time", *settings.outputs, *settings.inputs))
    parsing.refuse_given(f"is for releases; these records are tables of {names}", given)


def _show(found: identification.Fit, folder: Path | None, names: str) -> None:
    # Plain text: labels such as [run 1] are not markup.
    output().print(identification.summary(found), markup=False)
    if folder is not None:
        files = identification.save_fit(found, folder, f"Fit to {names}", invocation.notes)
        print_progress(f"wrote {', '.join(path.name for path in files)} into {folder}")
        profiles = folder / identification.PROFILES
        if not found.profiles and profiles.exists():
            print_warning(f"{profiles} belongs to an earlier fit: this one has no profiles")
    if not found.trusted:
        print_error(f"do not trust this fit: it failed {', '.join(found.failed)} (see above)")


def _update(
    path: Path,
    found: identification.Fit,
    before: model.JoystickParameters,
    uncertainties: Mapping[str, float],
    names: str,
    doubts: str,
) -> None:
    """Save the fitted joystick in its file."""
    fitted = identification.fitted_joystick(found, before, uncertainties)
    source = f"fit to {names}" + (f"; doubtful: {doubts}" if doubts else "")
    sources = dict.fromkeys(fitted.tables, source)
    sources |= dict.fromkeys(fitted.fixed, f"as fixed in the {source}")
    write_update(path, fitted.joystick, fitted.uncertainties, sources)


@contextmanager
def _progress() -> Iterator[identification.OnProgress]:
    """Progress bar for each stage, pulsing if the stage has one part; drawn only on a terminal."""
    with progress_bar(TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()) as bar:
        task = bar.add_task("searching", total=None)

        def tell(stage: str, done: int, total: int) -> None:
            several = total > 1
            text = f"{stage} {done}/{total}" if several else stage
            bar.update(task, description=text, completed=done)
            bar.tasks[0].total = total if several else None  # for `update`, None means unchanged

        yield tell
