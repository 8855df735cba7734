"""Axes of a diagram within a drawing."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from figures.svg import GRAY, LIGHT, Drawing, Point


@dataclass(frozen=True)
class Axes:
    """A rectangle of a drawing with scales.

    Attributes:
        drawing: what it is drawn into
        corner: the lower left corner (px)
        width, height: its size (px)
        x_range, y_range: the values at its edges
    """

    drawing: Drawing
    corner: Point
    width: float
    height: float
    x_range: tuple[float, float]
    y_range: tuple[float, float]

    def at(self, x: float, y: float) -> Point:
        """Where a pair of values is in the drawing."""
        across = (x - self.x_range[0]) / (self.x_range[1] - self.x_range[0])
        along = (y - self.y_range[0]) / (self.y_range[1] - self.y_range[0])
        return self.corner.moved(Point(across * self.width, along * self.height))

    def frame(self, x_label: str, y_label: str, x_ticks: Sequence[str], y_ticks: Sequence[str]) -> None:
        """Grid, axes, the values at the ticks, and labels at the ends of the axes."""
        low_x, low_y = self.x_range[0], self.y_range[0]
        for tick in x_ticks:
            foot = self.at(float(tick), low_y)
            self.drawing.line(foot, self.at(float(tick), self.y_range[1]), color=LIGHT, width=1.0)
            self.drawing.note(foot.moved(Point(0.0, -13.0)), _minus(tick))
        for tick in y_ticks:
            foot = self.at(low_x, float(tick))
            self.drawing.line(foot, self.at(self.x_range[1], float(tick)), color=LIGHT, width=1.0)
            self.drawing.note(foot.moved(Point(-7.0, 0.0)), _minus(tick), anchor="end")
        self.drawing.line(
            self.at(low_x, self.y_range[1]),
            self.at(low_x, low_y),
            self.at(self.x_range[1], low_y),
            color=GRAY,
            width=1.2,
        )
        self.drawing.note(self.at(self.x_range[1], low_y).moved(Point(0.0, -34.0)), x_label, anchor="end")
        self.drawing.note(self.at(low_x, self.y_range[1]).moved(Point(-20.0, 18.0)), y_label, anchor="start")

    def curve(self, xs: Sequence[float], ys: Sequence[float], color: str, dashes: str = "") -> None:
        """Straight pieces through pairs of values."""
        points = (self.at(x, y) for x, y in zip(xs, ys, strict=True))
        self.drawing.line(*points, color=color, width=2.0, dashes=dashes)


def _minus(tick: str) -> str:
    return tick.replace("-", "\N{MINUS SIGN}")
