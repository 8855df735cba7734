"""MSL tables, in a small library of the same structure, against SciPy and NumPy."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from pathlib import Path

import fmpy
import numpy as np
import pandas as pd
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import (
    Akima1DInterpolator,
    CubicHermiteSpline,
    PchipInterpolator,
    RegularGridInterpolator,
)

from fmu_build import UnsupportedModelError, build_fmu
from fmu_build.codegen.modelica_source.tables import with_own_tables
from pyjoystick.fmu import Fmu, FmuRunError
from pyjoystick.support import FloatArray

_HERE = Path(__file__).with_name("tables")
_MODELS, _LIBRARY = _HERE / "Tables.mo", _HERE / "library" / "Modelica.mo"
LINEAR, AKIMA, CONSTANT, FRITSCH_BUTLAND, STEFFEN, MODIFIED_AKIMA = range(1, 7)
HOLD, LAST_TWO, PERIODIC = range(1, 4)
ALWAYS, AT_JUMPS, NEVER = range(1, 4)
Curve = Callable[[FloatArray], FloatArray]


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Return the FMU of a model."""
    folder = tmp_path_factory.mktemp("tables")
    done: dict[str, Path] = {}

    def fmu(model: str) -> Path:
        if model not in done:
            done[model] = build_fmu(f"Tables.{model}", folder, library=[_MODELS, _LIBRARY]).path
        return done[model]

    return fmu


def _slopes(x: FloatArray, y: FloatArray, smoothness: int) -> FloatArray:
    """Derivatives at the points: SciPy's, or Steffen's formula (Astron. Astrophys. 239, 1990, eq. 11)."""
    if smoothness in (AKIMA, MODIFIED_AKIMA):
        curve = Akima1DInterpolator(x, y, method="akima" if smoothness == AKIMA else "makima")
        return np.asarray(curve.derivative()(x))
    h, s = np.diff(x), np.diff(y) / np.diff(x)
    if smoothness == FRITSCH_BUTLAND:
        inner = PchipInterpolator(x, y).derivative()(x)[1:-1]
    else:
        p = (s[:-1] * h[1:] + s[1:] * h[:-1]) / (h[:-1] + h[1:])
        least = np.minimum(np.minimum(np.abs(s[:-1]), np.abs(s[1:])), np.abs(p) / 2)
        inner = (np.sign(s[:-1]) + np.sign(s[1:])) * least
    return np.concatenate([s[:1], inner, s[-1:]])


def _curve(x: FloatArray, y: FloatArray, smoothness: int, extrapolation: int) -> Curve:
    def piece(u: FloatArray) -> FloatArray:
        k = np.clip(np.searchsorted(x, u, side="right") - 1, 0, len(x) - 2)
        outside = (u < x[0]) | (u > x[-1])
        if smoothness == CONSTANT:
            here = np.where(u == x[-1], y[-1], y[k])
        elif smoothness != LINEAR:
            slopes = _slopes(x, y, smoothness)
            smooth = CubicHermiteSpline(x, y, slopes)(np.clip(u, x[0], x[-1]))
            ends = slopes[0] * np.minimum(u - x[0], 0) + slopes[-1] * np.maximum(u - x[-1], 0)
            return np.asarray(smooth + ends)
        else:
            here = np.interp(u, x, y)
        return np.where(outside, y[k] + (y[k + 1] - y[k]) / (x[k + 1] - x[k]) * (u - x[k]), here)

    if extrapolation == HOLD:
        return lambda u: piece(np.clip(u, x[0], x[-1]))
    if extrapolation == PERIODIC:
        return lambda u: piece(_repeated(u, x))
    return piece


def _repeated(u: FloatArray, x: FloatArray) -> FloatArray:
    """What is outside of the points, moved by whole periods."""
    return np.where((u < x[0]) | (u > x[-1]), x[0] + (u - x[0]) % (x[-1] - x[0]), u)


def _surface(area: FloatArray, smoothness: int, extrapolation: int) -> Callable[..., FloatArray]:
    u1, u2, values = area[1:, 0], area[0, 1:], area[1:, 1:]
    linear = RegularGridInterpolator([u1, u2], values, bounds_error=False, fill_value=None)

    def value(a: FloatArray, b: FloatArray) -> FloatArray:
        if extrapolation == HOLD:
            a, b = np.clip(a, u1[0], u1[-1]), np.clip(b, u2[0], u2[-1])
        if extrapolation == PERIODIC:
            a, b = _repeated(a, u1), _repeated(b, u2)
        outside = (a < u1[0]) | (a > u1[-1]) | (b < u2[0]) | (b > u2[-1])
        i = np.clip(np.searchsorted(u1, a, side="right") - 1, 0, len(u1) - 1)
        j = np.clip(np.searchsorted(u2, b, side="right") - 1, 0, len(u2) - 1)
        straight = linear(np.column_stack([a, b]))
        return np.where(outside | (smoothness == LINEAR), straight, values[i, j])

    return value


def _elements(name: str, table: FloatArray) -> dict[str, float]:
    return {f"{name}[{i + 1},{j + 1}]": float(value) for (i, j), value in np.ndenumerate(table)}


def _random_curves(rng: np.random.Generator) -> Iterator[FloatArray]:
    """Tables of any form, increasing, with steps, and with equal values."""
    x = np.cumsum(rng.uniform(0.2, 1.5, 6)) - 2.0
    yield np.column_stack([x, rng.normal(size=(6, 2))])
    yield np.column_stack([x, np.cumsum(rng.uniform(0.0, 1.0, (6, 2)), axis=0)])
    yield np.column_stack([x, np.round(rng.normal(size=(6, 2)))])


@pytest.mark.parametrize(
    ("smoothness", "extrapolation"), [*itertools.product(range(1, 7), (HOLD, LAST_TWO, PERIODIC))]
)
def test_one_input(smoothness: int, extrapolation: int, built: Callable[[str], Path]) -> None:
    """At the points themselves, between them and outside, to rounding errors."""
    rng = np.random.default_rng(20)
    times = np.linspace(0.0, 1.0, 60)
    blocks = ("single", "several")
    chosen: dict[str, float] = {f"{block}.smoothness": smoothness for block in blocks}
    chosen |= {f"{block}.extrapolation": extrapolation for block in blocks}
    with Fmu(built("Inputs")) as fmu:
        for table in _random_curves(rng):
            u, v = rng.uniform(-6.0, 9.0, (2, 60))
            u[:6] = table[:, 0]
            inputs = pd.DataFrame({"u": u, "v": v}, index=pd.Index(times, name="time"))
            found = fmu.run(times, parameters=chosen | _elements("curves", table), inputs=inputs)
            x = table[:, 0]
            first, second = (_curve(x, table[:, column], smoothness, extrapolation) for column in (1, 2))
            for name, expected in zip(
                ("1", "2", "3", "4"), (second(u), first(u), first(u), second(v)), strict=True
            ):
                np.testing.assert_allclose(found[f"y[{name}]"], expected, atol=1e-12, err_msg=name)


@pytest.mark.parametrize(
    ("smoothness", "extrapolation"), [*itertools.product((LINEAR, CONSTANT), (HOLD, LAST_TWO, PERIODIC))]
)
def test_two_inputs(smoothness: int, extrapolation: int, built: Callable[[str], Path]) -> None:
    rng = np.random.default_rng(21)
    times = np.linspace(0.0, 1.0, 80)
    area = np.zeros((4, 5))
    area[1:, 0], area[0, 1:] = np.cumsum(rng.uniform(0.2, 1.5, 3)), np.cumsum(rng.uniform(0.2, 1.5, 4))
    area[1:, 1:] = rng.normal(size=(3, 4))
    u, v = rng.uniform(-2.0, 6.0, (2, 80))
    u[:3], v[:4] = area[1:, 0], area[0, 1:]
    chosen: dict[str, float] = {"surface.smoothness": smoothness, "surface.extrapolation": extrapolation}
    with Fmu(built("Inputs")) as fmu:
        inputs = pd.DataFrame({"u": u, "v": v}, index=pd.Index(times, name="time"))
        found = fmu.run(times, parameters=chosen | _elements("area", area), inputs=inputs)
    expected = _surface(area, smoothness, extrapolation)(u, v)
    np.testing.assert_allclose(found["y[5]"], expected, atol=1e-12)


def test_derivatives(built: Callable[[str], Path]) -> None:
    """The tangents of a smooth table, against SciPy's derivative."""
    table = np.array([[-1, 0, 1], [0.5, 2, 2], [1, 1, 5], [2.5, 1, 6], [4, 0, 6.5], [4.5, -3, 6.0]])
    curve = CubicHermiteSpline(table[:, 0], table[:, 2], _slopes(table[:, 0], table[:, 2], AKIMA))
    with Fmu(built("Inputs")) as fmu:
        for u in (-0.3, 0.7, 1.9, 4.2):
            matrix = fmu.linearize(inputs={"u": u}, parameters={"single.smoothness": AKIMA}).B
            assert matrix.loc["x", "u"] == pytest.approx(curve.derivative()(u), rel=1e-12)


_TIMES = np.array([[-0.4, 1], [0.3, 2], [0.3, -1], [1.1, 0.5], [1.100001, 0.5], [2, -2.0]])


def _over_time(t: FloatArray, smoothness: int, extrapolation: int, start: float, shift: float) -> FloatArray:
    """Value after the events at t: lines or constants between the points."""
    x, y = _TIMES.T
    local = t - shift
    if extrapolation == PERIODIC:
        local = x[0] + (local - x[0]) % (x[-1] - x[0])
    k = np.clip(np.searchsorted(x, local, side="right") - 1, 0, len(x) - 2)
    line = y[k] + (y[k + 1] - y[k]) * (local - x[k]) / (x[k + 1] - x[k])
    inside = (local >= x[0]) & (local < x[-1])
    held = np.where(local < x[0], y[0], y[-1])
    within = line if smoothness == LINEAR else y[k]
    return 0.5 + np.where(
        t < start, 0.0, np.where(inside, within, line if extrapolation == LAST_TWO else held)
    )


def _integral(
    t: FloatArray, smoothness: int, extrapolation: int, *, start: float, shift: float
) -> FloatArray:
    """The exact integral from 0: of values that are lines between their jumps, by the midpoint of each."""
    period = _TIMES[-1, 0] - _TIMES[0, 0]
    jumps = [x + shift + n * period for x in _TIMES[:, 0] for n in range(-3, 6)]
    points = np.unique(np.concatenate([t, [start], jumps]))
    points = points[(points >= 0) & (points <= t[-1])]
    middle = _over_time((points[:-1] + points[1:]) / 2, smoothness, extrapolation, start, shift)
    return np.asarray(np.interp(t, points, np.concatenate([[0.0], np.cumsum(middle * np.diff(points))])))


_CASES = [
    *(
        (LINEAR, extrapolation, events)
        for extrapolation in (HOLD, LAST_TWO, PERIODIC)
        for events in (ALWAYS, AT_JUMPS)
    ),
    *((CONSTANT, extrapolation, ALWAYS) for extrapolation in (HOLD, LAST_TWO, PERIODIC)),
]


@pytest.mark.parametrize(("smoothness", "extrapolation", "events"), _CASES)
@pytest.mark.parametrize(("start", "shift"), [(0.0, 0.0), (0.55, 0.2), (0.1, 0.9)])
def test_time_table(
    smoothness: int, extrapolation: int, events: int, start: float, shift: float, built: Callable[[str], Path]
) -> None:
    """The value and its integral, in one long step: no point is stepped over, not even after 1e-6 s."""
    settings = {
        "source.smoothness": smoothness,
        "source.extrapolation": extrapolation,
        "source.timeEvents": events,
        "start": start,
        "shift": shift,
    }
    times = np.linspace(0.0, 7.0, 24)
    with Fmu(built("Times")) as fmu:
        found = fmu.run(times, parameters=settings)
        last = fmu.run([0.0, 7.0], parameters=settings)["x"].iloc[-1]
    expected = _integral(times, smoothness, extrapolation, start=start, shift=shift)
    values = _over_time(times, smoothness, extrapolation, start, shift)
    np.testing.assert_allclose(found["y"], values, atol=1e-12)
    # Between events the integrand is a line, which the integrator integrates exactly; not so with events at
    # jumps only, where kinks cost the tolerance of 1e-8.
    accuracy = 1e-11 if events == ALWAYS else 1e-6
    np.testing.assert_allclose(found["x"], expected, atol=accuracy)
    assert abs(last - expected[-1]) < accuracy


@pytest.mark.parametrize(("smoothness", "extrapolation"), [(LINEAR, PERIODIC), (CONSTANT, HOLD)])
def test_time_table_in_model_exchange(
    smoothness: int, extrapolation: int, built: Callable[[str], Path]
) -> None:
    result = fmpy.simulate_fmu(
        str(built("Times")),
        fmi_type="ModelExchange",
        stop_time=7.0,
        relative_tolerance=1e-10,
        start_values={"source.smoothness": smoothness, "source.extrapolation": extrapolation},
        output=["x"],
    )
    times, last = np.unique(result["time"][::-1], return_index=True)
    expected = _integral(times, smoothness, extrapolation, start=0.0, shift=0.0)
    np.testing.assert_allclose(result["x"][::-1][last], expected, atol=1e-8)


@pytest.mark.parametrize("smoothness", [LINEAR, AKIMA, FRITSCH_BUTLAND, STEFFEN, MODIFIED_AKIMA])
@pytest.mark.parametrize("extrapolation", [HOLD, LAST_TWO, PERIODIC])
def test_time_table_without_events_at_its_points(
    smoothness: int, extrapolation: int, built: Callable[[str], Path]
) -> None:
    """Values off the ends, where a smooth table has events, and kinks only cost accuracy."""
    table = np.array([[-0.4, 1, 0], [0.3, 2, 1], [0.5, -1, 1], [1.1, 0.5, 2], [1.4, 0.5, 3], [2, -2.0, 5]])
    times = np.linspace(0.01, 7.01, 83)
    settings: dict[str, float] = {
        "source.smoothness": smoothness,
        "source.extrapolation": extrapolation,
        "source.timeEvents": NEVER,
    }
    with Fmu(built("Times")) as fmu:
        found = fmu.run(np.append(0.0, times), parameters=settings | _elements("source.table", table))
    expected = 0.5 + _curve(table[:, 0], table[:, 1], smoothness, extrapolation)(times)
    np.testing.assert_allclose(found["y"].iloc[1:], expected, atol=1e-12)


def test_time_scale(built: Callable[[str], Path]) -> None:
    """Points are at 0.1 s and 0.3, 0.6, 0.6, 2.1 s later, every 2.1 s, and count from 0.3 s on."""
    x = np.array([0.1, 0.4, 0.7, 0.7, 2.2])
    y = np.array([0.0, 3.0, 1.0, 2.0, 0.0])
    times = np.linspace(0.05, 6.05, 41)
    with Fmu(built("Scaled")) as fmu:
        found = fmu.run(np.concatenate([[0.0], times]))["y"].iloc[1:]
    expected = np.where(times < 0.3, 0.0, np.interp((times - 0.1) % 2.1 + 0.1, x, y))
    np.testing.assert_allclose(found, expected, atol=1e-12)


def test_kinks_without_events(built: Callable[[str], Path]) -> None:
    """A table of a state gives no events: the integrator shortens its steps at kinks, to its tolerance."""
    times = np.linspace(0.0, 10.0, 51)
    x, y = np.array([-2.0, -1.0, 1.0, 2.0]), np.array([-9.0, -2.0, 2.0, 9.0])
    exact = solve_ivp(
        lambda _, z: [z[1], -np.interp(z[0], x, y)],
        (0.0, 10.0),
        [1.8, 0.0],
        "DOP853",
        times,
        rtol=1e-12,
        atol=1e-12,
        max_step=1e-2,
    )
    with Fmu(built("Spring")) as fmu:
        found = fmu.run(times, tolerance=1e-9)
    np.testing.assert_allclose(found["s"], exact.y[0], atol=1e-6)


def test_extrapolation_is_refused_where_the_block_says_so(built: Callable[[str], Path]) -> None:
    with Fmu(built("Beyond")) as fmu:
        fmu.run([0.0, 0.4])
        with pytest.raises(FmuRunError, match=r"must not be extrapolated.*not in the range from 0 to 0\.5"):
            fmu.run([0.0, 0.4, 0.8])


@pytest.mark.parametrize(("block", "reason"), [("single", "u "), ("several", "u[2]"), ("surface", "u2 ")])
def test_inputs_beyond_a_table_end_the_run_where_it_says_so(
    block: str, reason: str, built: Callable[[str], Path]
) -> None:
    inside = pd.DataFrame({"u": [0.0, 0.5], "v": [1.5, 2.0]}, index=pd.Index([0.0, 1.0], name="time"))
    beyond = inside.assign(**{"u" if block == "single" else "v": [1.5, 20.0]})
    forbidden = {f"{block}.extrapolation": 4}
    with Fmu(built("Inputs")) as fmu:
        fmu.run([0.0, 1.0], parameters=forbidden, inputs=inside)
        with pytest.raises(FmuRunError, match="must not be extrapolated") as caught:
            fmu.run([0.0, 1.0], parameters=forbidden, inputs=beyond)
    assert reason in str(caught.value)


def test_points_must_increase(built: Callable[[str], Path]) -> None:
    with Fmu(built("Decreasing")) as fmu, pytest.raises(FmuRunError, match="must increase strictly"):
        fmu.run([0.0, 1.0])


def test_smooth_surfaces_are_refused(tmp_path: Path) -> None:
    message = r"Modelica\.mo:\d+:\d+: the smoothness of source is not supported"
    with pytest.raises(UnsupportedModelError, match=message):
        build_fmu("Tables.SmoothSurface", tmp_path, library=[_MODELS, _LIBRARY])


def test_lines_stay_in_place() -> None:
    text = _LIBRARY.read_text()
    changed = with_own_tables({_LIBRARY: text})[_LIBRARY]
    assert "tableID, i" not in changed
    kept = [
        (i, line) for i, line in enumerate(text.splitlines()) if "end Combi" in line or "function" in line
    ]
    assert len(kept) > 8
    assert all(changed.splitlines()[i].strip() == line.strip() for i, line in kept)


def test_other_texts_are_left_alone() -> None:
    texts = {_MODELS: _MODELS.read_text()}
    assert with_own_tables(texts) == texts
