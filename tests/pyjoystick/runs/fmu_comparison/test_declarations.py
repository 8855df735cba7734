"""The declarations of two FMUs, side by side."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.fmu import FmuDescription, read_description
from pyjoystick.runs import AttributeDifference, Declarations, compare_declarations
from tests.pyjoystick.fmu.doctored import doctored


@pytest.fixture(scope="module")
def first(pair: Path) -> FmuDescription:
    return read_description(pair / "First.fmu")


@pytest.fixture(scope="module")
def declarations(pair: Path, first: FmuDescription) -> Declarations:
    return compare_declarations(first, read_description(pair / "Second.fmu"))


def test_variables_of_one_alone(declarations: Declarations) -> None:
    assert declarations.only_first == ("own",)
    assert declarations.only_second == ("z",)
    assert declarations.internal_only_first == ("inside",)
    assert set(declarations.internal_only_second) == {"fast", "slow"}
    assert {"k", "n", "u", "x", "y", "integral", "count", "above"} <= set(declarations.shared)


def test_every_attribute_is_compared(declarations: Declarations) -> None:
    assert set(declarations.differences) == {
        AttributeDifference("k", "unit", "1/s", "Hz"),
        AttributeDifference("k", "min", "0.0", "0.5"),
        AttributeDifference("k", "max", "", "4.0"),
        AttributeDifference("n", "start", "3", "4"),
        AttributeDifference("inverted", "start", "false", "true"),
    }


def test_an_fmu_declares_what_it_declares(first: FmuDescription) -> None:
    alone = compare_declarations(first, first)
    assert alone.shared == tuple(first.variables)
    assert (alone.only_first, alone.only_second, alone.differences) == ((), (), ())


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ('start="2.0"', 'start="2.0000000000000004"', []),
        ('start="2.0"', 'start="2E0"', []),
        ('start="false"', 'start="0"', []),
        ('start="2.0"', 'start="2.00001"', [("k", "start", "2.0", "2.00001")]),
        ('start="2.0"', "", [("k", "start", "2.0", "")]),
        ('start="false"', 'start="1"', [("inverted", "start", "false", "1")]),
        ('start="1.0" unit="m"', 'start="3.0" unit="m"', [("x", "start", "1.0", "3.0")]),
        (
            '<Real start="0.5" unit="N"/>',
            '<Integer start="2"/>',
            [("u", "type", "Real", "Integer"), ("u", "unit", "N", ""), ("u", "start", "0.5", "2")],
        ),
        ('causality="input"', 'causality="output"', [("u", "causality", "input", "output")]),
        # Which of its internal values a tool calls parameters is its own business.
        ('causality="local"', 'causality="calculatedParameter"', []),
        # What is calculated starts where it is calculated to.
        (
            'initial="calculated">\n      <Real unit="N"/>',
            'initial="calculated"><Real unit="N" start="4"/>',
            [],
        ),
    ],
)
def test_what_counts_as_a_difference(
    old: str, new: str, expected: list[tuple[str, ...]], first: FmuDescription, tmp_path: Path
) -> None:
    def changed(text: str) -> str:
        assert old in text
        return text.replace(old, new, 1)

    other = read_description(doctored(first.path, tmp_path / "other.fmu", description=changed))
    assert list(compare_declarations(first, other).differences) == [
        AttributeDifference(*one) for one in expected
    ]
