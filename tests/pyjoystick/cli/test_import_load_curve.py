"""``pyjoystick import load-curve``."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from pyjoystick.model import BACKWARD_TABLE, FORWARD_TABLE, PAPER, read_parameter_file
from tests.pyjoystick.cli.conftest import Command
from tests.pyjoystick.laboratory.load_curve.machine import MACHINE, cycle, write


def test_from_the_machine_to_a_run_of_the_fmu(command: Command, tmp_path: Path) -> None:
    for side, table in (("forward", FORWARD_TABLE), ("backward", BACKWARD_TABLE)):
        write(tmp_path / f"{side}.csv", *cycle(table, 1))
        arguments = ("--side", side, "-p", "joystick.toml", "--plot", f"{side}.png")
        outcome = command("import", "load-curve", f"{side}.csv", *arguments)
        assert outcome.code == 0, outcome.err
        assert f"wrote [{side}] of joystick.toml" in outcome.err
        assert ("joystick.toml is new" in outcome.err) is (side == "forward")
        assert "| balanceSpring.F_0 |" in outcome.out
        assert (tmp_path / f"{side}.png").stat().st_size > 10_000
    found = read_parameter_file(tmp_path / "joystick.toml")
    for side, table in (("forward", FORWARD_TABLE), ("backward", BACKWARD_TABLE)):
        for key in ("x", "k"):
            values = np.array(getattr(found.curves[side], key))  # type: ignore[index]
            errors = np.array([found.uncertainties[f"{side}.{key}[{i}]"] for i in range(4)])
            assert np.all(np.abs(values - getattr(table, key)) < 4.0 * errors)
        assert found.sources[side] == f"load-deflection curve {side}.csv"
    assert found.sources["body"] == PAPER.sources["body"]
    assert command("free-oscillation", "-p", "joystick.toml", "-d", "0.2").code == 0


def test_hysteresis_is_saved_where_asked_for(command: Command, tmp_path: Path) -> None:
    for side, table in (("forward", FORWARD_TABLE), ("backward", BACKWARD_TABLE)):
        write(tmp_path / f"{side}.csv", *cycle(table, 1, step=20e-6))
        outcome = command(
            "import", "load-curve", f"{side}.csv", "--side", side, "-p", "joystick.toml", "--friction"
        )
        assert outcome.code == 0, outcome.err
        assert f"wrote [{side}], [friction] of joystick.toml" in outcome.err
        found = read_parameter_file(tmp_path / "joystick.toml")
        error = found.uncertainties["friction.F_c"]
        assert 0.0 < error < 0.05
        assert abs(found.joystick.friction.F_c - MACHINE.friction) < 4.0 * error
        assert found.sources["friction"] == f"hysteresis of the load-deflection curve {side}.csv"
    assert "(hysteresis of the load-deflection curve forward.csv)" in outcome.err


def test_no_hysteresis_no_friction(command: Command, tmp_path: Path) -> None:
    travel, force = cycle(FORWARD_TABLE, 1)
    turn = int(np.argmax(travel))
    write(tmp_path / "curve.csv", travel[:turn], force[:turn])
    arguments = ("import", "load-curve", "curve.csv", "--friction")
    assert command(*arguments).code == 2
    outcome = command(*arguments, "--side", "forward", "-p", "a.toml")
    assert outcome.code == 1
    assert "error: curve.csv: has no unloading" in outcome.err
    assert not (tmp_path / "a.toml").exists()


def test_wrong_usage_and_bad_files(command: Command, tmp_path: Path) -> None:
    write(tmp_path / "curve.csv", *cycle(FORWARD_TABLE, 1, step=20e-6))
    for arguments in (("--side", "left", "-p", "a.toml"), ("--side", "forward"), ("-p", "a.toml")):
        assert command("import", "load-curve", "curve.csv", *arguments).code == 2
    both = ("--side", "forward", "-p", "a.toml", "--segments", "3")
    assert command("import", "load-curve", "curve.csv", *both).code == 2
    (tmp_path / "bad.csv").write_text((tmp_path / "curve.csv").read_text().replace("(N)", "(dyn)"))
    outcome = command("import", "load-curve", "bad.csv", "--side", "forward", "-p", "a.toml")
    assert outcome.code == 1
    assert outcome.message.startswith("bad.csv, column 'force (dyn)', row 2: has an unknown unit")
    assert not (tmp_path / "a.toml").exists()


def test_forces_in_another_unit_are_refused(command: Command, tmp_path: Path) -> None:
    file = write(tmp_path / "curve.csv", *cycle(FORWARD_TABLE, 1, step=20e-6))
    file.write_text(file.read_text(encoding="utf-8").replace("force (N)", "force (kN)"), encoding="utf-8")
    outcome = command("import", "load-curve", "curve.csv")
    assert outcome.code != 0
    assert "curve.csv: returnSpring.k_s = " in outcome.err
    assert "must be between 10 and 1e+06 N/m, as a joystick's is" in outcome.err
