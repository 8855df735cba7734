"""The steps of ``pyjoystick fit``: read the records, fit, print and write what came of it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from pyjoystick.cli.console import messages, output, print_error, print_note
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.options import DampingLaw, law_of, parameter_file
from pyjoystick.cli.parameter_updates import file_to_update, write_update
from pyjoystick.fmu import Fmu, FmuDescription
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    POWER_LAW_DAMPING,
    PROFILES,
    Fit,
    FitInterruptedError,
    FitSettings,
    Measurement,
    OnProgress,
    as_json,
    fit as carry_out,
    fitted_joystick,
    read_fit_settings,
    read_table_record,
    reads_releases,
    report,
    require_joystick_in,
    save_figures,
    summary,
    with_values,
)
from pyjoystick.model import JoystickParameters
from pyjoystick.motion import Record, read_repeats
from pyjoystick.support import check_outputs, write_text

#: Exit code where a fit is done but not to be trusted, and after Ctrl-C.
DOUBTFUL: Final = 3
INTERRUPTED: Final = 130


@dataclass(frozen=True, slots=True)
class Wanted:
    """What is to be written besides the summary.

    Attributes:
        folder: for report and figures
        joystick: parameter file that the fit updates
        even_if_doubtful: whether it does so where the fit is not to be trusted
    """

    folder: Path | None
    joystick: Path | None
    even_if_doubtful: bool


def fit_and_show(
    paths: Sequence[Path],
    settings_file: Path | None,
    damping: DampingLaw | None,
    parameters: Path | None,
    wanted: Wanted,
    *,
    columns: Mapping[str, str],
    units: Mapping[str, str],
) -> int:
    """Fit the records of some files; returns the exit code."""
    check_outputs(wanted.joystick, None if wanted.folder is None else wanted.folder / "fit.md")
    given = parameter_file(parameters) if wanted.joystick is None else file_to_update(wanted.joystick)
    settings = _settings(settings_file, damping or DampingLaw(given.law))
    with Fmu(found_or_built(settings.fmu)) as fmu:
        joystick = None
        if parameters is not None:
            joystick = given.with_law(law_of(fmu.description).value)
            settings = with_values(settings, joystick.to_names(), replace_starts=settings_file is None)
        if wanted.joystick is not None:
            require_joystick_in(settings)
        records = _records(paths, settings, fmu.description, columns, units)
        try:
            with _progress() as tell:
                found = carry_out(records, settings, fmu=fmu, on_progress=tell)
        except (FitInterruptedError, KeyboardInterrupt):
            print_error(str(FitInterruptedError()))
            return INTERRUPTED
    names = ", ".join(path.name for path in paths)
    _show(found, wanted.folder, names)
    if wanted.joystick is not None and joystick is not None:
        _update(found, wanted, joystick, given.uncertainties, names)
    if found.interrupted:
        return INTERRUPTED
    return 0 if found.trusted else DOUBTFUL


def _settings(file: Path | None, law: DampingLaw) -> FitSettings:
    if file is not None:
        return read_fit_settings(file, found_or_built)
    return POWER_LAW_DAMPING if law is DampingLaw.POWER_LAW else CONSTANT_DAMPING


def _records(
    paths: Sequence[Path],
    settings: FitSettings,
    fmu: FmuDescription,
    columns: Mapping[str, str],
    units: Mapping[str, str],
) -> Sequence[Record | Measurement]:
    if not reads_releases(settings):
        names = (*settings.outputs, *settings.inputs)
        return [read_table_record(path, names, fmu) for path in paths]
    records = read_repeats(paths, columns=columns, units=units)
    for record in records:
        for note in record.notes:
            print_note(f"{record.name}: {note}")
    return records


def _show(found: Fit, folder: Path | None, names: str) -> None:
    # Plain text: labels such as [run 1] are no markup.
    output().print(summary(found), markup=False)
    if folder is not None:
        write_text(folder / "fit.md", report(found, f"Fit to {names}"))
        write_text(folder / "fit.json", as_json(found))
        figures = save_figures(found, folder)
        print_note(f"wrote fit.md, fit.json, {', '.join(path.name for path in figures)} into {folder}")
        if not found.profiles and (folder / PROFILES).exists():
            print_note(f"{folder / PROFILES} is of an earlier fit: this one has no profiles")
    if not found.trusted:
        print_error(f"the fit is not to be trusted: {_failed(found)} (see above)")


def _update(
    found: Fit,
    wanted: Wanted,
    before: JoystickParameters,
    uncertainties: Mapping[str, float],
    names: str,
) -> None:
    """Write the joystick into its file, unless there is something to be said against it."""
    assert wanted.joystick is not None
    doubts = "it was stopped" if found.interrupted else "" if found.trusted else _failed(found)
    if doubts and not wanted.even_if_doubtful:
        print_note(f"{wanted.joystick} is left as it was; --even-if-doubtful writes the result all the same")
        return
    fitted = fitted_joystick(found, before, uncertainties)
    source = f"fit to {names}" + (f"; doubtful: {doubts}" if doubts else "")
    sources = dict.fromkeys(fitted.tables, source)
    sources |= dict.fromkeys(fitted.fixed, f"as fixed in the {source}")
    write_update(wanted.joystick, fitted.joystick, fitted.uncertainties, sources)


def _failed(found: Fit) -> str:
    return ", ".join(check.name for check in found.checks if not check.passed)


@contextmanager
def _progress() -> Iterator[OnProgress]:
    """A bar for each stage; nothing is drawn where standard error is no terminal."""
    console = messages()
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeElapsedColumn())
    with Progress(*columns, console=console, transient=True, disable=not console.is_terminal) as bar:
        task = bar.add_task("searching", total=None)

        def tell(stage: str, done: int, total: int) -> None:
            bar.update(task, description=stage, completed=done, total=total)

        yield tell
