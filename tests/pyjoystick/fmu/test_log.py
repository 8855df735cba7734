"""Messages reach their own instance, and FMPy's users theirs."""

from __future__ import annotations

from pathlib import Path

import fmpy
import pytest
from fmpy.fmi1 import FMICallException

from pyjoystick.fmu import Fmu, FmuRunError


def test_messages_of_fmpys_own_runs_are_still_printed(
    joystick_path: Path, joystick: Fmu, capfd: pytest.CaptureFixture[str]
) -> None:
    refused = {"forward.balanceSpring.x_0": 0.0}
    with pytest.raises(FmuRunError) as before:
        joystick.run([0.0, 0.1], parameters=refused)
    with pytest.raises(FMICallException):
        fmpy.simulate_fmu(str(joystick_path), start_values=refused)
    assert "forward.balanceSpring.x_0 must not be less than" in capfd.readouterr().out
    with pytest.raises(FmuRunError) as after:
        joystick.run([0.0, 0.1], parameters=refused)
    assert after.value.messages == before.value.messages


def test_a_logger_of_someone_else_does_not_keep_the_messages(joystick_path: Path, joystick: Fmu) -> None:
    heard: list[bytes] = []
    with pytest.raises(FMICallException):
        fmpy.simulate_fmu(
            str(joystick_path),
            start_values={"forward.balanceSpring.x_0": 0.0},
            logger=lambda *arguments: heard.append(arguments[-1]),
        )
    assert any(b"balanceSpring.x_0 must not be less" in message for message in heard)
    with pytest.raises(FmuRunError, match=r"balanceSpring\.x_0 must not be less"):
        joystick.run([0.0, 0.1], parameters={"forward.balanceSpring.x_0": 0.0})


def test_a_doubled_number_sign_is_one(mixed: Fmu) -> None:
    # The runtime doubles "%" and "#" as the standard has it; both come back as they were written.
    with pytest.raises(FmuRunError) as caught:
        mixed.run([0.0, 0.2], parameters={"last": 0.1})
    assert any("past the last moment 100 % of #1" in message for message in caught.value.messages)
