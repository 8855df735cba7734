"""A drawing in the plane, written as SVG: y points upwards, lengths are in pixels, the ground is white."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from html import escape
from typing import Final, Literal, NamedTuple

from pyjoystick.support import BLACK

GRAY: Final = "#767676"
LIGHT: Final = "#e8e8e8"
_SIZE: Final = 17.0
_HEAD: Final = 9.0
_SUBSCRIPT: Final = re.compile(r"_(\{[^}]*\}|\w)")


class Point(NamedTuple):
    """A point or a vector."""

    x: float
    y: float

    def moved(self, along: Point, by: float = 1.0) -> Point:
        """The point `by` times the vector away."""
        return Point(self.x + by * along.x, self.y + by * along.y)

    def to(self, other: Point) -> Point:
        """The vector to another point."""
        return Point(other.x - self.x, other.y - self.y)

    def unit(self) -> Point:
        """The vector at length 1."""
        length = math.hypot(self.x, self.y)
        return Point(self.x / length, self.y / length)

    def left(self) -> Point:
        """The vector turned by a right angle, counterclockwise."""
        return Point(-self.y, self.x)


def polar(angle: float, length: float = 1.0) -> Point:
    """The vector of an angle (deg), counterclockwise from the right."""
    return Point(length * math.cos(math.radians(angle)), length * math.sin(math.radians(angle)))


class Drawing:
    """Shapes in the order in which they cover one another."""

    def __init__(self, width: float, height: float, title: str) -> None:
        self.width, self.height = width, height
        self._title = title
        self._shapes: list[str] = []

    def line(
        self, *points: Point, color: str = BLACK, width: float = 1.5, dashes: str = "", fill: str = "none"
    ) -> None:
        """Straight pieces from point to point; with `fill` a closed polygon."""
        kind = "polyline" if fill == "none" else "polygon"
        path = " ".join(f"{_number(p.x)},{_number(self.height - p.y)}" for p in points)
        dashed = f' stroke-dasharray="{dashes}"' if dashes else ""
        self._shapes.append(
            f'<{kind} points="{path}" fill="{fill}" stroke="{color}" stroke-width="{_number(width)}"'
            f'{dashed} stroke-linejoin="round" stroke-linecap="round"/>'
        )

    def circle(
        self, center: Point, radius: float, *, fill: str = "white", color: str = BLACK, width: float = 1.5
    ) -> None:
        """A filled circle."""
        self._shapes.append(
            f'<circle cx="{_number(center.x)}" cy="{_number(self.height - center.y)}" r="{_number(radius)}"'
            f' fill="{fill}" stroke="{color}" stroke-width="{_number(width)}"/>'
        )

    def arc(self, center: Point, radius: float, start: float, end: float, **style: str | float) -> None:
        """An arc from one angle (deg) to another, straight every 3 degrees."""
        count = max(2, math.ceil(abs(end - start) / 3.0) + 1)
        angles = [start + (end - start) * i / (count - 1) for i in range(count)]
        self.line(*(center.moved(polar(angle, radius)) for angle in angles), **style)  # type: ignore[arg-type]

    def arrow(self, start: Point, end: Point, *, color: str = BLACK, width: float = 2.0) -> None:
        """An arrow with its point at `end`."""
        along = start.to(end).unit()
        self.line(start, end.moved(along, -0.8 * _HEAD), color=color, width=width)
        self._head(end, along, color)

    def arc_arrow(self, center: Point, radius: float, start: float, end: float, *, color: str) -> None:
        """An arc (deg) with an arrow's point at its end."""
        self.arc(center, radius, start, end, color=color, width=2.0)
        # The point follows the chord of the last few pixels, which looks straighter than the tangent.
        back = math.copysign(math.degrees(_HEAD / radius) / 2.0, end - start)
        along = center.moved(polar(end - back, radius)).to(center.moved(polar(end + back, radius))).unit()
        self._head(center.moved(polar(end, radius)).moved(along, 0.8 * _HEAD), along, color)

    def dimension(self, start: Point, end: Point, label: str, *, side: Point | None = None) -> None:
        """A length with arrows at both ends, its label in the middle, on the side of the vector `side`."""
        along = start.to(end).unit()
        away = side or along.left()
        self.line(start.moved(along, 6.0), end.moved(along, -6.0), color=GRAY, width=1.0)
        for tip, direction in ((start, Point(-along.x, -along.y)), (end, along)):
            self._head(tip, direction, GRAY, 7.0)
        middle = Point((start.x + end.x) / 2.0, (start.y + end.y) / 2.0)
        self.text(middle.moved(away, 13.0), label)

    def guide(self, *points: Point) -> None:
        """A thin dashed line that leads to a dimension or marks an axis."""
        self.line(*points, color=GRAY, width=0.8, dashes="5 4")

    def text(
        self,
        at: Point,
        label: str,
        *,
        color: str = BLACK,
        anchor: Literal["start", "middle", "end"] = "middle",
        italic: bool = True,
        size: float = _SIZE,
    ) -> None:
        """A label with its middle at the height of a point; ``k_s`` and ``F_{0,ret}`` have subscripts."""
        label = label.replace(" - ", " \N{MINUS SIGN} ")
        spans, lowered = [], False
        for i, part in enumerate(_SUBSCRIPT.split(label)):
            if part:
                shift = (0.28 if i % 2 else 0.0) - (0.28 if lowered else 0.0)
                lowered = bool(i % 2)
                small = f' font-size="{_number(0.72 * size)}"' if lowered else ""
                offset = f' dy="{_number(shift * size)}"' if shift else ""
                spans.append(f"<tspan{offset}{small}>{escape(part.strip('{}'))}</tspan>")
        style = ' font-style="italic"' if italic else ""
        family = "serif" if italic else "sans-serif"
        self._shapes.append(
            f'<text x="{_number(at.x)}" y="{_number(self.height - at.y + 0.32 * size)}" fill="{color}"'
            f' font-family="{family}" font-size="{_number(size)}"{style} text-anchor="{anchor}">'
            f"{''.join(spans)}</text>"
        )

    def note(self, at: Point, words: str, **style: str | float) -> None:
        """Words in upright letters."""
        self.text(at, words, italic=False, size=14.0, **style)  # type: ignore[arg-type]

    def hatch(self, start: Point, end: Point) -> None:
        """The line of something that does not move, hatched on its right-hand side."""
        self.line(start, end, width=2.0)
        along = start.to(end)
        length = math.hypot(along.x, along.y)
        unit = along.unit()
        inward = Point(unit.y, -unit.x)
        for i in range(int(length // 8.0)):
            foot = start.moved(unit, 8.0 * (i + 1))
            self.line(foot, foot.moved(unit, -8.0).moved(inward, 8.0), width=0.8)

    def svg(self) -> str:
        """The file."""
        size = f"{_number(self.width)} {_number(self.height)}"
        shapes = "\n".join(self._shapes)
        return (
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size}" width="{_number(self.width)}"'
            f' height="{_number(self.height)}" role="img">\n<title>{escape(self._title)}</title>\n'
            f'<rect width="100%" height="100%" fill="white"/>\n{shapes}\n</svg>\n'
        )

    def _head(self, tip: Point, along: Point, color: str, length: float = _HEAD) -> None:
        back = tip.moved(along, -length)
        side = along.left()
        self.line(
            tip,
            back.moved(side, 0.35 * length),
            back.moved(side, -0.35 * length),
            color=color,
            width=0.5,
            fill=color,
        )


def zigzag(start: Point, end: Point, coils: int, radius: float) -> Sequence[Point]:
    """The points of a spring with straight ends."""
    along, side = start.to(end), start.to(end).unit().left()
    ends = 0.08
    middle = [
        start.moved(along, ends + (1.0 - 2.0 * ends) * (i + 0.5) / (2 * coils)).moved(
            side, radius if i % 2 else -radius
        )
        for i in range(2 * coils)
    ]
    return [start, start.moved(along, ends), *middle, start.moved(along, 1.0 - ends), end]


def _number(value: float) -> str:
    return f"{value:.1f}".rstrip("0").rstrip(".") if abs(value) >= 0.05 else "0"
