"""The angle from the markers of the synthetic laboratory; docs/your-joystick.md goes the whole way."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.cli import main
from pyjoystick.laboratory import BASE, TOP, measure_angle, read_markers
from pyjoystick.model import NOMINAL
from tests.scenarios.scripts import load

FORWARD = {"trial_1.c3d": "x", "trial_2.c3d": "x", "trial_3.csv": "x", "trial_4.csv": "-x"}


@pytest.fixture(scope="module")
def laboratory(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("synthetic_laboratory")
    assert load("data/make_synthetic_laboratory").main(folder) == 0
    return folder


def test_every_file_says_that_it_is_synthetic(laboratory: Path) -> None:
    files = [path for path in laboratory.iterdir() if path.is_file()]
    assert len(files) == 9
    for file in files:
        assert file.name.startswith("synthetic_")
        assert b"synthetic" in file.read_bytes()[:4096]


@pytest.mark.parametrize("name", FORWARD)
def test_the_angle_is_the_true_one_within_its_noise(laboratory: Path, name: str) -> None:
    """With nothing but the markers: beside noise there is a factor, from the arc, and the rest as zero."""
    theta = np.loadtxt(laboratory / "truth" / f"{Path(name).stem}.csv", delimiter=",", skiprows=2)[:, 1]
    markers = read_markers(laboratory / f"synthetic_{name}")
    measured = measure_angle(markers, top=TOP, base=BASE, forward=FORWARD[name])
    seen = np.isfinite(measured.theta)
    assert np.count_nonzero(~seen) == 9
    design = np.column_stack((theta, np.ones(len(theta))))[seen]
    (factor, zero), residual, *_ = np.linalg.lstsq(design, measured.theta[seen], rcond=None)
    error = measured.arc.radius_error / measured.arc.radius
    assert abs(factor - 1.0) < 3.0 * error < 0.05
    assert abs(zero) < math.radians(0.25)
    noise = math.sqrt(float(residual[0]) / (np.count_nonzero(seen) - 2))
    assert noise == pytest.approx(measured.noise, rel=0.25)
    assert measured.noise == pytest.approx(3e-4 / 0.266, rel=0.2)


def test_the_swapped_sign_is_found(
    laboratory: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, forward in FORWARD.items():
        arguments = ["import", "markers", str(laboratory / f"synthetic_{name}"), "--top", TOP]
        arguments += ["--base", *BASE, "--released", "backward", "--output", str(tmp_path / "a.csv")]
        assert main(arguments) == (0 if forward == "x" else 1)
        if forward != "x":
            assert "wrong sign?" in capsys.readouterr().err
            assert main([*arguments, "--forward", forward]) == 0


def test_the_truth_is_of_a_joystick_that_is_not_the_paper_s(laboratory: Path) -> None:
    truth = json.loads((laboratory / "truth" / "truth.json").read_text())
    same = {name for name, value in NOMINAL.to_names().items() if truth["parameters"][name] == value}
    assert same == {"g"}
