"""``pyjoystick free-oscillation``."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.runs import free_oscillation
from pyjoystick.runs.experiments import COLUMNS
from tests.pyjoystick.cli.conftest import Command


def _csv(path: Path) -> pd.DataFrame:
    return pd.read_csv(path, index_col="time (s)")


def test_the_peaks_are_printed(command: Command, tmp_path: Path) -> None:
    outcome = command("free-oscillation")
    assert (outcome.code, outcome.err) == (0, "")
    lines = outcome.out.splitlines()
    assert lines[0] == "Joystick.fmu: free oscillation from -20 deg (-0.349066 rad), 1.5 s"
    assert lines[2].split() == ["1", "0.12164", "+14.4361"]
    assert lines[3].split() == ["2", "0.23123", "-11.3498", "0.10960"]
    assert lines[-1] == "and 18 more"
    assert list(tmp_path.iterdir()) == []


def test_every_option_has_its_effect(command: Command, tmp_path: Path) -> None:
    outcome = command(
        *("free-oscillation", "-a", "15deg", "-d", "0.5", "--damping", "power-law"),
        *("--set", "damping.alpha=0.5", "--set", "J=0.012", "--output-interval", "0.002"),
        *("--tolerance", "1e-10", "--csv", "out/run.csv", "--plot", "out/run.png"),
    )
    assert outcome.code == 0
    assert outcome.err.splitlines() == ["wrote out/run.csv", "wrote out/run.png"]
    table = _csv(tmp_path / "out" / "run.csv")
    expected = free_oscillation(
        math.radians(15.0),
        parameters=NOMINAL_POWER_LAW.replace({"damping.alpha": 0.5, "J": 0.012}),
        duration=0.5,
        output_interval=0.002,
        tolerance=1e-10,
    )
    assert [heading.split()[0] for heading in table.columns] == list(COLUMNS)
    np.testing.assert_array_equal(table.to_numpy(), expected.to_numpy())
    np.testing.assert_array_equal(table.index, expected.index)
    assert (tmp_path / "out" / "run.png").read_bytes().startswith(b"\x89PNG")


def test_friction_has_its_fmu(command: Command, tmp_path: Path) -> None:
    settings = ("--set", "friction.T_c=50mN.m", "--set", "friction.F_c=0.3")
    outcome = command("free-oscillation", *settings, "--csv", "run.csv")
    assert outcome.out.startswith("JoystickFriction.fmu: ")
    table = _csv(tmp_path / "run.csv")
    assert list(table.columns[-2:]) == ["M_f (N.m)", "isStuck"]
    assert table["isStuck"].iloc[-1]
    assert "JoystickFrictionPowerLaw" in command("free-oscillation", *settings, "--damping", "power-law").out


def test_friction_and_an_fmu_without_it(command: Command) -> None:
    outcome = command("free-oscillation", "--fmu", "Joystick", "--set", "friction.T_c=0.05")
    assert outcome.code == 1
    assert "friction.T_c" in outcome.err


def test_angles_in_radians_and_another_fmu(command: Command, fmus_by_name: Path, tmp_path: Path) -> None:
    path = fmus_by_name / "JoystickPowerLaw.fmu"
    outcome = command("free-oscillation", "-a", "-0.3rad", "-d", "0.1", "--fmu", str(path), "--csv", "a.csv")
    assert outcome.code == 0
    assert "from -17.1887 deg (-0.3 rad)" in outcome.out
    assert _csv(tmp_path / "a.csv")["theta (rad)"].iloc[0] == -0.3
    assert _csv(tmp_path / "a.csv")["C (N.m.s/rad)"].nunique() > 10


def test_peaks_do_not_depend_on_the_interval_of_the_rows(command: Command, tmp_path: Path) -> None:
    fine = command("free-oscillation", "-a", "-20", "--json", "fine.json")
    coarse = command(
        *("free-oscillation", "-a", "-20", "--output-interval", "0.05"),
        *("--csv", "coarse.csv", "--json", "coarse.json"),
    )
    assert coarse.out == fine.out
    assert json.loads((tmp_path / "coarse.json").read_text()) == json.loads(
        (tmp_path / "fine.json").read_text()
    )
    assert len(_csv(tmp_path / "coarse.csv")) == 31


def test_too_short_for_a_peak(command: Command) -> None:
    for interval in ("0.001", "0.01"):
        outcome = command("free-oscillation", "-d", "0.01", "--output-interval", interval)
        assert outcome.code == 0
        assert outcome.out.splitlines()[1:] == ["the run has no peak of the displacement"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--set", "Q=1"), "there is no parameter 'Q'; known are J, m, "),
        (("--set", "damping.c=1"), "there is no parameter 'damping.c'; did you mean damping.C?"),
        (("--set", "J=-1"), "J = -1.0: must be a finite number above 0 kg.m2"),
        (("--set", "J=nan"), "J = nan: must be a finite number above 0 kg.m2"),
        (("--set", "theta_start=0.1"), "theta_start = 0.1: must be left out"),
        (("--set", "forward.returnSpring.k_s=0"), "forward.returnSpring.k_s = 0.0: must be "),
        (("-d", "0"), "duration = 0.0: must be a finite number above 0 s"),
        (("-d", "nan"), "duration = nan: must be a finite number above 0 s"),
        (("--output-interval", "9"), "output_interval = 9.0: must be at most the duration, 1.5 s"),
        (("--fmu", "nowhere.fmu"), "there is no FMU nowhere.fmu; the file does not exist"),
        (("--fmu", __file__), f"{__file__}: not an FMU: not a ZIP archive"),
        (("--fmu", "JoystickInverse"), "JoystickInverse.fmu: does not have the interface of Joystick"),
        (("--plot", "run.gif"), "cannot write run.gif: the name must end in .png, .pdf, .svg"),
    ],
)
def test_wrong_input_is_one_message_and_writes_nothing(
    command: Command, tmp_path: Path, arguments: tuple[str, ...], message: str
) -> None:
    outcome = command("free-oscillation", "--csv", "run.csv", *arguments)
    assert (outcome.code, outcome.out) == (1, "")
    assert message in outcome.message
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--tolerance", "-1"), "'--tolerance'"),
        (("--tolerance", "1e-30"), "'--tolerance'"),
        (("-a", "-20rad"), "'-20rad' must lie between -90deg and 90deg; did you mean -20deg?"),
        (("-a", "100"), "'100' must lie between -90deg and 90deg"),
        (("-a", "steep"), "'steep' is not an angle"),
        (("--set", "J"), "'J' must be NAME=NUMBER"),
        (("--damping", "cubic"), "'cubic' is not one of 'constant', 'power-law'"),
        (("--damping", "constant", "--fmu", "Joystick"), "use --damping or --fmu"),
    ],
)
def test_wrong_usage_writes_nothing(
    command: Command, tmp_path: Path, arguments: tuple[str, ...], message: str
) -> None:
    outcome = command("free-oscillation", "--csv", "run.csv", *arguments)
    assert (outcome.code, outcome.out) == (2, "")
    assert message in outcome.err
    assert list(tmp_path.iterdir()) == []


def test_an_output_that_cannot_be_written(command: Command, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("kept")
    outcome = command("free-oscillation", "--csv", "file/run.csv")
    assert outcome.code == 1
    assert outcome.message.startswith("cannot write file/run.csv: ")
    assert (tmp_path / "file").read_text() == "kept"


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--csv", "file/run.csv"), "cannot write file/run.csv: "),
        (("--plot", "file/run.png"), "cannot write file/run.png: "),
        (
            ("--csv", "run.png", "--plot", "run.png"),
            "cannot write run.png: the name must end in .csv",
        ),
    ],
)
def test_outputs_are_checked_before_the_run(
    command: Command,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    arguments: tuple[str, ...],
    message: str,
) -> None:
    def runs(*_: object, **__: object) -> None:
        raise AssertionError

    monkeypatch.setattr(Fmu, "run", runs)
    (tmp_path / "file").write_text("kept")
    outcome = command("free-oscillation", *arguments)
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.message.startswith(message)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_the_paper_is_what_no_option_gives(command: Command, tmp_path: Path) -> None:
    command("free-oscillation", "--csv", "run.csv")
    expected = free_oscillation(math.radians(-20.0), parameters=NOMINAL)
    np.testing.assert_array_equal(_csv(tmp_path / "run.csv").to_numpy(), expected.to_numpy())


def test_how_long_the_run_can_be_trusted(command: Command) -> None:
    """A free oscillation forgets where it was released: its error never grows."""
    outcome = command("free-oscillation", "--release-angle", "-20deg", "--trusted")
    assert outcome.code == 0
    expected = "trusted until the end: up to there an error as large as the tolerance stays below 1 %"
    assert f"{expected} of the largest angle" in outcome.out
    assert "trusted" not in command("free-oscillation", "--release-angle", "-20deg").out


def test_angles_beyond_the_stops_are_told(command: Command) -> None:
    outcome = command("free-oscillation", "--release-angle", "-45", "--duration", "0.1")
    assert outcome.code == 0
    assert "45 degrees are beyond the stops of the paper's joystick at about 20 degrees" in outcome.err
