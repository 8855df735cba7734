"""The steps of ``pyjoystick fit``: read the records, fit, print and write what came of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Final

from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn

from pyjoystick.cli.console import messages, output, print_error, print_note
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.cli.options import DampingLaw, law_of, parameter_file, parse_names
from pyjoystick.fitting import (
    CONSTANT_DAMPING,
    POWER_LAW_DAMPING,
    FitInterruptedError,
    FitSettings,
    Measurement,
)
from pyjoystick.fitting import fit as carry_out
from pyjoystick.fitting.figures import save_figures
from pyjoystick.fitting.fit import OnProgress
from pyjoystick.fitting.joystick_values import with_values
from pyjoystick.fitting.json_report import as_json
from pyjoystick.fitting.result import Fit
from pyjoystick.fitting.settings_file import read_fit_settings, reads_releases
from pyjoystick.fitting.table_record import read_table_record
from pyjoystick.fitting.text_report import report, summary
from pyjoystick.fmu import Fmu, FmuDescription
from pyjoystick.output import write_text
from pyjoystick.records import Record, read_repeats

#: Exit code where a fit is done but not to be trusted, and after Ctrl-C.
DOUBTFUL: Final = 3
INTERRUPTED: Final = 130


def fit_and_show(
    paths: Sequence[Path],
    settings_file: Path | None,
    damping: DampingLaw | None,
    parameters: Path | None,
    folder: Path | None,
    columns: Sequence[str] | None,
    units: Sequence[str] | None,
) -> int:
    """Fit the records of some files; returns the exit code."""
    if settings_file is not None:
        settings = read_fit_settings(settings_file, found_or_built)
    else:
        law = damping or DampingLaw(parameter_file(parameters).law)
        settings = POWER_LAW_DAMPING if law is DampingLaw.POWER_LAW else CONSTANT_DAMPING
    with Fmu(found_or_built(settings.fmu)) as fmu:
        if parameters is not None:
            joystick = parameter_file(parameters).with_law(law_of(fmu.description).value)
            settings = with_values(settings, joystick.to_names(), replace_starts=settings_file is None)
        records = _records(paths, settings, fmu.description, columns, units)
        try:
            with _progress() as tell:
                found = carry_out(records, settings, fmu=fmu, on_progress=tell)
        except (FitInterruptedError, KeyboardInterrupt):
            print_error(str(FitInterruptedError()))
            return INTERRUPTED
    _show(found, folder, [path.name for path in paths])
    if found.interrupted:
        return INTERRUPTED
    return 0 if found.trusted else DOUBTFUL


def _records(
    paths: Sequence[Path],
    settings: FitSettings,
    fmu: FmuDescription,
    columns: Sequence[str] | None,
    units: Sequence[str] | None,
) -> Sequence[Record | Measurement]:
    if not reads_releases(settings):
        names = (*settings.outputs, *settings.inputs)
        return [read_table_record(path, names, fmu) for path in paths]
    records = read_repeats(
        paths, columns=parse_names(columns, "--column"), units=parse_names(units, "--unit")
    )
    for record in records:
        for note in record.notes:
            print_note(f"{record.name}: {note}")
    return records


def _show(found: Fit, folder: Path | None, names: Sequence[str]) -> None:
    # Plain text: labels such as [run 1] are no markup.
    output().print(summary(found), markup=False)
    if folder is not None:
        write_text(folder / "fit.md", report(found, f"Fit to {', '.join(names)}"))
        write_text(folder / "fit.json", as_json(found))
        figures = save_figures(found, folder)
        print_note(f"wrote fit.md, fit.json, {', '.join(path.name for path in figures)} into {folder}")
    if not found.trusted:
        failed = ", ".join(check.name for check in found.checks if not check.passed)
        print_error(f"the fit is not to be trusted: {failed} (see above)")


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
