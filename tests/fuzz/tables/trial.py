"""One trial: write a table, read it, damage it, read that, and compare with what was written."""

from __future__ import annotations

import tempfile
import traceback
from collections.abc import Mapping
from pathlib import Path
from random import Random
from typing import Final

import numpy as np

from pyjoystick.support import FloatArray, PyJoystickError
from tests.fuzz.tables.damage import damaged
from tests.fuzz.tables.style import Style, Table
from tests.fuzz.tables.subjects import SUBJECTS, Found, Subject
from tests.fuzz.verdicts import Verdict

#: Rounding of binary numbers, of the size of the value; conversions of units round several times.
_ROUNDING: Final = 1e-12


def trial(case: int, keep: Path | None = None) -> Verdict:
    """Carry out the trial of this number.

    Args:
        case: its number; the same gives the same files
        keep: receives the damaged file
    """
    random = Random(case)
    subject = random.choice(SUBJECTS)
    columns = subject.columns(random)
    table = Table.of(columns, Style.random(random, plain=subject.is_plain))
    truth = {one.name: np.array(list(map(float, one.cells))) * one.factor for one in columns if one.name}
    damage, encoding = damaged(table, random), table.style.encoding
    with tempfile.TemporaryDirectory() as name:
        file = keep or Path(name) / "table.csv"
        try:
            whole = _read(subject, file, table.text().encode(encoding))
            wrong = _wrong(whole, truth, frozenset())
        except Exception:
            wrong = traceback.format_exc()
        if wrong:
            return Verdict(case, "fault", f"{subject.name}, not damaged: {wrong}")
        try:
            found = _read(subject, file, damage.text.encode(encoding))
        except PyJoystickError as error:
            return Verdict(case, "refused", f"{subject.name}, {damage.what}: {error}")
        except Exception:
            return Verdict(case, "fault", f"{subject.name}, {damage.what}\n{traceback.format_exc()}")
    wrong = _wrong(found, truth, damage.lost)
    notes = [note for note in found.notes if note not in whole.notes]
    if not wrong:
        return Verdict(case, "right")
    what = f"{subject.name}, {damage.what}: {wrong}"
    return Verdict(case, "noted", f"{what}\n{'; '.join(notes)}") if notes else Verdict(case, "fault", what)


def _read(subject: Subject, file: Path, content: bytes) -> Found:
    file.write_bytes(content)
    return subject.read(file)


def _wrong(found: Found, truth: Mapping[str, FloatArray], lost: frozenset[int]) -> str:
    """What was read and is no sample of the truth, or which sample that is not lost was not read."""
    unknown = set(found.series) - set(truth)
    if unknown:
        return f"read {', '.join(sorted(unknown))}, which the file does not have"
    key = next(iter(truth))
    places = np.abs(found.series[key][:, None] - truth[key]) <= _ROUNDING * np.abs(truth[key]) + 1e-15
    for name, values in found.series.items():
        near = np.abs(values[:, None] - truth[name]) <= _ROUNDING * np.abs(truth[name]) + 1e-15
        # A marker that was not seen has no place.
        places &= near | np.isnan(values)[:, None]
    strange = np.flatnonzero(~places.any(axis=1))
    if strange.size:
        sample = {name: float(values[strange[0]]) for name, values in found.series.items()}
        return f"{len(strange)} samples are none of the table's, the first is {sample}"
    missing = sorted(set(np.flatnonzero(~places.any(axis=0)).tolist()) - lost)
    return f"samples {missing[:5]} were not read" if missing else ""
