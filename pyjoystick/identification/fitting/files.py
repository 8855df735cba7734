"""Reading the records of a fit and writing its results."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path

from pyjoystick.fmu import FmuDescription
from pyjoystick.identification.fitting.figures import save_figures
from pyjoystick.identification.fitting.json_report import as_json
from pyjoystick.identification.fitting.problem.measurement import Measurement, read_table_record
from pyjoystick.identification.fitting.problem.settings import FitSettings
from pyjoystick.identification.fitting.result import Fit
from pyjoystick.identification.fitting.settings_file import is_driven, reads_releases
from pyjoystick.identification.fitting.text_report import report
from pyjoystick.motion import Record, read_repeats, require_plausible_load
from pyjoystick.runs import require_si_units
from pyjoystick.support import write_text


def read_records(
    paths: Sequence[Path],
    settings: FitSettings,
    fmu: FmuDescription,
    *,
    columns: Mapping[str, str] | None = None,
    units: Mapping[str, str] | None = None,
    both_sides: bool = False,
) -> list[Record | Measurement]:
    """Read the records that the settings compare with the FMU, one from each file.

    They are releases, read by `pyjoystick.motion.read_repeats` with these options, or tables of the
    FMU's variables, read by `pyjoystick.fmu.read_variables`; both raise RecordError. The torque that drives a
    joystick must not exceed 200 N m.

    Raises:
        UnsupportedFmuError: they are releases, in SI units, and the FMU declares other ones
    """
    if reads_releases(settings):
        require_si_units(fmu, settings.outputs)
        counted = settings.comparison == "peaks"
        return [*read_repeats(paths, columns=columns, units=units, both_sides=both_sides, counted=counted)]
    names = (*settings.outputs, *settings.inputs)
    tables = [read_table_record(path, names, fmu) for path in paths]
    if is_driven(settings):
        for path, record in zip(paths, tables, strict=True):
            advice = "correct the unit in the heading, or this sample"
            require_plausible_load(path, "T", record.columns["T"], "T", advice)
    return [*tables]


def save_fit(fit: Fit, folder: str | PathLike[str], title: str, notes: Sequence[str] = ()) -> list[Path]:
    """Write ``fit.md`` with this title, ``fit.json`` with these notes, and the figures; returns the files.

    Raises:
        OutputFileError: a file cannot be written
    """
    texts = {"fit.md": report(fit, title), "fit.json": as_json(fit, notes)}
    for name, text in texts.items():
        write_text(Path(folder) / name, text)
    return [*(Path(folder) / name for name in texts), *save_figures(fit, folder)]
