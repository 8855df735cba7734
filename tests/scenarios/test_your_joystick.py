"""The budget of the synthetic laboratory."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.laboratory import true_joystick
from tests.scenarios.scripts import cells, load


@pytest.mark.usefixtures("fmus_by_name")
def test_the_budget(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    scenario = load("your_joystick")
    # Two of the four releases, one from each kind of file; tests/test_your_joystick.py has them all.
    monkeypatch.setattr(scenario, "FORWARD", {"trial_1.c3d": "x", "trial_4.csv": "-x"})
    assert scenario.main(tmp_path) == 0
    printed = capsys.readouterr().out
    assert (tmp_path / "summary.md").read_text() in printed
    inertia, damping = (float(printed.split(name)[1].split()[0]) for name in ("J = ", "damping.C = "))
    true = true_joystick()
    shares = [float(cell) / 100.0 for cell in cells(printed, "all")[3:]]
    assert inertia == pytest.approx(true.J, rel=2.0 * shares[0])
    assert damping == pytest.approx(true.damping.C, rel=2.0 * shares[1])
    # The fit's own standard errors are a small part: scale, drawing and springs weigh more.
    for share, own in zip(shares, cells(printed, "fit, noise of the records")[3:], strict=True):
        assert float(own) / 100.0 < 0.5 * share < 0.002
    # The filter is the largest error of the measured angle and velocity.
    stages = ["differentiation", "camera's rate and spline", "projection on the plane"]
    for column in (0, 1):
        filtered = float(cells(printed, "filter")[column])
        assert all(float(cells(printed, stage)[column]) < 0.5 * filtered for stage in stages)
