"""Tables in text files: read while an FMU is built."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fmu_build import ModelicaError, UnsupportedModelError, build_fmu
from fmu_build.codegen.modelica_source.table_files import read_table, with_tables_from_files
from pyjoystick.fmu import Fmu

_HERE = Path(__file__).with_name("tables")
_MODELS, _LIBRARY = _HERE / "Tables.mo", _HERE / "library" / "Modelica.mo"
_CURVE = [[0, 1.5, -1], [1, 2, 3], [2.5, 4, 5.25]]


def test_tables_of_a_file_in_an_fmu(tmp_path: Path) -> None:
    """Against NumPy; the file is gone by then. The table over time has one column, as in Modelica."""
    built = build_fmu("Tables.Files", tmp_path, library=[_MODELS, _LIBRARY])
    times = np.linspace(0.0, 2.5, 26)
    with Fmu(built.path) as fmu:
        found = fmu.run(times)
    x, first, second = np.array(_CURVE).T
    # Between 1 and 2 of the second input, halfway: 1.5 and 1.5 at 0 and 2 of the first.
    for name, expected in {
        "y[1]": np.interp(times, x, second),
        "y[2]": np.interp(times, x, first),
        "y[3]": np.full_like(times, 1.5),
        "y[4]": np.interp(times, x, first),
    }.items():
        np.testing.assert_allclose(found[name], expected, atol=1e-12, err_msg=name)


def test_a_file_that_is_named_elsewhere_is_refused(tmp_path: Path) -> None:
    with pytest.raises(UnsupportedModelError, match=r"Tables\.mo:\d+:\d+: tableOnFile = true: the build"):
        build_fmu("Tables.NamedElsewhere", tmp_path, library=[_MODELS, _LIBRARY])


@pytest.mark.parametrize("model", ["Chosen", "Mounted"])
def test_a_file_that_is_not_read_is_not_ignored(model: str, tmp_path: Path) -> None:
    """Where a parameter chooses the file, or a class is extended."""
    with pytest.raises(UnsupportedModelError, match=r"tableOnFile"):
        build_fmu(f"Tables.{model}", tmp_path, library=[_MODELS, _LIBRARY])


def test_whether_a_table_is_on_file_is_settled(tmp_path: Path) -> None:
    built = build_fmu("Tables.Files", tmp_path, library=[_MODELS, _LIBRARY])
    with Fmu(built.path) as fmu:
        found = {n: v.causality for n, v in fmu.description.variables.items() if n.endswith("tableOnFile")}
    assert found
    assert set(found.values()) == {"local"}


def test_format() -> None:
    assert read_table(_HERE / "curves.txt", "curve") == _CURVE
    assert read_table(_HERE / "curves.txt", "surface") == [[0, 1, 2, 3], [0, 1, 2, 1], [2, -1, 4, 0.5]]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("double a(1,2)\n0 1", "its first characters must be #1"),
        ("#1\ndouble b(1,2)\n0 1", "there is no table 'a'; there are b"),
        ("#1\ndouble a(2,2)\n0 1 2", r"a\(2,2\) has 3 numbers"),
        ("#1\ndouble a(1,2)\n0 1e", "could not convert string to float: '1e'"),
    ],
)
def test_other_files_are_refused(text: str, message: str, tmp_path: Path) -> None:
    file = tmp_path / "tables.txt"
    file.write_text(text)
    with pytest.raises(ModelicaError, match=rf"tables\.txt: .*{message}"):
        read_table(file, "a")


@pytest.mark.parametrize(
    ("name", "message"),
    [("missing.txt", "cannot read the table file"), ("modelica://Other/a.txt", "there is no library Other")],
)
def test_missing_files_are_errors_with_a_place(name: str, message: str) -> None:
    block = f'model A\n  CombiTimeTable t(tableOnFile = true, tableName = "a", fileName = "{name}");\nend A;'
    with pytest.raises(ModelicaError, match=rf"Tables\.mo:2:20: .*{message}"):
        with_tables_from_files(_MODELS, block, {})
