"""Files of results, and their metadata."""

from __future__ import annotations

import hashlib
import json
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow.parquet
import pytest

from pyjoystick.runs import Sweep, SweepFileError, read_sweep
from pyjoystick.runs.sweeps import files
from pyjoystick.runs.sweeps.files import check_target, write_sweep
from pyjoystick.runs.sweeps.sampling import digest
from pyjoystick.runs.sweeps.sweep import Part
from pyjoystick.support import MissingPackageError, OutputFileError


def _table(sweep: Sweep) -> pd.DataFrame:
    runs = np.arange(len(sweep.design))
    values = np.random.default_rng(1).standard_normal((runs.size, len(sweep.columns)))
    failed = runs == 3
    values[3] = np.nan
    values[5, 0] = np.nan
    messages = ['past 100 % of #1, "so" to say' if bad else "" for bad in failed]
    return sweep.table(Part(runs, values, failed, messages))


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_results_come_back_bit_for_bit_with_their_settings(
    small_sweep: Sweep, tmp_path: Path, suffix: str
) -> None:
    table = _table(small_sweep)
    path = tmp_path / f"results{suffix}"
    write_sweep(path, table)
    again = read_sweep(path)
    pd.testing.assert_frame_equal(again, table, check_exact=True, check_dtype=suffix == ".parquet")
    document = again.attrs["sweep"]
    assert document == table.attrs["sweep"]
    assert document["settings"]["vary"]["damping.C"] == {"values": [0.03, 0.045, 0.06]}
    assert document["fmu"]["guid"] == small_sweep.settings.fmu.guid
    sha256 = hashlib.sha256(small_sweep.settings.fmu.path.read_bytes()).hexdigest()
    assert document["fmu"]["sha256"] == sha256
    assert document["units"]["theta.peak1"] == "rad"
    assert document["units"]["theta.peak1_time"] == "s"
    assert document["units"]["damping.C"] == "N.m.s/rad"
    assert document["versions"]["numpy"] == np.__version__


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
@pytest.mark.parametrize(
    "values",
    [
        np.array([1, 2], np.uint64),
        np.array([1, 2**64 - 1], np.uint64),
        np.array([-1, 2**53 + 1]),
        np.array([-0.0, 1e300]),
        np.array([2.0, 3.0]),
        np.array([True, False]),
    ],
)
def test_parameters_of_every_type_are_those_of_the_settings(
    values: np.ndarray, suffix: str, tmp_path: Path
) -> None:
    table = pd.DataFrame({"p": values, "y.final": [0.5, 1.0], "failed": False, "message": ""}).rename_axis(
        "run"
    )
    table.attrs["sweep"] = {
        "settings": {"vary": {"p": {}}},
        "runs": 2,
        "runs_sha256": digest(table[["p"]]),
        "types": {"p": values.dtype.str},
        "units": {"p": "", "y.final": ""},
    }
    write_sweep(tmp_path / f"a{suffix}", table)
    again = read_sweep(tmp_path / f"a{suffix}")["p"].to_numpy()
    assert again.dtype == values.dtype
    assert again.tobytes() == values.tobytes()


def test_other_tools_read_the_files(small_sweep: Sweep, tmp_path: Path) -> None:
    table = _table(small_sweep)
    write_sweep(tmp_path / "a.csv", table)
    plain = pd.read_csv(tmp_path / "a.csv", comment="#", index_col="run")
    np.testing.assert_allclose(plain["E.loss"], table["E.loss"], rtol=1e-15)
    assert plain["message"][3] == table["message"][3]
    write_sweep(tmp_path / "a.parquet", table)
    metadata = pyarrow.parquet.read_schema(tmp_path / "a.parquet").metadata
    assert json.loads(metadata[b"PANDAS_ATTRS"])["sweep"] == table.attrs["sweep"]


def test_the_program_in_the_documentation(
    small_sweep: Sweep, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    page = (Path(__file__).parents[4] / "docs" / "sweeps.md").read_text(encoding="utf-8")
    (program,) = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    monkeypatch.chdir(tmp_path)
    write_sweep(Path("results/release.csv"), _table(small_sweep))
    names: dict[str, object] = {}
    exec(compile(program, "sweeps.md", "exec"), names)
    assert names["sha256"] == small_sweep.fmu_sha256


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_results_that_are_missing_or_renamed(small_sweep: Sweep, suffix: str, tmp_path: Path) -> None:
    table, path = _table(small_sweep), tmp_path / f"a{suffix}"
    for changed in (
        table.drop(columns="E.loss"),
        table.rename(columns={"E.loss": "loss"}),
        table.assign(failed=0.5),
    ):
        changed.attrs = table.attrs
        write_sweep(path, changed)
        with pytest.raises(SweepFileError, match="its runs are not those of its settings"):
            read_sweep(path)


def test_names_and_packages_are_checked_first(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(OutputFileError, match=r"must end in .parquet or .csv"):
        check_target(Path("a.xlsx"))
    monkeypatch.setattr(files, "find_spec", lambda name: None)
    check_target(Path("a.csv"))
    with pytest.raises(MissingPackageError, match=r"pip install 'pyjoystick\[parquet\]'"):
        check_target(Path("a.parquet"))


@pytest.mark.parametrize("suffix", [".csv", ".parquet"])
def test_files_that_are_no_sweep(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"a{suffix}"
    with pytest.raises(SweepFileError, match="does not exist"):
        read_sweep(path)
    path.write_text("x,y\n1,2\n")
    with pytest.raises(SweepFileError, match="is not a result of a sweep"):
        read_sweep(path)


def test_a_table_without_settings_is_no_sweep(tmp_path: Path) -> None:
    pd.DataFrame({"a": [1.0]}).to_parquet(tmp_path / "a.parquet")
    with pytest.raises(SweepFileError, match="has no settings"):
        read_sweep(tmp_path / "a.parquet")
