"""The short reports."""

from __future__ import annotations

import math

from pyjoystick.motion import Case, Difference, free_oscillation_report
from pyjoystick.support import version_of, versions
from tests.pyjoystick.releases import linear_run


def test_a_report_has_peaks_periods_and_differences() -> None:
    """Of two linear joysticks, whose peaks are at multiples of half a period."""
    runs = {"slow": linear_run(0.01, 0.04, 20.0), "fast": linear_run(0.01, 0.02, 30.0)[:300]}
    text = free_oscillation_report(
        "Title",
        {
            "slow": Case(runs["slow"], _differences(1e-9, 2e-7, 3e-5), 154),
            "fast": Case(runs["fast"], _differences(4e-9, 5e-7, 6e-5), 7),
        },
    )
    lines = text.splitlines()
    assert lines[0] == "# Title"
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if line.startswith("|")]
    peaks = {row[0]: row[1:] for row in rows if row[0].isdigit()}
    assert list(peaks) == [str(number) for number in range(1, 10)]
    for number, cells in ((1, peaks["1"]), (4, peaks["4"])):
        for frequency, decay, found in ((20.0, 2.0, cells[:3]), (30.0, 1.0, cells[3:])):
            if number == 4 and frequency == 30.0:
                assert found == ["", "", ""]  # the run ends before
                continue
            instant = number * math.pi / frequency
            height = (-1) ** (number + 1) * math.degrees(0.3) * math.exp(-decay * instant)
            assert found == [f"{instant:.5f}", f"{height:+.4f}", f"{2.0 * math.pi / frequency:.5f}"]
    by_name = {row[0]: row[1:] for row in rows if not row[0].isdigit()}
    assert by_name["largest difference to the reference"] == ["slow", "fast"]
    assert by_name["theta (rad)"] == ["1.0e-09", "4.0e-09"]
    assert by_name["omega (rad/s)"] == ["2.0e-07", "5.0e-07"]
    assert by_name["alpha (rad/s2)"] == ["3.0e-05", "6.0e-05"]
    assert by_name["state events of the reference"] == ["154", "7"]
    assert f"numpy {version_of('numpy')}" in text
    assert max(map(len, lines)) <= 100


def _differences(*largest: float) -> list[Difference]:
    return [
        Difference(name, "", value, 0.0, 0.0)
        for name, value in zip(("theta", "omega", "alpha"), largest, strict=True)
    ]


def test_a_package_that_is_not_installed_is_said_to_be_so() -> None:
    assert version_of("no-such-package-at-all") == "not installed"
    assert list(versions())[:2] == ["Python", "pyjoystick"]
