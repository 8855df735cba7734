"""``pyjoystick vibration``."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

from tests.pyjoystick.cli.conftest import Command


def test_alone_and_in_a_hand(command: Command, tmp_path: Path) -> None:
    """A hand makes the handle ten times as stiff."""
    given = ("--range", "0.5", "20", "--acceleration", "1", "--csv", "v.csv", "--plot", "v.png")
    outcome = command("vibration", *given)
    assert outcome.code == 0, outcome.err
    assert "| Hz: angle (deg per m/s2) |" in outcome.out
    assert "| Hz: top over base " in outcome.out
    table = pd.read_csv(tmp_path / "v.csv")
    assert list(table["series"].unique()) == ["alone", "hand", "alone, 1 m/s2", "hand, 1 m/s2"]
    first = table.groupby("series")["gain"].first()
    assert first["alone"] == pytest.approx(10.0 * first["hand"], rel=0.1)
    assert first["hand, 1 m/s2"] == pytest.approx(first["hand"], rel=1e-3)
    assert (tmp_path / "v.png").stat().st_size > 1e4


def test_in_the_middle_only_a_hand_holds_it(command: Command) -> None:
    outcome = command("vibration", "--angle", "0", "--hand-mass", "0.3")
    assert outcome.code == 0, outcome.err
    assert "without a hand" in outcome.err
    assert "| alone" not in outcome.out


@pytest.mark.parametrize(
    ("options", "code", "message"),
    [
        (("--range", "5", "1"), 2, "the lower one first"),
        (("--acceleration", "0"), 1, "acceleration = 0.0: must be a finite number above 0 m/s2"),
        (("--set", "friction.T_c=0.01"), 1, "small motions would stick"),
        (("--set", "stops.theta_stop=5deg"), 1, "within the stops"),
        (("--hand-mass", "-1"), 1, "mass"),
    ],
)
def test_what_cannot_be_right_is_refused(
    command: Command, options: tuple[str, ...], code: int, message: str
) -> None:
    outcome = command("vibration", *options)
    assert outcome.code == code
    assert message in outcome.err
