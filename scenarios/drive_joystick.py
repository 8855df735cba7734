"""Drive the joystick in real time by the arrow keys, a game controller or a script.

With pygame (pip install 'pyjoystick[game]'), a window shows the handle and the torque. The left and right
arrow keys push with 1.5 N m, a controller's first axis with up to 2.5; S saves the state, R restores it, Esc
ends. --headless needs neither pygame nor a screen: a scripted hand pushes for two seconds. The motion and the
lateness of the frames are written to results/drive_joystick/.
"""

import argparse
import math
import os
import sys
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from pyjoystick import Fmu, plot_motion, save_results
from pyjoystick.fmu import SavedState, Stepper, paced
from pyjoystick.motion import Quantity, make_table

STEP = 1e-3  # s
FRAME = 1.0 / 60.0  # s, between two readings of the hand
PUSH, FULL_AXIS = 1.5, 2.5  # N m
STOP = math.radians(20.0)
RESULTS = Path(__file__).parents[1] / "results" / "drive_joystick"


class Hand(Protocol):
    """What pushes the joystick."""

    def look(self, joystick: Stepper) -> float | None:
        """Return the torque of the next frame (N m); None ends the drive. A window shows the joystick."""


class Script:
    """Pushes forward, lets go, pushes backward, lets go."""

    def look(self, joystick: Stepper) -> float | None:
        """See `Hand`."""
        if joystick.time >= 2.0 - FRAME / 2.0:
            return None
        return {0: PUSH, 2: -PUSH}.get(int(2.0 * joystick.time), 0.0)


class Player:
    """A person at the keyboard or a game controller, and a window."""

    def __init__(self) -> None:
        os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
        import pygame

        self.pygame: Any = pygame
        pygame.display.init()  # without sound
        pygame.joystick.init()
        self.screen = pygame.display.set_mode((480, 360))
        pygame.display.set_caption("Joystick: arrow keys or controller, S save, R restore, Esc end")
        found = [pygame.joystick.Joystick(i) for i in range(pygame.joystick.get_count())]
        self.controller = found[0] if found else None
        self.saved: SavedState | None = None
        self.side = 0

    def look(self, joystick: Stepper) -> float | None:
        """See `Hand`."""
        for event in self.pygame.event.get():
            is_key = event.type == self.pygame.KEYDOWN
            if event.type == self.pygame.QUIT or (is_key and event.key == self.pygame.K_ESCAPE):
                self.pygame.quit()
                return None
            if is_key and event.key == self.pygame.K_s:
                self.saved = joystick.save()
            if is_key and event.key == self.pygame.K_r and self.saved is not None:
                joystick.restore(self.saved)
            if event.type in (self.pygame.KEYDOWN, self.pygame.KEYUP):
                self.side += self._side(event.key) * (1 if is_key else -1)
        torque = PUSH * self.side
        if self.controller is not None and not self.side:
            torque = FULL_AXIS * float(self.controller.get_axis(0))
        self._draw(float(joystick.outputs["theta"]), torque)
        return torque

    def _side(self, key: int) -> int:
        return {self.pygame.K_RIGHT: 1, self.pygame.K_LEFT: -1}.get(key, 0)

    def _draw(self, theta: float, torque: float) -> None:
        pivot, length = (240, 300), 220.0
        self.screen.fill((250, 250, 250))
        for angle, color, width in (
            (-STOP, (200,) * 3, 1),
            (STOP, (200,) * 3, 1),
            (theta, (0, 114, 178), 10),
        ):
            end = pivot[0] + length * math.sin(angle), pivot[1] - length * math.cos(angle)
            self.pygame.draw.line(self.screen, color, pivot, end, width)
        self.pygame.draw.line(self.screen, (213, 94, 0), (240, 330), (240 + 40.0 * torque, 330), 8)
        self.pygame.display.flip()


def drive(hand: Hand) -> tuple[list[list[float]], list[float]]:
    """Step the joystick in real time until the hand ends the drive.

    Returns:
        time, torque, theta, omega and alpha of every step that was not reverted; lateness of every frame (s)
    """
    rows, late = [], []
    with Fmu("Joystick") as fmu, fmu.start() as joystick:
        for lateness in paced(FRAME):
            torque = hand.look(joystick)
            if torque is None:
                break
            late.append(lateness)
            while rows and rows[-1][0] > joystick.time + STEP / 2.0:  # the hand restored a saved state
                rows.pop()
            end = joystick.time + FRAME
            while joystick.time < end - STEP / 2.0:
                length = min(STEP, end - joystick.time)
                motion = joystick.step(length, T=torque)
                values = (float(motion[name]) for name in ("theta", "omega", "alpha"))
                rows.append([joystick.time, torque, *values])
    return rows, late


def main(results: Path = RESULTS, arguments: list[str] | None = None) -> int:
    """Run the scenario."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--headless", action="store_true", help="a scripted hand, without a window")
    given = parser.parse_args(arguments)
    try:
        hand: Hand = Script() if given.headless else Player()
    except ImportError:
        parser.error("the window needs pygame: pip install 'pyjoystick[game]'; --headless does without")
    rows, late = drive(hand)
    if not rows:
        print("ended before the first step")
        return 0
    time, torque, *motion = np.array(rows).T
    units = {"theta": "rad", "omega": "rad/s", "alpha": "rad/s2"}
    columns = {**dict(zip(units, motion, strict=True)), "T": torque}
    run = make_table(time, columns, [Quantity(name, unit) for name, unit in (units | {"T": "N.m"}).items()])
    worst, usual = 1e3 * max(late), 1e3 * float(np.median(late))
    low, high = (math.degrees(end) for end in (run["theta"].min(), run["theta"].max()))
    summary = (
        f"## The driven joystick\n\n{len(rows)} steps in {time[-1]:.2f} s; the handle went from {low:+.1f} "
        f"to {high:+.1f} degrees. Frames began {usual:.2f} ms late (median), {worst:.1f} ms at most."
    )
    save_results(results, summary, {"motion": plot_motion(run)})
    return 0


if __name__ == "__main__":
    sys.exit(main())
