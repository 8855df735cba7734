"""From the files of the synthetic laboratory back to what was put in."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.cli import main
from pyjoystick.measured_peaks import measured_peaks
from pyjoystick.measurements.angle import measure_angle
from pyjoystick.measurements.reading import read_markers
from pyjoystick.records import read_repeats
from pyjoystick.synthetic_laboratory import BASE, TOP
from tests.scenarios.scripts import load

FORWARD = {"trial_1.c3d": "x", "trial_2.c3d": "x", "trial_3.csv": "x", "trial_4.csv": "-x"}


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("synthetic_laboratory")
    assert load("data/make_synthetic_laboratory").main(folder) == 0
    return folder


@pytest.mark.parametrize("name", FORWARD)
def test_the_angle_is_the_true_one_within_its_noise(laboratory: Path, name: str) -> None:
    script = load("data/make_synthetic_laboratory")
    truth = json.loads((laboratory / "truth.json").read_text())["releases"][name]
    _, theta, _ = script.motion(truth["release_angle"], truth["release_time"])
    measured = measure_angle(read_markers(laboratory / name), top=TOP, base=BASE, forward=FORWARD[name])
    seen = np.isfinite(measured.theta)
    assert np.count_nonzero(~seen) == 9
    # Beside noise there is a factor, from the radius of the arc, and the rest position as zero.
    design = np.column_stack((theta[::30], np.ones(180)))[seen]
    (factor, zero), residual, *_ = np.linalg.lstsq(design, measured.theta[seen], rcond=None)
    error = measured.arc.radius_error / measured.arc.radius
    assert abs(factor - 1.0) < 3.0 * error < 0.05
    assert abs(zero) < math.radians(0.25)
    noise = math.sqrt(float(residual[0]) / (np.count_nonzero(seen) - 2))
    assert noise == pytest.approx(measured.noise, rel=0.25)
    assert measured.noise == pytest.approx(3e-4 / 0.266, rel=0.2)


def test_the_swapped_sign_is_found_and_the_records_are_repeats(
    laboratory: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, forward in FORWARD.items():
        arguments = ["import", "markers", str(laboratory / name), "--top", TOP, "--base", *BASE]
        arguments += ["--released", "backward", "--output", str(tmp_path / f"{Path(name).stem}.csv")]
        assert main(arguments) == (0 if forward == "x" else 1)
        if forward != "x":
            assert "wrong sign?" in capsys.readouterr().err
            assert main([*arguments, "--forward", forward]) == 0
    records = read_repeats(sorted(tmp_path.glob("trial_?.csv")), released="backward")
    truth = json.loads((laboratory / "truth.json").read_text())["releases"]
    for record, true in zip(records, truth.values(), strict=True):
        peaks = measured_peaks(record)
        assert peaks.release_time == pytest.approx(true["release_time"], abs=4.0 * 5e-4)
        # The scale of the angle has a standard error of 1 % of 20 degrees.
        assert peaks.release_angle == pytest.approx(true["release_angle"], abs=3.0 * math.radians(0.2))
