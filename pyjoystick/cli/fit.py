"""``pyjoystick fit``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Final

import typer
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

from pyjoystick import fmu, identification, model, motion
from pyjoystick.cli import options
from pyjoystick.cli.console import messages, output, print_error, print_note, print_notes
from pyjoystick.cli.fmus import found_or_built, law_of
from pyjoystick.cli.parameter_updates import file_to_update, write_update
from pyjoystick.support import check_outputs, write_text

EXAMPLES: Final = """
Examples:

    pyjoystick fit trial1.csv trial2.csv trial3.csv trial4.csv
    pyjoystick fit trial*.csv --damping power-law --output results/fit
    pyjoystick fit trial*.csv --settings fit.toml --output results/fit
    pyjoystick fit trial*.csv --parameters joystick.toml --update

Settings that fit J and C to releases, each with an angle and a time of its own:

    fmu.path = "Joystick"
    free.J = {}
    free."damping.C" = {}
    free.theta_start = { per_record = true }
    free.release_time = { per_record = true }
"""
#: Exit code of a fit that failed a check, and after Ctrl-C.
DOUBTFUL: Final = 3
INTERRUPTED: Final = 130


def run(
    paths: options.Records,
    settings_file: Annotated[
        Path | None,
        typer.Option(
            "--settings",
            metavar="FILE",
            help="Settings of the fit, a TOML file. Default: fit the damping and the release of each record.",
        ),
    ] = None,
    damping: Annotated[
        model.LawName | None,
        typer.Option("--damping", help="Damping law to fit. Default: that of --parameters, else constant."),
    ] = None,
    parameters: options.Parameters = None,
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
    columns: options.Columns = None,
    units: options.Units = None,
) -> None:
    """Fit parameters to measured motion and report how certain they are.

    The exit code is 3 if the result failed a check; the reasons are printed. It is 130 after Ctrl-C, 143
    after SIGTERM; what was found by then is printed and written.
    """
    if settings_file is not None and damping is not None:
        raise typer.BadParameter("give --settings or --damping: the settings name the FMU")
    if update and parameters is None:
        raise typer.BadParameter("needs --parameters, the file to update", param_hint="--update")
    if even_if_doubtful and not update:
        raise typer.BadParameter("is for --update", param_hint="--even-if-doubtful")
    headings = options.parse_headings(columns, units)
    check_outputs(parameters if update else None, None if folder is None else folder / "fit.md")
    given = file_to_update(parameters) if update else options.parameter_file(parameters)
    settings = _settings(settings_file, damping or given.law)
    with fmu.Fmu(found_or_built(settings.fmu)) as opened:
        joystick = given.with_law(law_of(opened.description)) if parameters is not None else None
        if joystick is not None:
            values = joystick.to_names()
            settings = identification.with_values(settings, values, replace_starts=settings_file is None)
        if update:
            identification.require_joystick_in(settings)
        records = _records(paths, settings, opened.description, headings)
        try:
            with _progress() as tell:
                found = identification.fit(records, settings, fmu=opened, on_progress=tell)
        except (identification.FitInterruptedError, KeyboardInterrupt):
            print_error(str(identification.FitInterruptedError()))
            raise typer.Exit(INTERRUPTED) from None
    names = ", ".join(path.name for path in paths)
    _show(found, folder, names)
    if update and parameters is not None and joystick is not None:
        doubts = "it was stopped" if found.interrupted else failed_checks(found)
        if doubts and not even_if_doubtful:
            print_note(f"{parameters} is unchanged; --even-if-doubtful saves the result anyway")
        else:
            _update(parameters, found, joystick, given.uncertainties, names, doubts)
    if found.interrupted or not found.trusted:
        raise typer.Exit(INTERRUPTED if found.interrupted else DOUBTFUL)


def failed_checks(found: identification.Fit) -> str:
    """The names of the checks that a fit failed; empty if it passed all of them."""
    return ", ".join(check.name for check in found.checks if not check.passed)


def _settings(file: Path | None, law: model.LawName) -> identification.FitSettings:
    if file is not None:
        return identification.read_fit_settings(file, found_or_built)
    return identification.POWER_LAW_DAMPING if law == "power-law" else identification.CONSTANT_DAMPING


def _records(
    paths: Sequence[Path],
    settings: identification.FitSettings,
    description: fmu.FmuDescription,
    headings: Mapping[str, Mapping[str, str]],
) -> Sequence[motion.Record | identification.Measurement]:
    if not identification.reads_releases(settings):
        names = (*settings.outputs, *settings.inputs)
        return [identification.read_table_record(path, names, description) for path in paths]
    records = motion.read_repeats(paths, columns=headings["columns"], units=headings["units"])
    for record in records:
        print_notes(record.name, record.notes)
    return records


def _show(found: identification.Fit, folder: Path | None, names: str) -> None:
    # Plain text: labels such as [run 1] are not markup.
    output().print(identification.summary(found), markup=False)
    if folder is not None:
        write_text(folder / "fit.md", identification.report(found, f"Fit to {names}"))
        write_text(folder / "fit.json", identification.as_json(found))
        figures = identification.save_figures(found, folder)
        print_note(f"wrote fit.md, fit.json, {', '.join(path.name for path in figures)} into {folder}")
        profiles = folder / identification.PROFILES
        if not found.profiles and profiles.exists():
            print_note(f"{profiles} belongs to an earlier fit: this one has no profiles")
    if not found.trusted:
        print_error(f"do not trust this fit: it failed {failed_checks(found)} (see above)")


def _update(
    path: Path,
    found: identification.Fit,
    before: model.JoystickParameters,
    uncertainties: Mapping[str, float],
    names: str,
    doubts: str,
) -> None:
    """Write the fitted joystick into its file."""
    fitted = identification.fitted_joystick(found, before, uncertainties)
    source = f"fit to {names}" + (f"; doubtful: {doubts}" if doubts else "")
    sources = dict.fromkeys(fitted.tables, source)
    sources |= dict.fromkeys(fitted.fixed, f"as fixed in the {source}")
    write_update(path, fitted.joystick, fitted.uncertainties, sources)


@contextmanager
def _progress() -> Iterator[identification.OnProgress]:
    """A bar for each stage, which pulses where it has only one part; drawn on a terminal only."""
    console = messages()
    columns = (TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("searching", total=None)

        def tell(stage: str, done: int, total: int) -> None:
            several = total > 1
            text = f"{stage} {done}/{total}" if several else stage
            bar.update(task, description=text, completed=done)
            bar.tasks[0].total = total if several else None  # None is "as it was" to update

        yield tell
