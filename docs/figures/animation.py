"""A drawing in which groups move, as SVG with CSS animations: GitHub and every browser show them in images.

Whoever prefers reduced motion sees it at rest. On a dark page the colors are others.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import Final

import numpy as np

from figures.svg import GRAY, LIGHT, Drawing, Point
from pyjoystick.support import BLACK, BLUE, GREEN, VERMILION, FloatArray

#: Names of the colors that shapes are drawn in, each with what it is on a dark page.
_COLORS: Final = {
    BLACK: ("ink", "#e8eaed"),
    GRAY: ("gray", "#9aa4b0"),
    LIGHT: ("light", "#39424d"),
    BLUE: ("blue", "#56b4e9"),
    GREEN: ("green", "#3ecf9f"),
    VERMILION: ("vermilion", "#ff9249"),
    "white": ("ground", "#1d2127"),
}
#: Where the image is narrower (px), letters are larger, so that they can be read on a telephone.
_NARROW: Final = 520
_LARGE: Final = 20


class Animation(Drawing):
    """A drawing that repeats itself after some seconds."""

    def __init__(self, width: float, height: float, title: str, *, duration: float) -> None:
        super().__init__(width, height, title)
        self._duration = duration
        self._rules: list[str] = []
        self._moves: list[str] = []

    @contextmanager
    def group(self, name: str) -> Iterator[None]:
        """Have what is drawn inside move together, as `move`, `turn` and so on say of the name."""
        self._shapes.append(f'<g class="{name}">')
        yield
        self._shapes.append("</g>")

    @contextmanager
    def within(self, low: Point, high: Point) -> Iterator[None]:
        """Cut off what is drawn inside at the edges of a rectangle between two corners."""
        name = f"cut{len(self._shapes)}"
        self._shapes.append(
            f'<clipPath id="{name}"><rect x="{_short(low.x)}" y="{_short(self.height - high.y)}"'
            f' width="{_short(high.x - low.x)}" height="{_short(high.y - low.y)}"/></clipPath>'
            f'<g clip-path="url(#{name})">'
        )
        yield
        self._shapes.append("</g>")

    def move(
        self, name: str, times: FloatArray, places: Sequence[Point], *, still: Point | None = None
    ) -> None:
        """Move a group by vectors (px), given for instants (s); at rest by `still`, or the first one."""

        def transform(place: FloatArray) -> str:
            return f"translate({_px(place[0])},{_px(place[1])})"

        values = np.array([(place.x, -place.y) for place in places])
        self._animate(name, "transform", times, values, 0.15, transform)
        if still:
            self._rules.append(f".{name}{{transform:{transform(np.array([still.x, -still.y]))}}}")

    def turn(self, name: str, times: FloatArray, angles: FloatArray, center: Point) -> None:
        """Turn a group about a point by angles (deg), counterclockwise."""
        self._animate(
            name, "transform", times, -angles[:, None], 0.05, lambda v: f"rotate({_short(v[0])}deg)", center
        )

    def compress(self, name: str, times: FloatArray, factors: FloatArray, foot: Point) -> None:
        """Compress a group towards the height of a point by factors."""
        values = factors[:, None]
        self._animate(name, "transform", times, values, 0.002, lambda v: f"scaleY({_short(v[0], 3)})", foot)

    def show(self, name: str, times: Sequence[float], shown: Sequence[float]) -> None:
        """Show a group at opacities from 0 to 1."""
        values = np.array(shown, dtype=float)[:, None]
        self._animate(name, "opacity", np.array(times), values, 1e-6, lambda v: _short(v[0]))

    def color(self, name: str, times: Sequence[float], colors: Sequence[str]) -> None:
        """Draw what is black in a group in these colors, each from its instant (s) on."""
        names = [f"color:var(--{_COLORS[one][0]})" for one in colors]
        self._rules.append(f".{name}{{{names[0]}}}")
        self._rules.append(f".{name} *{{stroke:currentColor}}.{name} [fill='{BLACK}']{{fill:currentColor}}")
        self._keyframes(name, times, names, "step-end")

    def svg(self) -> str:
        """The file."""
        head, ground, body = super().svg().partition('<rect width="100%" height="100%" fill="white"/>')
        # Variables in place of the colors, so that a dark page can have others.
        for color, (name, _) in _COLORS.items():
            body = body.replace(f'fill="{color}"', f'fill="var(--{name})"')
            body = body.replace(f'stroke="{color}"', f'stroke="var(--{name})"')
        ground = ground.replace("white", "var(--ground)")
        light = ";".join(f"--{name}:{color}" for color, (name, _) in _COLORS.items())
        dark = ";".join(f"--{name}:{color}" for name, color in _COLORS.values())
        still = "\n".join(self._rules).replace(f"[fill='{BLACK}']", "[fill='var(--ink)']")
        moving = "\n".join(self._moves)
        return (
            f"{head}<style>\n:root{{{light}}}\n@media (prefers-color-scheme:dark){{:root{{{dark}}}}}\n"
            f"@media (max-width:{_NARROW}px){{text{{font-size:{_LARGE}px}}}}\n{still}\n"
            f"@media (prefers-reduced-motion:no-preference){{\n{moving}\n}}\n</style>\n{ground}{body}"
        )

    def _animate(
        self,
        name: str,
        key: str,
        times: FloatArray,
        values: FloatArray,
        tolerance: float,
        text: Callable[[FloatArray], str],
        origin: Point | None = None,
    ) -> None:
        """Animate a property by the fewest keyframes that stay within a tolerance of the values."""
        kept = _corners(times, values, tolerance)
        words = [f"{key}:{text(values[i])}" for i in kept]
        about = f"transform-origin:{_px(origin.x)} {_px(self.height - origin.y)};" if origin else ""
        self._rules.append(f".{name}{{{about}{words[0]}}}")
        self._keyframes(name, [float(times[i]) for i in kept], words, "linear")

    def _keyframes(self, name: str, times: Sequence[float], words: Sequence[str], pace: str) -> None:
        frames = "".join(
            f"{_short(100.0 * time / self._duration, 3)}%{{{word}}}"
            for time, word in zip(times, words, strict=True)
        )
        self._moves.append(f"@keyframes {name}-{pace}{{{frames}}}")
        self._moves.append(f".{name}{{animation:{name}-{pace} {_short(self._duration)}s {pace} infinite}}")


def _corners(times: FloatArray, values: FloatArray, tolerance: float) -> list[int]:
    """The points of a path that straight pieces between them stay close to (Douglas and Peucker)."""
    kept, pieces = {0, len(times) - 1}, [(0, len(times) - 1)]
    while pieces:
        first, last = pieces.pop()
        if last - first < 2:
            continue
        part = (times[first : last + 1] - times[first]) / (times[last] - times[first])
        line = values[first] + part[:, None] * (values[last] - values[first])
        away = np.abs(values[first : last + 1] - line).max(axis=1)
        worst = first + int(away.argmax())
        if away[worst - first] > tolerance:
            kept.add(worst)
            pieces += [(first, worst), (worst, last)]
    return sorted(kept)


def _px(value: float) -> str:
    return f"{_short(value)}px"


def _short(value: float, digits: int = 2) -> str:
    text = f"{value:.{digits}f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text
