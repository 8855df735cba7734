"""PyFMI (FMI Library, Assimulo) where it is installed, against the reference."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick import NOMINAL
from pyjoystick.model import simulate
from tests.other_tools.programs import require, run

RELEASE = math.radians(-20.0)

PROGRAM = """
from pyfmi import load_fmu
model = load_fmu(fmu, kind=kind, log_level=2)
model.set("theta_start", release)
options = model.simulate_options()
options["ncp"] = 1500
if kind == "ME":
    options["CVode_options"].update({"rtol": 1e-10, "atol": 1e-12})
result = model.simulate(final_time=1.5, options=options)
print(json.dumps([list(map(float, result[name])) for name in ("time", "theta")]))
"""


@pytest.mark.parametrize(("kind", "limit"), [("ME", 1e-6), ("CS", 1e-7)])
def test_free_oscillation(kind: str, limit: float, joystick_fmus: Path, tmp_path: Path) -> None:
    require("pyfmi")
    time, theta = run(PROGRAM, fmu=str(joystick_fmus / "Joystick.fmu"), kind=kind, release=RELEASE)
    # Events are rows too, twice with the same time.
    instants, rows = np.unique(time, return_index=True)
    expected = simulate(NOMINAL, time=instants, theta_start=RELEASE).theta
    assert np.abs(np.array(theta)[rows] - expected).max() < limit
