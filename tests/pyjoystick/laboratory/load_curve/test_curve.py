"""Files of a testing machine, and error messages for bad ones."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.laboratory import LoadCurve, read_load_curve
from pyjoystick.model import FORWARD_TABLE
from pyjoystick.motion import RecordError
from tests.pyjoystick.laboratory.load_curve.machine import cycle, write


def test_a_cycle_is_parted_at_the_turn(tmp_path: Path) -> None:
    travel, force = cycle(FORWARD_TABLE, 1, step=20e-6)
    curve = read_load_curve(write(tmp_path / "curve.csv", travel, force))
    assert curve.unloading is not None
    kept = travel < np.max(travel) - 0.005 * np.ptp(travel)
    joined = np.concatenate([branch.travel for branch in curve.branches])
    np.testing.assert_allclose(joined, travel[kept], atol=1e-9)
    # Two lines stand before the first row.
    assert curve.loading.rows[0] == 3
    assert curve.notes == ()


def test_headings_and_units_of_another_machine(tmp_path: Path) -> None:
    travel, force = cycle(FORWARD_TABLE, 1, step=20e-6)
    expected = LoadCurve.from_cycle(travel, force)
    path = write(tmp_path / "curve.csv", travel * 1e3, force / 1e3, "Extension (um);Load")
    columns = {"travel": "Extension", "force": "Load"}
    found = read_load_curve(path, columns=columns, units={"force": "kN"})
    np.testing.assert_allclose(found.loading.travel, expected.loading.travel, atol=1e-9)
    np.testing.assert_allclose(found.loading.force, expected.loading.force, atol=0.06)


def test_compression_counted_negative_is_turned_and_told() -> None:
    travel, force = cycle(FORWARD_TABLE, 1, step=20e-6)
    turned = LoadCurve.from_cycle(-travel, -force)
    np.testing.assert_array_equal(turned.loading.force, LoadCurve.from_cycle(travel, force).loading.force)
    assert [note.split(":")[0] for note in turned.notes] == [
        "travel is mostly negative",
        "force is mostly negative",
    ]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda t: t.replace("0.0", "0,0"), "row 3: is not a number (found '0,0"),
        (
            lambda t: t.replace(".", ",").replace(";", ","),
            "row 3: has 4 cells under 2 headings; was the file cut",
        ),
        (
            lambda t: t.replace("(N)", "(dyn)"),
            "column 'force (dyn)', row 2: has an unknown unit (found dyn); known are N",
        ),
        (
            lambda t: t.replace(" (mm)", ""),
            "column 'travel', row 2: has no unit; write it in the heading, as in 'travel (m)', or",
        ),
        (lambda t: t.replace("force", "lid"), "has no column 'force'; which column holds force? There are"),
        (lambda t: t[: t.index("\n", 2000)] + "\n1.0;\n", "column 'force (N)', row "),
        (lambda t: t + t[t.index("\n", 30) + 1 :], "travel turns back by"),
    ],
)
def test_bad_files_are_named_with_row_and_remedy(tmp_path: Path, change: object, message: str) -> None:
    path = write(tmp_path / "curve.csv", *cycle(FORWARD_TABLE, 1, step=20e-6))
    path.write_text(change(path.read_text(encoding="utf-8")), encoding="utf-8")  # type: ignore[operator]
    with pytest.raises(RecordError) as refused:
        read_load_curve(path)
    assert str(refused.value).startswith(str(path))
    assert message in str(refused.value)


@pytest.mark.parametrize(
    ("change", "encoding"),
    [
        (lambda t: t.replace(";", " ").replace(" (", "("), "utf-8"),
        (lambda t: t.replace(".", ","), "utf-8"),
        (lambda t: t.replace("travel (mm);force (N)", "Weg [mm];Kraft [N]").replace(".", ","), "cp1252"),
        (
            lambda t: t.replace(
                "travel (mm);force (N)", "Prüfprotokoll;Müller\n\nStandardweg;Standardkraft\nmm;N"
            ).replace(".", ","),
            "cp1252",
        ),
    ],
    ids=["spaces", "decimal commas", "german", "testing machine"],
)
def test_other_forms_give_the_same_curve(tmp_path: Path, change: Callable[[str], str], encoding: str) -> None:
    path = write(tmp_path / "curve.csv", *cycle(FORWARD_TABLE, 1, step=20e-6))
    expected = read_load_curve(path)
    path.write_text(change(path.read_text(encoding="utf-8")), encoding=encoding)
    found = read_load_curve(path)
    for one, other in zip(found.branches, expected.branches, strict=True):
        np.testing.assert_array_equal(one.travel, other.travel)
        np.testing.assert_array_equal(one.force, other.force)


def test_travel_that_turns_back_names_its_row(tmp_path: Path) -> None:
    travel, force = cycle(FORWARD_TABLE, 1, step=20e-6)
    travel[60:80] -= 0.1e-3
    with pytest.raises(
        RecordError, match=r"column 'travel', row 63: travel turns back by 0\.\d+ mm within loading"
    ):
        read_load_curve(write(tmp_path / "curve.csv", travel, force))


@pytest.mark.parametrize(
    ("sizes", "message"),
    [
        ((1e-301, 1.0), "column 'travel': the largest travel is not from 0.0001 to 1 m; is its unit right?"),
        ((1e3, 1.0), "not from 0.0001 to 1 m; did you mean a unit that is 1000 times smaller?"),
        ((1e-3, 1.0), "not from 0.0001 to 1 m; did you mean a unit that is 1000 times larger?"),
        (
            (1.0, 1e6),
            "column 'force': the largest force is not from 0.0001 to 100000 N; did you mean a unit that",
        ),
    ],
)
def test_sizes_that_no_spring_has(sizes: tuple[float, float], message: str) -> None:
    travel, force = cycle(FORWARD_TABLE, 1, step=20e-6)
    with pytest.raises(RecordError) as refused:
        LoadCurve.from_cycle(sizes[0] * travel, sizes[1] * force)
    assert message in str(refused.value).replace(f" (found {refused.value.value})", "")


def test_arrays_that_are_no_cycle() -> None:
    travel, force = cycle(FORWARD_TABLE, 1, step=20e-6)
    half = len(travel) // 2
    with pytest.raises(RecordError, match="has no loading branch"):
        LoadCurve.from_cycle(travel[half:], force[half:])
    with pytest.raises(RecordError, match="column 'force': is zero throughout"):
        LoadCurve.from_cycle(travel, 0.0 * force)
    with pytest.raises(RecordError, match="samples in a branch"):
        LoadCurve.from_cycle(np.linspace(0.0, 1e-3, 10), np.linspace(0.0, 1.0, 10))


def test_an_unknown_quantity(tmp_path: Path) -> None:
    with pytest.raises(RecordError, match="'stress' is not a known quantity; known are travel, force"):
        read_load_curve(write(tmp_path / "curve.csv", *cycle(FORWARD_TABLE, 1)), units={"stress": "N"})


@pytest.mark.parametrize("factor", [0.7, 1.3, 1e3])
@pytest.mark.parametrize("place", [40, 200, 300])
def test_one_wrong_force_is_named(tmp_path: Path, place: int, factor: float) -> None:
    """One such cell once made the fit take half a minute and end anywhere."""
    travel, force = cycle(FORWARD_TABLE, 1, step=20e-6)
    force[place] *= factor
    with pytest.raises(
        RecordError, match=rf"'force', row {place + 3}: force differs by \S+ N from both neighboring rows"
    ):
        read_load_curve(write(tmp_path / "curve.csv", travel, force))


@pytest.mark.parametrize("place", [0, 40, 179, 300, 359])
def test_one_wrong_travel_is_named(tmp_path: Path, place: int) -> None:
    travel, force = cycle(FORWARD_TABLE, 1, step=20e-6)
    assert len(travel) == 360
    travel[place] = 1.0
    with pytest.raises(RecordError, match=r"column 'travel', rows .*: travel jumps by") as refused:
        read_load_curve(write(tmp_path / "curve.csv", travel, force))
    assert place + 3 in refused.value.rows


def test_force_may_peak_at_the_turn() -> None:
    """A record that turns within a stiff segment, of which one row is in it."""
    travel = np.linspace(0.0, 1e-3, 41)
    force = np.where(travel > 0.99e-3, 50.0, 1e3 * travel)
    curve = LoadCurve.from_cycle(np.append(travel, travel[-2::-1]), np.append(force, force[-2::-1]))
    assert len(curve.branches) == 2


def test_rows_after_the_largest_travel_are_not_lost_in_silence(tmp_path: Path) -> None:
    """One that is out of its place, and an unloading that ends early."""
    travel, force = (values[: np.argmax(values) + 1] for values in cycle(FORWARD_TABLE, 1, step=20e-6))
    order = np.insert(np.arange(len(travel) - 1), 102, len(travel) - 1)
    with pytest.raises(RecordError, match=r"travel turns back by .* within unloading"):
        read_load_curve(write(tmp_path / "moved.csv", travel[order], force[order]))
    part = np.append(np.arange(len(travel)), len(travel) - np.arange(2, 12))
    (note,) = read_load_curve(write(tmp_path / "part.csv", travel[part], force[part])).notes
    # Two lines are above the samples.
    assert f"(rows after row {len(travel) + 2}, the largest travel, are left out)" in note


def test_a_force_that_leaps_at_the_largest_travel_is_noted(tmp_path: Path) -> None:
    travel, force = cycle(FORWARD_TABLE, 1, step=20e-6)
    turn = int(np.argmax(travel))
    force[turn] += 2.0 * np.ptp(force)
    (note,) = read_load_curve(write(tmp_path / "peak.csv", travel, force)).notes
    assert re.fullmatch(
        r"the force at the largest travel \(row \d+\) exceeds its neighbors by .* N: .*", note
    )
