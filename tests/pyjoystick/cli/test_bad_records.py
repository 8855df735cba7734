"""Bad records of every kind, in all commands that read records: refused or flagged, with rows and advice."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.support import FloatArray
from tests.pyjoystick.cli.conftest import Command
from tests.pyjoystick.motion.records.made import HOLD, RATE, motion, rows, write

Table = list[list[object]]
FIRST_LINE = 2


def _gap(table: Table) -> Table:
    return table[: HOLD + 8] + table[HOLD + 15 :]


def _nan(table: Table) -> Table:
    table[30][1] = "nan"
    return table


def _repeated(table: Table) -> Table:
    table[20][0] = table[19][0]
    return table


def _unsorted(table: Table) -> Table:
    table[30], table[31] = table[31], table[30]
    return table


def _few_peaks(table: Table) -> Table:
    return table[: HOLD + 23]


def _held(table: Table) -> Table:
    return [[time, -20.0] for time, _ in table]


def _driven(table: Table) -> Table:
    return [[time, -20.0 * float(np.cos(12.0 * float(str(time))))] for time, _ in table]


def _twice(table: Table) -> Table:
    theta: FloatArray = np.array([float(str(angle)) for _, angle in table])
    return rows(np.arange(2 * len(table)) / RATE, np.concatenate((theta, 1.01 * theta)))


REFUSED: dict[str, tuple[Callable[[Table], Table], str, str]] = {
    "NaN": (_nan, "row 32", "samples without a finite number"),
    "repeated times": (_repeated, "row 22", "times are repeated"),
    "unsorted times": (_unsorted, "row 33", "time runs backward"),
    "too few peaks": (_few_peaks, "rows ", "too few peaks after the release, 4 are needed (found 3)"),
    "held": (_held, "rows 2, 106", "there is no free oscillation in it"),
    "driven": (_driven, "row ", "does not decay"),
    "two releases": (_twice, "row ", "a second release"),
}


def _file(folder: Path, change: Callable[[Table], Table], heading: str = "time (s),theta (deg)") -> Path:
    time, theta, _ = motion()
    return write(folder / "bad.csv", change(rows(time, theta)), heading)


@pytest.mark.parametrize("name", ["fit", "peaks"])
@pytest.mark.parametrize(("change", "where", "what"), REFUSED.values(), ids=REFUSED)
def test_refused_with_rows_and_advice(
    command: Command, tmp_path: Path, name: str, change: Callable[[Table], Table], where: str, what: str
) -> None:
    outcome = command(name, str(_file(tmp_path, change)))
    assert (outcome.code, outcome.out) == (1, "")
    # The column, the rows and the reason; then, after a semicolon, the advice.
    assert "bad.csv, column '" in outcome.message
    assert where in outcome.message
    assert what in outcome.message
    assert "; " in outcome.message.partition(what)[2]


@pytest.mark.parametrize("name", ["fit", "peaks"])
def test_degrees_under_the_name_of_radians(command: Command, tmp_path: Path, name: str) -> None:
    path = _file(tmp_path, lambda table: table, "time (s),theta (rad)")
    message = command(name, str(path)).message
    assert "row" in message
    assert "Name the column theta (deg)" in message


def test_the_wrong_sign(command: Command, tmp_path: Path) -> None:
    """Known from what was asked for, or from the other repeats."""
    time, theta, _ = motion()
    good = write(tmp_path / "good.csv", rows(time, theta))
    bad = write(tmp_path / "bad.csv", rows(time, -theta))
    assert "wrong sign?" in command("peaks", str(bad), "--released", "backward").message
    for name in ("fit", "peaks"):
        message = command(name, str(good), str(bad)).message
        assert "bad.csv, column 'theta', row" in message
        assert "is released from the opposite side to" in message


def test_a_gap_in_which_a_peak_may_hide(command: Command, tmp_path: Path) -> None:
    """Peaks after it would be counted wrongly; a fit of the whole motion counts none."""
    path = str(_file(tmp_path, _gap))
    beside = f"rows {HOLD + 7 + FIRST_LINE}-{HOLD + 8 + FIRST_LINE}"
    refused = command("peaks", path)
    assert (refused.code, refused.out) == (1, "")
    assert "a gap of 0.1333 s in which a peak may hide" in refused.message
    assert beside in refused.message
    fitted = command("fit", path)
    assert fitted.code in (0, 3), fitted.err
    assert f"bad: gaps: about 7 samples are missing between {beside}" in fitted.err


@pytest.mark.parametrize("name", ["fit", "peaks"])
def test_a_short_gap_is_flagged_with_its_rows(command: Command, tmp_path: Path, name: str) -> None:
    outcome = command(name, str(_file(tmp_path, lambda table: table[: HOLD + 10] + table[HOLD + 12 :])))
    assert outcome.code in (0, 3), outcome.err
    rows_beside = f"rows {HOLD + 9 + FIRST_LINE}-{HOLD + 10 + FIRST_LINE}"
    assert f"bad: gaps: about 2 samples are missing between {rows_beside}" in outcome.err
