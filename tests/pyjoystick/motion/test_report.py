"""The short reports."""

from __future__ import annotations

import math

import pytest

from pyjoystick.motion import Case, Difference, free_oscillation_report
from pyjoystick.runs import reference_free_oscillation
from pyjoystick.support import version_of, versions

DIFFERENCES = [Difference(name, "", value, 0.0, 0.0) for name, value in (("theta", 1e-9), ("omega", 2e-7))]


@pytest.mark.parametrize("duration", [1.5, 0.3])
def test_a_report_has_peaks_periods_and_differences(duration: float) -> None:
    run = reference_free_oscillation(math.radians(-20.0), duration=duration)
    differences = [*DIFFERENCES, Difference("alpha", "rad/s2", 3e-5, 0.0, 0.0)]
    text = free_oscillation_report(
        "Title", {"one": Case(run, differences, 154), "two": Case(run, differences, 7)}
    )
    lines = text.splitlines()
    assert lines[0] == "# Title"
    rows = [line for line in lines if line.startswith("| ") and line[2].isdigit()]
    assert len(rows) == (9 if duration == 1.5 else 2)
    first = [cell.strip() for cell in rows[0].strip("|").split("|")]
    assert first[1:4] == first[4:]
    assert first[:3] == ["1", "0.12164", "+14.4361"]
    assert float(first[3]) == pytest.approx(float(rows[1].split("|")[2]), abs=1e-5)
    assert any("2.0e-07" in line and line.startswith("| omega (rad/s)") for line in lines)
    assert any("154" in line and "7" in line for line in lines)
    assert f"numpy {version_of('numpy')}" in text
    assert max(map(len, lines)) <= 100


def test_a_package_that_is_not_installed_is_said_to_be_so() -> None:
    assert version_of("no-such-package-at-all") == "not installed"
    assert list(versions())[:2] == ["Python", "pyjoystick"]
