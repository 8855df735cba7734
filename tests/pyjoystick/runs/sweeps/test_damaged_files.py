"""Damaged or modified sweep files are recomputed or refused, never trusted."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from pyjoystick.runs import Sweep, SweepFileError, read_sweep, run_sweep
from pyjoystick.runs.sweeps.files import write_sweep
from pyjoystick.runs.sweeps.parts import Parts
from tests.pyjoystick.runs.sweeps.test_parts import IDENTITY, _part


@pytest.mark.parametrize(
    "changes",
    [
        {"runs": np.array([2.0, 3.0])},
        {"runs": np.array([2, 9])},
        {"runs": np.array([-1, 3])},
        {"values": np.zeros((2, 3))},
        {"values": np.array(["a", "b"])},
        {"failed": np.array([True, False])},
        {"said": np.array(["of none"])},
    ],
)
def test_a_part_that_says_what_no_part_can_is_done_again(changes: dict[str, Any], tmp_path: Path) -> None:
    parts = Parts(tmp_path / "a.csv")
    with parts.opened(IDENTITY):
        for part in (_part(0, 1), _part(2, 3)):
            parts.save(part)
        file = parts.folder / "from-000000002.npz"
        with np.load(file) as kept:
            sound = dict(kept)
        np.savez(file, **sound | changes)
        assert parts.whole(6, 2)[1].tolist() == [True] * 2 + [False] * 4


@pytest.mark.parametrize("text", ["[1, 2]", "null", "{", "[" * 100_000])
def test_what_does_not_say_whose_runs_these_are(text: str, tmp_path: Path) -> None:
    parts = Parts(tmp_path / "a.csv")
    with parts.opened(IDENTITY):
        parts.save(_part(0))
    (parts.folder / "sweep.json").write_text(text)
    with (
        pytest.raises(SweepFileError, match=r"sweep\.json: .*start over with --overwrite$"),
        parts.opened(IDENTITY),
    ):
        pytest.fail("must not be opened")


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
@pytest.mark.parametrize(
    "spoil",
    [
        lambda table: table.iloc[:-1],
        lambda table: table.rename(columns={"theta_start": "theta"}),
        lambda table: table.assign(theta_start=table["theta_start"] + 1e-9),
        lambda table: table.assign(**{table.columns[2]: np.inf}),
        lambda table: table.set_axis(table.index + 1, axis=0).rename_axis("run"),
    ],
)
def test_a_file_whose_rows_were_changed_is_not_taken_for_finished(
    spoil: Callable[[pd.DataFrame], pd.DataFrame], suffix: str, small_sweep: Sweep, tmp_path: Path
) -> None:
    target = _spoiled(spoil, small_sweep, tmp_path / f"a{suffix}")
    with pytest.raises(SweepFileError, match=r"its (rows|runs) are not those of its settings"):
        run_sweep(small_sweep, target)


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
@pytest.mark.parametrize(
    "spoil",
    [
        lambda table: table.iloc[:-1],
        lambda table: table.iloc[[*range(len(table)), 0]],
        lambda table: table.iloc[[0, 0, *range(2, len(table))]],
        lambda table: table.sort_values("theta_start", ascending=False),
        lambda table: table.assign(theta_start=table["theta_start"].to_numpy()[::-1]),
        lambda table: table.drop(columns="theta_start"),
    ],
)
def test_a_file_with_other_runs_is_not_read(
    spoil: Callable[[pd.DataFrame], pd.DataFrame], suffix: str, small_sweep: Sweep, tmp_path: Path
) -> None:
    target = _spoiled(spoil, small_sweep, tmp_path / f"a{suffix}")
    with pytest.raises(SweepFileError, match="its runs are not those of its settings"):
        read_sweep(target)


def _spoiled(spoil: Callable[[pd.DataFrame], pd.DataFrame], sweep: Sweep, target: Path) -> Path:
    """The file of a finished sweep, with changed rows under the same settings."""
    run_sweep(sweep, target)
    whole = read_sweep(target)
    changed = spoil(whole)
    changed.attrs = whole.attrs
    write_sweep(target, changed)
    return target


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_a_result_with_a_flipped_bit_is_no_internal_error(
    suffix: str, small_sweep: Sweep, tmp_path: Path
) -> None:
    whole, path = tmp_path / f"whole{suffix}", tmp_path / f"a{suffix}"
    run_sweep(small_sweep, whole)
    content = whole.read_bytes()
    refused = 0
    for place in range(0, len(content), len(content) // 60):
        path.write_bytes(content[:place] + bytes([content[place] ^ 4]) + content[place + 1 :])
        try:
            read_sweep(path)
        except SweepFileError:
            refused += 1
    assert refused > 0
