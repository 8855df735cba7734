"""The joystick in real time: driven by a script, and by keys where pygame is installed."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pytest

from tests.scenarios.scripts import load


def test_a_scripted_hand(fmus_by_name: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Two seconds by the clock; the torque moves the handle to either side."""
    scenario = load("drive_joystick")
    begin = time.perf_counter()
    assert scenario.main(tmp_path, ["--headless"]) == 0
    assert time.perf_counter() - begin > 1.9
    printed = capsys.readouterr().out
    assert "2.00 s; the handle went from -" in printed
    assert sorted(path.name for path in tmp_path.iterdir()) == ["motion.pdf", "motion.png", "summary.md"]


def test_keys_push_save_and_restore(fmus_by_name: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pygame", reason="needs pygame")
    monkeypatch.setenv("SDL_VIDEODRIVER", "dummy")
    monkeypatch.setenv("SDL_AUDIODRIVER", "dummy")
    scenario = load("drive_joystick")
    player = scenario.Player()
    keys = player.pygame
    #: What is pressed or let go before each frame.
    presses: list[list[tuple[int, int]]] = [
        [(keys.KEYDOWN, keys.K_RIGHT)],
        [],
        [(keys.KEYDOWN, keys.K_s), (keys.KEYUP, keys.K_RIGHT), (keys.KEYDOWN, keys.K_LEFT)],
        [],
        [(keys.KEYDOWN, keys.K_r), (keys.KEYUP, keys.K_LEFT)],
        [(keys.KEYDOWN, keys.K_ESCAPE)],
    ]

    class Presser:
        def look(self, joystick: Any) -> float | None:
            for kind, key in presses.pop(0):
                keys.event.post(keys.event.Event(kind, key=key))
            torque: float | None = player.look(joystick)
            return torque

    rows, late = scenario.drive(Presser())
    assert len(late) == 5
    torques = [row[1] for row in rows]
    assert torques == [1.5] * 34 + [0.0] * 17  # what was taken back is gone
    before, after = rows[33], rows[34]
    assert after[0] == pytest.approx(before[0] + 1e-3)
    assert after[2] > before[2]
    assert presses == []
