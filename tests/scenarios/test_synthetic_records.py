"""The synthetic records are what their script makes, and can be read."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, simulate
from pyjoystick.motion import read_repeats
from tests.scenarios.scripts import SCENARIOS, load

DATA = SCENARIOS / "data"
JOYSTICKS = {"constant": NOMINAL, "power_law": NOMINAL_POWER_LAW}


def test_the_script_reproduces_the_files(tmp_path: Path) -> None:
    assert load("data/make_synthetic_records").main(tmp_path) == 0
    made = sorted(path.name for path in tmp_path.iterdir())
    assert made == sorted(path.name for path in DATA.glob("synthetic_*"))
    for name in made:
        assert (tmp_path / name).read_text() == (DATA / name).read_text(), name


@pytest.mark.parametrize("law", JOYSTICKS)
def test_they_are_called_synthetic_and_raise_no_note(law: str) -> None:
    paths = sorted(DATA.glob(f"synthetic_{law}_?.csv"))
    records = read_repeats(paths, released="backward")
    assert len(records) == 4
    for path, record in zip(paths, records, strict=True):
        assert "synthetic, no measurement" in path.read_text().splitlines()[0]
        assert [note for note in record.notes if not note.startswith("coarse sampling")] == []


@pytest.mark.parametrize("law", JOYSTICKS)
def test_the_truth_beside_them_is_what_they_were_made_from(law: str) -> None:
    """The scatter about the true motion is the noise that the truth names."""
    truth = json.loads((DATA / f"synthetic_{law}_truth.json").read_text())
    joystick = JOYSTICKS[law].replace(truth["parameters"])
    assert joystick == JOYSTICKS[law]
    for record in read_repeats(sorted(DATA.glob(f"synthetic_{law}_?.csv"))):
        release = truth["releases"][record.name]
        after = record.time > release["release_time"]
        time = np.insert(record.time[after], 0, release["release_time"])
        run = simulate(joystick, time=time, theta_start=release["release_angle"])
        expected = np.full(len(record), release["release_angle"])
        expected[after] = run.theta[1:]
        scatter = np.sqrt(np.mean((record.theta - expected) ** 2))
        assert scatter == pytest.approx(truth["noise"], rel=0.25)
        assert record.interval == pytest.approx(1.0 / truth["rate"], abs=1e-6)
