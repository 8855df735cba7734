"""Dry friction from a record that includes the driving torque: ``fit --driven --friction``."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.model import NOMINAL, contact_moment, gravity_moment, simulate
from tests.pyjoystick.cli.conftest import Command

TRUTH = {"J": NOMINAL.J, "damping.C": 0.045, "friction.T_c": 0.02, "delay": 0.004}
NOISE = math.radians(0.02)
START = math.radians(6.0)


def _write(path: Path) -> None:
    """Two seconds of pushes to and fro from rest; the torque is straight between corners, so it is exact."""
    hold = float(contact_moment(NOMINAL, START) - gravity_moment(NOMINAL, START))
    corners = np.array([0.0, 0.2, 0.26, 0.6, 0.66, 1.0, 1.06, 1.4, 1.46, 2.0])
    levels = np.array([hold, hold, -1.6, -1.6, 1.6, 1.6, -1.7, -1.7, 1.5, 1.5])
    time = np.arange(1001) / 500.0
    instants = np.concatenate(([0.0], np.maximum(time - TRUTH["delay"], 0.0)))
    run = simulate(
        NOMINAL.replace({"friction.T_c": TRUTH["friction.T_c"]}),
        time=np.unique(instants),
        theta_start=START,
        torque=lambda t: float(np.interp(t, corners, levels)),
        torque_breakpoints=corners,
    )
    theta = run.theta[np.searchsorted(np.unique(instants), instants[1:])]
    theta = theta + NOISE * np.random.default_rng(2).standard_normal(len(time))
    rows = zip(time, np.degrees(theta), np.interp(time, corners, levels), strict=True)
    lines = [f"{t:.6f},{angle:.9g},{torque:.12g}" for t, angle, torque in rows]
    path.write_text("\n".join(("time (s),theta (deg),T (N.m)", *lines)) + "\n")


@pytest.mark.usefixtures("fmus_by_name")
def test_everything_comes_back(command: Command, tmp_path: Path) -> None:
    _write(tmp_path / "hand.csv")
    outcome = command("fit", "hand.csv", "--driven", "--friction", "-o", "out")
    assert outcome.code == 0, outcome.out
    found = json.loads((tmp_path / "out" / "fit.json").read_text(encoding="utf-8"))
    for one in found["parameters"]:
        if one["name"] in TRUTH:
            error = one["standard_error"]
            assert one["value"] == pytest.approx(TRUTH[one["name"]], abs=4.0 * error), one["name"]
            assert error < 0.01 * TRUTH[one["name"]], one["name"]
    names = {one["name"] for one in found["parameters"]}
    assert names >= TRUTH.keys()


@pytest.mark.parametrize(
    "option",
    [("--both-sides",), ("--column", "theta=angle"), ("--unit", "theta=rad")],
    ids=lambda one: one[0],
)
def test_options_for_releases_are_refused(command: Command, tmp_path: Path, option: tuple[str, ...]) -> None:
    outcome = command("fit", "hand.csv", "--driven", *option)
    assert outcome.code == 2
    assert option[0] in outcome.err
    assert "is for releases" in outcome.err
