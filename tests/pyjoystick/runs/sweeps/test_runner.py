"""Sweeps that run, are interrupted and resume."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.runs import ChangedSweepError, Sweep, SweepFileError, read_settings, read_sweep, run_sweep
from tests.pyjoystick.runs.sweeps.conftest import LONG, SMALL, Write

#: Some runs of this one fail: those whose last moment comes before the end.
MIXED = """
[fmu]
path = "{mixed}"
[experiment]
duration = 2
output_interval = 0.1
[parameters]
inverted = true
[inputs]
u = 0.75
[sampling]
method = "grid"
[vary.gain]
values = [-1.0, 2.0]
[vary.last]
values = [1.0, 5.0]
[vary.n]
values = [2, 4]
[[results]]
kind = "final"
variable = "y"
[[results]]
kind = "final"
variable = "steps"
[[results]]
kind = "extremes"
variable = "above"
"""


def test_the_numbers_are_those_of_single_runs(small_sweep: Sweep, tmp_path: Path) -> None:
    outcome = run_sweep(small_sweep, tmp_path / "a.parquet")
    assert (outcome.done, outcome.failed, outcome.found, outcome.interrupted) == (12, 0, 0, False)
    table = read_sweep(tmp_path / "a.parquet")
    settings = small_sweep.settings
    with Fmu(settings.fmu.path) as fmu:
        for run in (0, 7, 11):
            parameters = small_sweep.design.loc[run].to_dict()
            motion = fmu.run(settings.time, parameters=parameters, outputs=["E"], tolerance=1e-8)
            assert table["E.loss"][run] == motion["E"].iloc[0] - motion["E"].iloc[-1]
    assert [path.name for path in tmp_path.iterdir() if "parts" in path.name] == []


def test_the_number_of_threads_changes_nothing(small_sweep: Sweep, tmp_path: Path) -> None:
    tables = [run_sweep(small_sweep, tmp_path / f"{n}.csv", threads=n).table for n in (1, 2)]
    assert tables[0] is not None
    assert tables[1] is not None
    pd.testing.assert_frame_equal(tables[0], tables[1], check_exact=True)
    assert (tmp_path / "1.csv").read_bytes() == (tmp_path / "2.csv").read_bytes()


def test_failed_runs_are_rows_with_the_message_of_the_fmu(
    written: Write, mixed_path: Path, tmp_path: Path
) -> None:
    sweep = Sweep(read_settings(written(MIXED, mixed=mixed_path)))
    outcome = run_sweep(sweep, tmp_path / "a.csv")
    table = read_sweep(tmp_path / "a.csv")
    assert outcome.failed == 4
    assert sorted(outcome.messages) == table.index[table["last"] == 1.0].tolist()
    assert all("past the last moment 100 % of #1" in one for one in outcome.messages.values())
    np.testing.assert_array_equal(table["failed"], table["last"] == 1.0)
    sound = table[~table["failed"]]
    np.testing.assert_array_equal(sound["y.final"], 0.75 * sound["gain"])
    np.testing.assert_array_equal(sound["steps.final"], sound["n"])
    assert (sound["above.max"] == 1.0).all()
    assert table.loc[table["failed"], ["y.final", "steps.final", "above.max"]].isna().all(axis=None)


def _interrupted(sweep: Sweep, target: Path, after: int) -> int:
    """Stop a sweep as Ctrl-C does once so many runs are done; the number of runs that were kept."""

    def stop(done: int) -> None:
        if done >= after:
            raise KeyboardInterrupt

    outcome = run_sweep(sweep, target, on_progress=stop)
    assert outcome.interrupted
    assert not target.exists()
    return outcome.done


def test_what_is_done_is_not_done_again(
    written: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sweep = Sweep(read_settings(written(LONG.replace("4096", "256").replace("1.5", "0.2"))))
    expected = run_sweep(sweep, tmp_path / "whole.parquet").table
    target = tmp_path / "a.parquet"
    kept = _interrupted(sweep, target, after=20)
    assert 0 < kept < 256
    progress: list[int] = []
    outcome = run_sweep(sweep, target, on_progress=progress.append)
    assert outcome.found == progress[0] == kept
    assert (outcome.done, outcome.interrupted) == (256, False)
    assert expected is not None
    pd.testing.assert_frame_equal(read_sweep(target), expected, check_exact=True)
    assert not Path(f"{target}.parts").exists()
    again = run_sweep(sweep, target)
    assert (again.found, again.done) == (256, 256)


def test_other_settings_or_another_fmu_are_refused(
    written: Write, tmp_path: Path, joystick_fmus: Path
) -> None:
    sweep = Sweep(read_settings(written()))
    target = tmp_path / "a.csv"
    run_sweep(sweep, target)
    before = target.read_bytes()
    longer = Sweep(read_settings(written(SMALL.replace("0.3\n", "0.4\n"), "longer.toml")))
    with pytest.raises(ChangedSweepError, match=r"settings experiment duration was 0\.3 and is 0\.4"):
        run_sweep(longer, target)
    copy = tmp_path / "Joystick.fmu"
    copy.write_bytes((joystick_fmus / "Joystick.fmu").read_bytes() + b"\0")
    other = Sweep(read_settings(written(SMALL.replace("{fmus}/", ""), "other.toml")))
    with pytest.raises(ChangedSweepError, match="fmu has other contents"):
        run_sweep(other, target)
    assert target.read_bytes() == before
    assert run_sweep(longer, target, overwrite=True).found == 0
    assert read_sweep(target).attrs["sweep"]["settings"]["experiment"]["duration"] == 0.4


def test_an_interrupted_replacement_goes_on(written: Write, tmp_path: Path) -> None:
    target = tmp_path / "a.csv"
    run_sweep(Sweep(read_settings(written())), target)
    before = target.read_bytes()
    longer = Sweep(read_settings(written(SMALL.replace("0.3\n", "0.4\n"), "longer.toml")))

    def stop(done: int) -> None:
        if done:
            raise KeyboardInterrupt

    assert run_sweep(longer, target, overwrite=True, on_progress=stop).interrupted
    assert target.read_bytes() == before
    outcome = run_sweep(longer, target)
    assert outcome.table is not None
    assert outcome.table.attrs["sweep"]["settings"]["experiment"]["duration"] == 0.4


def test_asking_for_finished_results_leaves_the_runs_of_their_replacement(
    written: Write, tmp_path: Path
) -> None:
    target = tmp_path / "a.csv"
    first = Sweep(read_settings(written()))
    run_sweep(first, target)
    longer = Sweep(read_settings(written(SMALL.replace("0.3\n", "0.4\n"), "longer.toml")))

    def stop(done: int) -> None:
        if done:
            raise KeyboardInterrupt

    kept = run_sweep(longer, target, overwrite=True, on_progress=stop).done
    assert run_sweep(first, target).found == len(first.design)
    assert run_sweep(longer, target).found == kept > 0


def test_a_file_of_another_kind_is_not_replaced(small_sweep: Sweep, tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("x\n1\n")
    with pytest.raises(SweepFileError, match="is not a result of a sweep"):
        run_sweep(small_sweep, tmp_path / "a.csv")
    assert (tmp_path / "a.csv").read_text() == "x\n1\n"
