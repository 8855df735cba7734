"""The released joystick in motion: mechanism, restoring moment of the springs, and angle over time."""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from figures.animation import Animation
from figures.axes import Axes
from figures.svg import GRAY, LIGHT, Point, zigzag
from pyjoystick.model import NOMINAL, STOP_ANGLE, ActuatorAssembly, contact_moment, contact_travel, simulate
from pyjoystick.support import BLACK, BLUE, GREEN, VERMILION, FloatArray

#: Of the motion (s), and how many times slower it is shown.
_END: Final = 1.2
_SLOWER: Final = 8.0
#: Seconds in which it is held, moves, rests and is led back.
_HELD, _RUN, _REST, _BACK = 0.8, _SLOWER * _END, 0.4, 1.0
DURATION: Final = _HELD + _RUN + _REST + _BACK
#: Of the motion (s): with straight pieces between them the angle is off by less than the eye sees.
_STEP: Final = 1e-3
#: Pixels of a meter.
_SCALE: Final = 4_600.0
_PIVOT: Final = Point(195.0, 440.0)
_FINGER, _SPRING, _PLATE = 52.0, 78.0, 5.0
_CONTACT: Final = _PIVOT.y + _SCALE * NOMINAL.b
#: Lower edge of a plunger's crossbar at rest.
_BAR: Final = _CONTACT - 36.0
#: From a plunger's middle to its fingers.
_REACH: Final = 24.0


def draw() -> Animation:
    """Released at -20 degrees: the smaller the swing, the steeper its secant and the shorter its period."""
    drawing = Animation(800.0, 660.0, "A joystick after its release, eight times slower", duration=DURATION)
    times, angles, peaks = _motion()
    _mechanism(drawing, times, angles)
    _moment(drawing, times, angles, peaks)
    _angle(drawing, angles)
    return drawing


def _motion() -> tuple[FloatArray, FloatArray, FloatArray]:
    """Instants (s) of the picture, angles (rad) there, and the amplitude (rad) of the swing under way."""
    time = np.linspace(0.0, _END, round(_END / _STEP) + 1)
    motion = simulate(NOMINAL, time=time, theta_start=-STOP_ANGLE)
    turns = [(0.0, STOP_ANGLE), *((turn.time, abs(turn.theta)) for turn in motion.turning_points)]
    peaks = np.interp(time, [at for at, _ in turns], [peak for _, peak in turns])
    part = np.linspace(0.0, 1.0, 101)
    smooth = part * part * (3.0 - 2.0 * part)
    rest = motion.theta[-1]
    return (
        np.concatenate([[0.0], _HELD + _SLOWER * time, DURATION - _BACK + _BACK * part]),
        np.concatenate([motion.theta[:1], motion.theta, rest + smooth * (-STOP_ANGLE - rest)]),
        np.concatenate([peaks[:1], peaks, peaks[-1] + smooth * (STOP_ANGLE - peaks[-1])]),
    )


def _mechanism(drawing: Animation, times: FloatArray, angles: FloatArray) -> None:
    a = _SCALE * NOMINAL.a
    for name, side, assembly in (("backward", -1.0, NOMINAL.backward), ("forward", 1.0, NOMINAL.forward)):
        tip = Point(_PIVOT.x + side * a, _CONTACT)
        travels = np.where(side * angles > 0.0, contact_travel(NOMINAL, angles), 0.0)
        _springs(drawing, name, tip.x, side * _REACH, assembly, times, travels)
        with drawing.group(name):
            _plunger(drawing, tip)
        drawing.move(name, times, [Point(0.0, -_SCALE * float(travel)) for travel in travels])
        drawing.note(Point(tip.x, 258.0), name, color=GRAY)
    with drawing.group("handle"):
        _handle(drawing, a)
    drawing.turn("handle", times, -np.degrees(angles), _PIVOT)
    drawing.circle(_PIVOT, 6.0)
    drawing.note(Point(_PIVOT.x, 345.0), "released", color=GREEN)
    drawing.note(Point(_PIVOT.x, 315.0), "restrained", color=GRAY)


def _springs(
    drawing: Animation,
    side: str,
    middle: float,
    reach: float,
    assembly: ActuatorAssembly,
    times: FloatArray,
    travels: FloatArray,
) -> None:
    """The return spring outside, the balance spring inside; the plate of one leaves the lips at a kink."""
    springs = (
        ("return", reach, assembly.return_spring.x_0, assembly.kinks[1]),
        ("balance", -reach, assembly.balance_spring.x_0, assembly.kinks[3]),
    )
    for kind, offset, clearance, kink in springs:
        name = f"{side}-{kind}"
        pressed = _SCALE * np.maximum(travels - clearance, 0.0)
        x, rest = middle + offset, _BAR - _FINGER - _SCALE * clearance
        foot = rest - _SPRING
        with drawing.group(name):
            with drawing.group(f"{name}-coil"):
                drawing.line(*zigzag(Point(x, rest - _PLATE), Point(x, foot), 6, 13.0), width=1.8)
            with drawing.group(f"{name}-plate"):
                corners = ((-16.0, 0.0), (16.0, 0.0), (16.0, -_PLATE), (-16.0, -_PLATE))
                drawing.line(*(Point(x + dx, rest + dy) for dx, dy in corners), fill=BLACK)
        length = _SPRING - _PLATE
        drawing.compress(f"{name}-coil", times, (length - pressed) / length, Point(x, foot))
        drawing.move(f"{name}-plate", times, [Point(0.0, -float(way)) for way in pressed])
        released = travels > kink
        changes = [0, *(np.flatnonzero(np.diff(released)) + 1)]
        colors = [GREEN if released[i] else GRAY for i in changes]
        drawing.color(name, [float(times[i]) for i in changes], colors)
        for way in (-1.0, 1.0):
            lip = (Point(x + way * 10.0, rest), Point(x + way * 20.0, rest), Point(x + way * 20.0, foot))
            drawing.line(*lip, color=BLUE, width=2.0)
        drawing.line(Point(x - 22.0, foot), Point(x + 22.0, foot), color=BLUE, width=2.0)


def _plunger(drawing: Animation, tip: Point) -> None:
    for x in (tip.x - _REACH, tip.x + _REACH):
        finger = ((-6.0, _BAR), (-6.0, _BAR - _FINGER), (6.0, _BAR - _FINGER), (6.0, _BAR))
        drawing.line(*(Point(x + dx, y) for dx, y in finger), fill=LIGHT)
    bar = ((-32.0, _BAR), (32.0, _BAR), (32.0, _BAR + 9.0), (-32.0, _BAR + 9.0))
    drawing.line(*(Point(tip.x + dx, y) for dx, y in bar), fill=LIGHT)
    top = tip.y - 8.0
    rod = ((-7.0, _BAR + 9.0), (-7.0, top), (0.0, tip.y), (7.0, top), (7.0, _BAR + 9.0))
    drawing.line(*(Point(tip.x + dx, y) for dx, y in rod), fill=LIGHT)


def _handle(drawing: Animation, a: float) -> None:
    """Upright: the plate that rests on both plungers, and the stem."""
    x, y = _PIVOT.x, _CONTACT + 14.0
    stem = ((-10.0, y), (-10.0, y + 70.0), (-17.0, y + 88.0), (-17.0, y + 150.0), (-9.0, y + 160.0))
    outline = [*stem, *((-dx, at) for dx, at in reversed(stem))]
    drawing.line(*(Point(x + dx, at) for dx, at in outline), fill=LIGHT)
    reach = a + 34.0
    plate = ((-reach, _CONTACT), (reach, _CONTACT), (reach, y), (-reach, y))
    drawing.line(*(Point(x + dx, at) for dx, at in plate), fill=LIGHT)


def _moment(drawing: Animation, times: FloatArray, angles: FloatArray, peaks: FloatArray) -> None:
    """The springs' moment over the angle, and the straight line from turning point to turning point."""
    axes = Axes(drawing, Point(466.0, 300.0), 310.0, 290.0, (-21.0, 21.0), (-2.8, 2.8))
    axes.frame("θ (deg)", "moment of the springs (N·m)", ("-20", "-10", "0", "10", "20"), ("-2", "0", "2"))
    degrees = np.unique(np.concatenate([np.linspace(-21.0, 21.0, 43), np.linspace(-0.6, 0.6, 25)]))
    axes.curve(degrees.tolist(), contact_moment(NOMINAL, np.radians(degrees)).tolist(), BLACK)
    middle = axes.at(0.0, 0.0)
    ends = (axes.corner, axes.corner.moved(Point(axes.width, axes.height)))
    with drawing.within(*ends), drawing.group("secant"):
        far = Point(300.0, 0.0)
        drawing.line(middle.moved(far, -1.0), middle.moved(far), color=VERMILION, dashes="7 4", width=2.0)
    mean = 0.5 * (contact_moment(NOMINAL, peaks) - contact_moment(NOMINAL, -peaks))
    slopes = [
        math.atan2(*reversed(middle.to(axes.at(*pair)))) for pair in zip(np.degrees(peaks), mean, strict=True)
    ]
    drawing.turn("secant", times, np.degrees(slopes), middle)
    drawing.note(axes.at(20.5, -2.3), "secant", color=VERMILION, anchor="end")
    moments = contact_moment(NOMINAL, angles)
    _dot(drawing, "state", times, [axes.at(*pair) for pair in zip(np.degrees(angles), moments, strict=True)])


def _angle(drawing: Animation, angles: FloatArray) -> None:
    """The angle over time; what is still to come is pale."""
    axes = Axes(drawing, Point(52.0, 54.0), 724.0, 140.0, (0.0, _END), (-20.0, 20.0))
    ticks = ("0", "0.2", "0.4", "0.6", "0.8", "1.0", "1.2")
    axes.frame("time (s)", "θ (deg), eight times slower", ticks, ("-20", "0", "20"))
    count = round(_END / _STEP) + 1
    time, degrees = np.linspace(0.0, _END, count), np.degrees(angles[1 : count + 1])
    axes.curve(time[::3].tolist(), degrees[::3].tolist(), BLUE)
    low, high = axes.at(0.004, -20.0).moved(Point(0.0, 1.0)), axes.at(_END, 20.0)
    across = Point(high.x - low.x, 0.0)
    gone = DURATION - _BACK
    beyond = high.moved(Point(4.0, 2.0))
    with drawing.within(low, beyond), drawing.group("pale"), drawing.group("veil"):
        corners = (low, Point(high.x, low.y), high, Point(low.x, high.y))
        drawing.line(*corners, fill="white", color="white")
    drawing.show("pale", [0.0, DURATION], [0.85, 0.85])
    times = np.array([0.0, _HELD, _HELD + _RUN, gone + 0.2, gone + 0.21, DURATION])
    nowhere = Point(0.0, 0.0)
    drawing.move("veil", times, [nowhere, nowhere, across, across, nowhere, nowhere], still=across)
    shown = [axes.at(*pair) for pair in zip(time, degrees, strict=True)]
    at = np.concatenate([[0.0], _HELD + _SLOWER * time, times[-3:]])
    with drawing.group("now"):
        _dot(drawing, "instant", at, [shown[0], *shown, shown[-1], shown[0], shown[0]])
    drawing.show("now", [0.0, gone, gone + 0.2, DURATION - 0.2, DURATION], [1.0, 1.0, 0.0, 0.0, 1.0])


def _dot(drawing: Animation, name: str, times: FloatArray, places: list[Point]) -> None:
    start = places[0]
    with drawing.group(name):
        drawing.circle(start, 6.0, fill=VERMILION, color="white")
    drawing.move(name, times, [start.to(place) for place in places])
