from __future__ import annotations

import dataclasses
import math

import pandas as pd
import pytest

from pyjoystick.identification import Bias, damping_report, estimate_damping, releases_report
from pyjoystick.identification.peak_method.report import bias_report, peak_error_report
from pyjoystick.motion import MeasuredPeaks
from tests.pyjoystick.releases import linear_release

J = 0.01135


def test_an_estimate_stands_beside_its_bias() -> None:
    releases = [linear_release(J, C, 30.0, name=f"{C}") for C in (0.044, 0.046)]
    estimate = estimate_damping(releases, J)
    constants = {name: Bias(one.value, one.value + 0.01, 0.036) for name, one in estimate.constants.items()}
    lines = {name: Bias(0.05, 0.06, 0.041) for name in ("A_pos", "n_pos", "A_neg", "n_neg", "B", "m")}
    rows = damping_report(estimate, constants, lines).splitlines()
    header = [cell.strip() for cell in rows[0].split("|")[2:-1]]
    assert header == ["estimate", "95 % interval", "bias", "corrected"]
    cells = [cell.strip() for cell in rows[4].split("|")]
    low, high = estimate.constants["both"].interval() or (0.0, 0.0)
    assert cells[1:-1] == ["C, both", "0.0450", f"{low:.4f} to {high:.4f}", "+0.0100", "0.0360"]
    assert [row.split("|")[1].strip() for row in rows[5:]] == ["A_pos", "n_pos", "A_neg", "n_neg", "B", "m"]
    assert "3 points" in damping_report(dataclasses.replace(estimate, left_out=3), constants, lines)


@pytest.mark.parametrize(
    ("angle", "time_error", "angle_error", "shown"),
    [
        (-20.0, 0.0008, 0.02, ["trial", "0.2500 +- 0.0008", "-20.00 +- 0.02", "0.100", "12 and 12"]),
        (-14.0, 0.00003, 0.0042, ["trial", "0.25000 +- 0.00003", "-14.000 +- 0.004", "0.100", "12 and 12"]),
    ],
    ids=["usual", "no error is printed as zero"],
)
def test_releases_with_their_errors(
    angle: float, time_error: float, angle_error: float, shown: list[str]
) -> None:
    plain = linear_release(J, 0.045, 30.0)
    measured = MeasuredPeaks(
        name="trial",
        release_time=0.25,
        release_angle=math.radians(angle),
        displacement=plain.displacement,
        velocity=plain.velocity,
        release_time_error=time_error,
        release_angle_error=math.radians(angle_error),
        noise=math.radians(0.1),
    )
    cells = [cell.strip() for cell in releases_report([measured]).splitlines()[2].split("|")[1:-1]]
    assert cells == shown


def test_the_table_of_the_bias() -> None:
    row = {"C": 0.045, "release_angle": math.radians(-20.0), "displacement": 1.26, "velocity": 0.74}
    table = pd.DataFrame([row | {"both": 1.0, "n_pos": 0.04, "n_neg": -0.03, "m": 0.0}])
    cells = [cell.strip() for cell in bias_report(table).splitlines()[2].split("|")[1:-1]]
    assert cells == ["0.045", "-20", "1.260", "0.740", "1.000", "+0.040", "-0.030", "+0.000"]


def test_errors_at_some_values_and_the_minima() -> None:
    columns = ["displacement", "displacement_time", "velocity", "velocity_time"]
    sweep = pd.DataFrame([[9.0] * 4, [1.0, 2.0, 3.0, 4.0]], index=[0.03, 0.045], columns=columns)
    lines = peak_error_report({"C": sweep}, {"C": [0.031]}).splitlines()
    assert [cell.strip() for cell in lines[2].split("|")[1:-1]] == ["C = 0.03", *["9.0"] * 4]
    least = ["1.0 at 0.045", "2.0 at 0.045", "3.0 at 0.045", "4.0 at 0.045"]
    assert [cell.strip() for cell in lines[3].split("|")[1:-1]] == ["C, smallest", *least]
