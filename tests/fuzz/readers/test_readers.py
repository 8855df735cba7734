"""A fixed number of trials; ``make fuzz`` runs more, with new random numbers."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick import Fmu
from tests.fuzz.readers import corpus, patience, trial as trials
from tests.fuzz.readers.subjects import Subject
from tests.fuzz.readers.trial import trial

pytestmark = pytest.mark.xdist_group("fuzz-readers")
COUNT = 60


@pytest.fixture(scope="module")
def files(joystick_fmus: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("corpus")
    corpus.make(folder, joystick_fmus)
    return folder


def test_damaged_files_are_read_or_refused(files: Path) -> None:
    faults = [fault for case in range(COUNT) if (fault := trial(case, files)) is not None]
    assert faults == []


def test_a_trial_sees_what_is_wrong(files: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails() -> None:
        raise KeyError("what no reader may raise")

    def hangs() -> None:
        while True:
            pass

    monkeypatch.setattr(trials, "PATIENCE", 0.2)
    for drive, said in ((fails, "KeyError"), (hangs, "did not end within 0.2 s")):
        monkeypatch.setattr(trials, "SUBJECTS", (Subject("drive", "trial_1.csv", (), drive),))
        fault = trial(1, files)
        assert fault is not None
        assert said in fault.what


@pytest.mark.parametrize("is_kept", [False, True])
def test_a_long_run_of_an_fmu_has_to_end_at_ctrl_c(
    files: Path, monkeypatch: pytest.MonkeyPatch, is_kept: bool
) -> None:
    def runs() -> None:
        torque = pd.DataFrame({"T": [0.0, 5e8]}, index=pd.Index([0.0, 1.0], name="time"))
        try:
            with Fmu("Joystick.fmu") as fmu:
                fmu.run(np.linspace(0.0, 1.0, 1001), inputs=torque)
        except KeyboardInterrupt:
            if not is_kept:
                raise
        while is_kept:
            pass

    monkeypatch.setattr(trials, "PATIENCE", 0.5)
    monkeypatch.setattr(patience, "_MOMENT", 0.1)
    monkeypatch.setattr(trials, "SUBJECTS", (Subject("run", "Joystick.fmu", (), runs),))
    monkeypatch.setattr(trials, "damaged", lambda content, *_: content)
    fault = trial(1, files)
    assert (fault is not None) == is_kept
