"""Integers of every type and size: exact or refused, at every input and output."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Final, Fmu, checked_value, read_description, read_inputs
from pyjoystick.fmu.library import FmuLibrary
from pyjoystick.motion import compare, write_csv
from pyjoystick.support import ParameterError
from tests.pyjoystick.fmu import echo

TIME = (0.0, 0.5, 1.0)
INTEGERS = tuple(name for name in echo.TYPES if "Int" in name)
#: Whole numbers that a float does not have, by type.
ODD = {"Int64": -(2**53) - 1, "UInt64": 2**64 - 3}


def ends(name: str) -> tuple[int, int]:
    limits = np.iinfo(name.lower())
    return int(limits.min), int(limits.max)


@pytest.mark.parametrize("name", INTEGERS)
def test_the_ends_of_every_type_go_in_and_come_out(echo3: Fmu, loop: str, name: str) -> None:
    for value in (*ends(name), ODD.get(name, 0)):
        parameter, series = {f"p_{name}": value}, pd.DataFrame({f"u_{name}": [value, 0]}, index=[0.0, 0.7])
        table = echo3.run(TIME, parameters=parameter, inputs={f"u_{name}": value})
        assert table[f"p_again_{name}"].tolist() == table[f"u_again_{name}"].tolist() == [value] * 3
        assert table[f"p_again_{name}"].dtype == np.dtype(name.lower())
        moving = echo3.run(TIME, inputs=series)
        assert moving[f"u_again_{name}"].tolist() == [value, value, 0]


@pytest.mark.parametrize("name", [*INTEGERS, "Integer"])
def test_what_a_type_does_not_have_is_refused(echo2: Fmu, echo3: Fmu, name: str) -> None:
    fmu = echo2 if name == "Integer" else echo3
    low, high = ends("Int32" if name == "Integer" else name)
    for value in (low - 1, high + 1, 2**70, 1e30, float(high) + 2.0**60):
        with pytest.raises(ParameterError, match=f"p_{name} = .*must be an integer"):
            fmu.run(TIME, parameters={f"p_{name}": value})
        with pytest.raises(ParameterError, match=f"u_{name} = .*must be an integer"):
            fmu.run(TIME, inputs={f"u_{name}": value})
        with pytest.raises(ParameterError, match=rf"p_{name}\[0\] = .*must be an integer"):
            fmu.plan(TIME, varied=f"p_{name}").run_batch([[value]])


def test_numbers_beyond_single_precision_are_refused(echo3: Fmu) -> None:
    largest = float(np.finfo(np.float32).max)
    table = echo3.run(TIME, parameters={"p_Float32": -largest}, inputs={"u_Float32": largest})
    assert table["both_Float32[2]"].tolist() == [largest] * 3
    assert echo3.plan(TIME, varied="p_Float32", outputs="p_again_Float32").run([largest])[0, 0] == largest
    for value in (1e39, -1e39, largest * (1.0 + 1e-7)):
        with pytest.raises(ParameterError, match=r"p_Float32 = .*\(its type is Float32\)"):
            echo3.run(TIME, parameters={"p_Float32": value})
        with pytest.raises(ParameterError, match="u_Float32 = "):
            echo3.run(TIME, inputs=pd.DataFrame({"u_Float32": [0.0, value]}, index=[0.0, 1.0]))
        with pytest.raises(ParameterError, match=r"p_Float32\[1\] = "):
            echo3.plan(TIME, varied="p_Float32").run_batch([[0.0], [value]])


def tables_of(rows: list[tuple[Any, ...]], names: list[str]) -> list[Any]:
    """The same rows as a list, an array of objects and a table."""
    return [rows, np.array(rows, dtype=object), pd.DataFrame(rows, columns=names)]


def test_what_varies_is_exact_whatever_carries_it(echo3: Fmu, loop: str) -> None:
    names = ["p_Float32", "p_UInt64", "p_Int64"]
    rows: list[tuple[Any, ...]] = [(0.5, 2**64 - 1, -(2**63)), (1.5, 2**53 + 1, 2**63 - 1)]
    plan = echo3.plan(TIME, varied=names, outputs=["p_again_Float32", "p_again_UInt64", "p_again_Int64"])
    for table in tables_of(rows, names):
        batch = plan.run_batch(table)
        assert batch.parameters["p_UInt64"].tolist() == [2**64 - 1, 2**53 + 1]
        assert batch.parameters["p_Int64"].tolist() == [-(2**63), 2**63 - 1]
        assert batch.values is not None
        np.testing.assert_array_equal(batch.values[:, -1], np.array(rows, dtype=np.float64))
    np.testing.assert_array_equal(plan.run(rows[1])[-1], np.array(rows[1], dtype=np.float64))


def test_the_bytes_that_vary_are_those_of_the_number(echo3: Fmu) -> None:
    """Samples of a plan are floats; what the FMU was given is seen in what it is set to."""
    plan = echo3.plan(TIME, varied=["p_UInt64", "p_Int64"])
    for values in ((2**64 - 1, -(2**53) - 1), np.array([2**53 + 1, 7])):
        rows = plan._rows(plan._varied.row(values))
        assert [rows[name][0] for name in plan.varied] == list(values)


def test_a_float_that_stands_for_several_whole_numbers_is_refused(echo3: Fmu) -> None:
    plan = echo3.plan(TIME, varied=["p_UInt64", "p_Float32"], outputs="p_again_UInt64")
    assert plan.run([2.0**53, 0.0])[0, 0] == 2.0**53
    with pytest.raises(ParameterError, match="a float is exact up to 2\\^53; give an integer"):
        plan.run(np.array([2.0**60, 0.5]))
    for value in (1.5, np.nan, np.inf, -1):
        with pytest.raises(ParameterError, match=r"p_UInt64\[0\] = .*must be an integer"):
            plan.run_batch([[value, 0.0]])
    with pytest.raises(ParameterError, match="made of numbers"):
        plan.run(["1", 0.0])


def test_bounds_of_whole_numbers_are_exact(echo3: Fmu) -> None:
    import dataclasses

    variable = dataclasses.replace(echo3.description.variables["p_UInt64"], maximum=2**64 - 2)
    assert checked_value(variable, 2**64 - 2) == 2**64 - 2
    with pytest.raises(ParameterError, match="an integer, 18446744073709551614 or less"):
        checked_value(variable, 2**64 - 1)


def test_enumerations_are_as_wide_as_their_version_of_fmi(echo3: Fmu) -> None:
    import dataclasses

    wide = dataclasses.replace(echo3.description.variables["p_Int64"], type="Enumeration")
    assert checked_value(wide, 2**40) == 2**40
    with pytest.raises(ParameterError, match="its type is Enumeration"):
        checked_value(dataclasses.replace(wide, is_fmi3=False), 2**40)


def test_a_signal_is_exact_or_refused(echo3_path: Path) -> None:
    """A master that takes steps itself passes floats."""
    library = FmuLibrary(read_description(echo3_path), "CoSimulation")
    instance = library.instantiate()
    variables = instance.description.variables
    instance.initialize(0.0, 1e-8, {"p_UInt64": 2**64 - 1})
    instance.set([variables["u_Int8"]], [-128.0])
    assert instance.get([variables["u_again_Int8"]]) == [-128.0]
    for name, value in (("u_UInt64", 2.0**64), ("u_Int64", 2.0**60), ("u_Int8", 128.0), ("u_Int16", 0.5)):
        with pytest.raises(ParameterError, match=f"{name} = .*a float is exact up to 2\\^53"):
            instance.set([variables[name]], [value])
    instance.free()
    library.close()


def test_files_have_every_digit(echo3: Fmu, tmp_path: Path) -> None:
    path = tmp_path / "inputs.csv"
    path.write_text(
        "time (s),u_UInt64,u_Int64,u_Int8\n0,18446744073709551615,-9007199254740993,1E+1\n0.5,1,2,3.0\n"
    )
    inputs = read_inputs(path, echo3.description)
    assert inputs["u_UInt64"].tolist() == [2**64 - 1, 1]
    assert inputs["u_Int64"].tolist() == [-(2**53) - 1, 2]
    table = echo3.run(TIME, inputs=inputs, outputs=["u_again_UInt64", "u_again_Int64", "u_again_Int8"])
    write_csv(table, tmp_path / "outputs.csv")
    assert (tmp_path / "outputs.csv").read_text().splitlines()[1] == (
        "0.0,18446744073709551615,-9007199254740993,10"
    )
    path.write_text("time (s),u_UInt64\n0,18446744073709551616\n")
    with pytest.raises(ParameterError, match="u_UInt64 = 18446744073709551616: must be an integer"):
        echo3.run(TIME, inputs=read_inputs(path, echo3.description))
    path.write_text("time (s),u_UInt64\n0,9007199254740993.5\n")
    with pytest.raises(ParameterError, match="u_UInt64"):
        echo3.run(TIME, inputs=read_inputs(path, echo3.description))


def test_a_comparison_sees_the_last_digit(echo3: Fmu) -> None:
    tables = [echo3.run(TIME, parameters={"p_UInt64": value}) for value in (2**64 - 1, 2**64 - 2)]
    largest = {one.variable: one.largest for one in compare(*tables)}
    assert largest.pop("p_again_UInt64") == 1.0
    assert {name for name, size in largest.items() if size} == {"both_UInt64[1]", "both_UInt64[3]"}


def test_reductions_of_a_batch_are_those_of_the_run(echo3: Fmu, loop: str) -> None:
    plan = echo3.plan(TIME, varied="p_UInt64", outputs=["p_again_UInt64", "both_UInt64[3]"])
    reduced = plan.run_batch([[2**53]], reductions=[Final("both_UInt64[3]")]).reduced
    assert reduced is not None
    assert reduced["both_UInt64[3].final"].tolist() == [2.0**53]
