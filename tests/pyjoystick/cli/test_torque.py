"""``pyjoystick torque``."""

from __future__ import annotations

import json
import math
import shlex
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.forced_motion import ForwardAndReturn, Samples, measure, torque_by_reference
from pyjoystick.model import NOMINAL
from tests.pyjoystick.cli.conftest import Command

MOTION = ForwardAndReturn(amplitude=math.radians(15.0), rise=0.15)
_UNITS = {"time": "s", "theta": "rad", "omega": "rad/s", "alpha": "rad/s2"}


def _rows(out: str) -> dict[str, list[str]]:
    """Cells by the first one, of both tables."""
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in out.splitlines() if "|" in line]
    return {f"{row[0]}, {len(row)}": row[1:] for row in rows}


def test_the_numbers_of_both_laws_are_printed(command: Command) -> None:
    outcome = command("torque")
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.out.startswith("Torque for 15 deg in 0.15 s, 0 s there, back in 0.15 s, minimum-jerk\n")
    rows = _rows(outcome.out)
    samples = Samples.of(NOMINAL, MOTION)
    expected = measure(NOMINAL, samples, torque_by_reference(NOMINAL, samples))
    assert rows["total, constant damping, 7"][0] == f"{expected.total.highest:.3f}"
    assert rows["damping, constant, 7"][4] == f"{1e3 * expected.loss:.2f}"
    assert rows["constant damping, 8"][0] == f"{expected.peak_force:.2f}"
    assert float(rows["damping, power-law, 7"][0]) > 1.5 * float(rows["damping, constant, 7"][0])
    difference = float(outcome.out.split("differs by at most ")[1].split()[0])
    assert difference < 1e-12


def test_everything_is_written(command: Command, tmp_path: Path) -> None:
    motion_options = "-a -12deg --stroke-time 0.2 --return-time 0.3 --dwell 0.1 --shape trapezoid --flat 0.5"
    files = ("--csv", "t.csv", "--json", "t.json", "--plot", "t.png")
    outcome = command("torque", *shlex.split(motion_options), "--damping", "power-law", *files)
    assert outcome.code == 0
    assert [line.split()[-1] for line in outcome.err.splitlines()] == ["t.csv", "t.json", "t.png"]
    content = json.loads((tmp_path / "t.json").read_text())
    motion = content["motion"]
    assert motion["amplitude"] == pytest.approx(math.radians(-12.0))
    assert (motion["rise"], motion["fall"], motion["dwell"], motion["flat"]) == (0.2, 0.3, 0.1, 0.5)
    (law,) = content["laws"]
    assert law["damping"] == "power-law"
    assert law["work"] == pytest.approx(law["loss"], rel=1e-10)
    table = pd.read_csv(tmp_path / "t.csv", index_col="time (s)")
    assert table.index[-1] == pytest.approx(0.6)
    np.testing.assert_allclose(table["F (N)"] * 0.266, table["T (N.m)"], rtol=1e-12, atol=1e-15)
    assert np.abs(table["theta (rad)"]).max() == pytest.approx(math.radians(12.0), rel=1e-12)
    assert (tmp_path / "t.png").stat().st_size > 10_000


def test_a_measured_motion(command: Command, tmp_path: Path) -> None:
    """With its three columns it gives the torque of the motion in closed form."""
    fine = Samples.evenly(MOTION, 1e-4)
    names = {"theta": "Angle (deg)", "omega": "omega (deg/s)", "alpha": "alpha (deg/s2)"}
    columns = {heading: np.degrees(getattr(fine, name)) for name, heading in names.items()}
    pd.DataFrame({"time (s)": fine.time, **columns}).to_csv(tmp_path / "m.csv", index=False)
    measured = command("torque", "m.csv", "--column", "theta=Angle")
    assert measured.code == 0
    assert measured.out.startswith("Torque for m.csv, 0.3 s\n")
    assert _rows(measured.out)["total, constant damping, 7"][0] == "2.105"
    pd.DataFrame({"t": fine.time[::100], "a": fine.theta[::100]}).to_csv(tmp_path / "a.csv", index=False)
    units = ("--unit", "time=s", "--unit", "theta=rad", "--column", "time=t", "--column", "theta=a")
    filtered = command("torque", "a.csv", *units, "--json", "a.json")
    assert filtered.code == 0
    assert "a.csv: angle filtered at 13 Hz and differentiated" in filtered.err
    assert json.loads((tmp_path / "a.json").read_text())["motion"]["differentiated"] is True


def test_the_work_of_a_coarsely_sampled_motion(command: Command, tmp_path: Path) -> None:
    """It is the energy that is stored and lost, although no sample lies where the preload sets in."""
    turn = 2.0 * np.pi * 2.5
    time = np.arange(0.0, 1.6, 1.0 / 60.0)
    theta = 0.2 * np.sin(turn * time)
    columns = (time, theta, 0.2 * turn * np.cos(turn * time), -(turn**2) * theta)
    names = [f"{name} ({unit})" for name, unit in _UNITS.items()]
    pd.DataFrame(dict(zip(names, columns, strict=True))).to_csv(tmp_path / "m.csv", index=False)
    assert command("torque", "m.csv", "--damping", "constant", "--json", "t.json").code == 0
    law = json.loads((tmp_path / "t.json").read_text())["laws"][0]
    assert law["work"] == pytest.approx(law["loss"] + law["energy_change"], abs=2e-4)


def test_settings_of_the_filter_are_refused_where_nothing_is_filtered(
    command: Command, tmp_path: Path
) -> None:
    fine = Samples.evenly(MOTION, 1e-4)
    columns = {f"{name} ({unit})": getattr(fine, name) for name, unit in _UNITS.items()}
    pd.DataFrame(columns).to_csv(tmp_path / "m.csv", index=False)
    pd.DataFrame(columns).drop(columns="alpha (rad/s2)").to_csv(tmp_path / "a.csv", index=False)
    for option, other in (("--rate", "500"), ("--cutoff", "20")):
        refused = command("torque", "m.csv", option, other)
        assert (refused.code, refused.out) == (2, "")
        message = (
            f"Invalid value for {option}: is for a motion without omega or alpha, and MOTION.csv has both"
        )
        assert message in " ".join(refused.err.replace("│", " ").split())
        assert command("torque", "a.csv", option, other).code == 0
    assert "filtered at 20 Hz" in command("torque", "a.csv", "--cutoff", "20").err
    assert command("torque", "a.csv", "--cutoff", "-5").message.startswith("cutoff = -5.0: must be")


def test_parameters_and_the_place_of_the_hand(command: Command) -> None:
    plain = _rows(command("torque", "--damping", "constant").out)
    lower = _rows(command("torque", "--damping", "constant", "--pivot-to-handle", "0.133").out)
    assert float(lower["constant damping, 8"][0]) == pytest.approx(
        2.0 * float(plain["constant damping, 8"][0]), abs=0.011
    )
    damped = _rows(command("torque", "--set", "damping.C=0.09").out)
    assert "damping, power-law, 7" not in damped
    loss = float(plain["damping, constant, 7"][4])
    assert float(damped["damping, constant, 7"][4]) == pytest.approx(2.0 * loss, abs=0.011)
    heavy = _rows(command("torque", "--set", "J=0.0227").out)
    assert float(heavy["inertia, 7"][0]) == pytest.approx(2.0 * float(plain["inertia, 7"][0]), abs=0.0011)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--angle", "0"), "Invalid value for --angle: 0.0 must be an angle other than 0 rad"),
        (("--angle", "100deg"), "'100deg' must lie between -90deg and 90deg"),
        (("--stroke-time", "0"), "Invalid value for --stroke-time: 0.0 must be a finite number above 0 s"),
        (("--dwell", "-1"), "Invalid value for --dwell"),
        (
            ("--shape", "square"),
            "Invalid value for --shape: square must be one of minimum-jerk, raised",
        ),
        (("--flat", "0.5"), "Invalid value for --flat: is for --shape trapezoid"),
        (("--unit", "theta=deg"), "Invalid value for --unit: is for a measured motion"),
        (("--rate", "0"), "Invalid value for --rate: is for a measured motion"),
        (("--rate", "600", "--cutoff", "-5"), "Invalid value for --rate: is for a measured motion"),
        (("--cutoff", "13"), "Invalid value for --cutoff: is for a measured motion"),
        (
            ("m.csv", "--output-interval", "1"),
            "Invalid value for --output-interval: is for a motion in closed",
        ),
        (("m.csv", "--dwell", "1"), "Invalid value for --dwell: is for a motion in closed form"),
        (("--damping", "cubic"), "'cubic' is not one of"),
    ],
)
def test_wrong_usage(command: Command, tmp_path: Path, arguments: tuple[str, ...], message: str) -> None:
    outcome = command("torque", *arguments, "--csv", "t.csv")
    assert (outcome.code, outcome.out) == (2, "")
    assert message in " ".join(outcome.err.replace("│", " ").split())
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("nowhere.csv",), "nowhere.csv: cannot be read"),
        (("--set", "J=-1"), "J = -1.0: must be a finite number above 0 kg.m2"),
        (("--set", "K=1"), "there is no parameter 'K'"),
        (("--pivot-to-handle", "0"), "pivot_to_handle = 0.0: must be"),
        (("--output-interval", "0"), "output_interval = 0.0: must be"),
        (("--plot", "t.doc"), "cannot write t.doc: the name must end in"),
    ],
)
def test_errors_are_one_line(command: Command, arguments: tuple[str, ...], message: str) -> None:
    outcome = command("torque", *arguments)
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.message.startswith(message)


def test_angles_beyond_the_stops_are_told(command: Command) -> None:
    outcome = command("torque", "--angle", "45")
    assert outcome.code == 0
    assert "45 degrees are beyond the stops of the paper's joystick at about 20 degrees" in outcome.err
