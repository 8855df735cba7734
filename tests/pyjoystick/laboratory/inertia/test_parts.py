"""Inertia from parts, against bodies whose inertia is known."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.laboratory import Measured, from_parts, read_parts
from pyjoystick.laboratory.inertia.parts import Part
from pyjoystick.motion import RecordError
from pyjoystick.support import ParameterError

FILE = """# synthetic
part;mass (g);u_mass (g);height (mm);u_height (mm);offset (mm);inertia (g.cm2)
shaft;300;1;100;0.5;0;10000
grip;500;2;220;1;5;9000
cam;70;0.5;-10;0.2;0;120
"""


def rod(name: str, mass: float, low: float, high: float) -> Part:
    """A thin rod along the axis."""
    own = mass * (high - low) ** 2 / 12.0
    return Part(name=name, mass=Measured(mass), height=Measured((low + high) / 2.0), inertia=Measured(own))


def test_a_rod_in_pieces_is_the_whole_rod() -> None:
    """J = m*l^2/3 about its end."""
    pieces = [rod(str(i), 0.2, 0.1 * i, 0.1 * (i + 1)) for i in range(4)]
    found = from_parts(pieces)
    assert found.m.value == pytest.approx(0.8, rel=1e-14)
    assert found.h.value == pytest.approx(0.2, rel=1e-14)
    assert found.J.value == pytest.approx(0.8 * 0.4**2 / 3.0, rel=1e-14)
    assert found.notes == ()


def test_a_part_beside_the_axis() -> None:
    side = Part(
        name="side", mass=Measured(1.0), height=Measured(0.3), offset=Measured(0.4), inertia=Measured(0.01)
    )
    found = from_parts([side])
    assert found.J.value == pytest.approx(0.01 + 0.25, rel=1e-14)
    assert found.notes[0].startswith("the center of mass lies 400 mm off the axis")


def test_uncertainties_by_hand() -> None:
    part = Part(
        name="ball", mass=Measured(2.0, 0.01), height=Measured(0.5, 0.002), inertia=Measured(0.1, 0.005)
    )
    found = from_parts([part])
    at_second_order = math.sqrt(3.0) * 2.0 * 0.002**2
    of_height = math.hypot(2.0 * 2.0 * 0.5 * 0.002, at_second_order)
    by_part = {"mass": 0.25 * 0.01, "height": of_height, "inertia": 0.005}
    for what, expected in by_part.items():
        assert found.J.budget[f"ball: {what}"] == pytest.approx(expected, rel=1e-9)
    assert found.J.uncertainty == pytest.approx(math.hypot(*by_part.values()), rel=1e-9)
    assert found.h.uncertainty == pytest.approx(0.002, rel=1e-9)


def test_a_part_on_the_axis_may_be_off_it() -> None:
    """At an offset of 0, J has a minimum: m*x^2 has the mean m*u^2 and the variance 2*(m*u^2)^2."""
    masses, error = (0.5, 0.37), 0.005
    parts = [
        Part(
            name=str(mass),
            mass=Measured(mass),
            height=Measured(0.1),
            inertia=Measured(1e-3),
            offset=Measured(0.0, error),
        )
        for mass in masses
    ]
    found = from_parts(parts)
    shift, variance = sum(masses) * error**2, 2.0 * sum(mass**2 for mass in masses) * error**4
    assert found.J.uncertainty == pytest.approx(math.hypot(shift, math.sqrt(variance)), rel=1e-9)
    assert found.J.uncertainty == pytest.approx(math.hypot(*found.J.budget.values()), rel=1e-9)
    offsets = error * np.random.default_rng(1).standard_normal((20_000, 2))
    errors = offsets**2 @ np.array(masses)
    assert found.J.uncertainty == pytest.approx(np.sqrt(np.mean(errors**2)), rel=0.05)


def test_a_file(tmp_path: Path) -> None:
    path = tmp_path / "parts.csv"
    path.write_text(FILE, encoding="utf-8")
    parts = read_parts(path)
    assert [part.name for part in parts] == ["shaft", "grip", "cam"]
    path.write_text(FILE + ";;;;;;\n" * 3, encoding="utf-8")  # as spreadsheets do
    assert read_parts(path) == parts
    assert parts[1].mass == Measured(0.5, 0.002)
    assert parts[2].height == Measured(-0.01, pytest.approx(0.0002))
    assert parts[0].inertia == Measured(pytest.approx(1e-3))
    found = from_parts(parts)
    assert found.m.value == pytest.approx(0.87)
    expected = 1e-3 + 9e-4 + 1.2e-5 + 0.3 * 0.1**2 + 0.5 * (0.22**2 + 0.005**2) + 0.07 * 0.01**2
    assert found.J.value == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "grip;500",
            "grip;-500",
            "column 'mass (g)', row 4: is not allowed (found -500); must be above 0",
        ),
        (
            "0.5;0;10000",
            "-0.5;0;10000",
            "column 'u_height (mm)', row 3: is not allowed (found -0.5); must be 0 or more",
        ),
        ("grip;500", "shaft;500", "row 4: a part occurs twice (found shaft); give each its own name"),
        ("mass (g);u", "mass;u", "column 'mass', row 2: has no unit; write it in the heading"),
        (
            "(mm);u_h",
            "(inch);u_h",
            "column 'height (inch)', row 2: has an unknown unit (found inch); known are m, cm, mm",
        ),
        (
            "grip;500",
            "grip;0,5",
            "column 'mass (g)', row 4: is not a number (found '0,5'); write numbers with a decimal",
        ),
        ("70;0.5", ";0.5", "column 'mass (g)', row 5: samples without a finite number"),
        ("inertia (g.cm2)", "own (g.cm2)", "has no column 'inertia'"),
        (
            "offset (mm)",
            "ofset (mm)",
            "column 'ofset (mm)': is not known; known are part, mass",
        ),
        ("cam;", "Total;", "row 5: is no part (found Total); remove the row"),
        ("cam;", "Sum:;", "row 5: is no part (found Sum:); remove the row"),
        ("cam;", "TOTAL (all);", "row 5: is no part"),
        ("cam;", "\u03a3;", "row 5: is no part"),
        ("cam;", "Total mass;", "row 5: is no part"),
        ("cam;", "Std;", "row 5: is no part"),
        ("cam;", ";", "row 5: has no name"),
        ("cam;", "GRIP;", "row 5: a part occurs twice"),
    ],
)
def test_mistakes_in_a_file_are_named(tmp_path: Path, old: str, new: str, message: str) -> None:
    path = tmp_path / "parts.csv"
    path.write_text(FILE.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(RecordError) as refused:
        read_parts(path)
    assert message in str(refused.value)


@pytest.mark.parametrize("form", ["{}", "x{}", "{}x", "{} pcs", "{} ea", "({})"])
def test_a_number_of_pieces_is_not_ignored(form: str, tmp_path: Path) -> None:
    lines = FILE.splitlines()
    head = next(i for i, line in enumerate(lines) if line.startswith("part"))
    counted = [f"{line};{form.format(4 - i % 2)}" for i, line in enumerate(lines[head + 1 :])]
    file = tmp_path / "parts.csv"
    file.write_text("\n".join([*lines[:head], f"{lines[head]};Qty", *counted]), encoding="utf-8")
    with pytest.raises(RecordError, match=r"column 'Qty': is not known; .* a part that is there twice"):
        read_parts(file)


@pytest.mark.parametrize("name", ["4 x knob", "4x knob", "knob (4x)", "knob x4", "knob, 4 pcs"])
def test_a_number_of_pieces_in_a_name_is_noted(name: str) -> None:
    parts = [rod(name, 0.1, 0.05, 0.01), rod("screw M4x20", 0.25, 0.1, 0.02)]
    assert from_parts(parts).notes == (f"{name} counts once: give each piece its own row",)


def test_a_part_with_the_mass_of_all_others_is_noted() -> None:
    knob, shaft, base = rod("knob", 0.1, 0.05, 0.01), rod("shaft", 0.3, 0.1, 0.02), rod("base", 0.5, 0.1, 0.0)
    total = rod("assembly", 0.4, 0.1, 0.0)
    assert from_parts([base, knob, shaft]).notes == ()
    for parts in ([knob, shaft, total], [total, knob, shaft, base], [base, knob, shaft, total]):
        (note,) = from_parts(parts).notes
        assert note == "assembly has the mass of the parts beside it: a total would count them twice"


@pytest.mark.parametrize("name", ["sum plate", "total station adapter", "maximum"])
def test_a_part_may_have_the_word_of_a_total_in_its_name(name: str, tmp_path: Path) -> None:
    file = tmp_path / "parts.csv"
    file.write_text(FILE.replace("cam;", f"{name};"), encoding="utf-8")
    assert name in [part.name for part in read_parts(file)]


def test_no_parts_or_a_body_below_the_pivot() -> None:
    with pytest.raises(ParameterError, match="one part or more"):
        from_parts([])
    with pytest.raises(ParameterError, match="heights count upward"):
        from_parts([rod("hanging", 1.0, -0.3, 0.0)])


def test_an_unknown_column_with_some_numbers_is_not_ignored(tmp_path: Path) -> None:
    lines = FILE.splitlines()
    head = next(i for i, line in enumerate(lines) if line.startswith("part"))
    file = tmp_path / "parts.csv"
    for heading, is_refused in (("y (mm)", True), ("material", False)):
        more = [f"{line};{7075 if i % 2 else '~12'}" for i, line in enumerate(lines[head + 1 :])]
        file.write_text("\n".join([*lines[:head], f"{lines[head]};{heading}", *more]), encoding="utf-8")
        if is_refused:
            with pytest.raises(RecordError, match=r"column 'y \(mm\)': is not known"):
                read_parts(file)
        else:
            assert len(read_parts(file)) == len(more)
