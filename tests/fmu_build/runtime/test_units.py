"""Single files of the runtime, where an FMU would hide faults: equations, one step, one search, actions."""

from __future__ import annotations

import ctypes as c
import math
from collections.abc import Callable, Iterator, Sequence

import numpy as np
import pytest
from scipy.integrate import RK45

_Doubles = c.POINTER(c.c_double)
_BlockFunction = c.CFUNCTYPE(None, c.c_double, _Doubles, _Doubles, _Doubles)
_AtTime = c.CFUNCTYPE(None, c.c_double, _Doubles)
_Report = c.CFUNCTYPE(None, c.c_void_p, c.c_int, c.c_char_p)
OK, FAILED, TERMINATED = range(3)


class _Function(c.Structure):
    """What units.c calls in place of a model."""

    _fields_ = (("at_time", _AtTime),)


def _array(values: Sequence[float]) -> c.Array[c.c_double]:
    return (c.c_double * len(values))(*values)


# Linear equations.


def _solve(units: c.CDLL, matrix: Sequence[Sequence[float]], right: Sequence[float]) -> list[float] | None:
    n = len(right)
    factors, x, pivot = _array(np.ravel(matrix).tolist()), _array(right), (c.c_size_t * n)()
    units.lu_factor.restype = c.c_bool
    if not units.lu_factor(c.c_size_t(n), factors, pivot):
        return None
    units.lu_solve(c.c_size_t(n), factors, pivot, x)
    return list(x)


@pytest.mark.parametrize("first", [0.0, 1e-20])
def test_rows_are_exchanged(units: c.CDLL, first: float) -> None:
    """Without, the first pivot would be zero, or so small that it drowns the second equation."""
    assert _solve(units, [[first, 1.0], [1.0, 1.0]], [1.0, 3.0]) == pytest.approx([2.0, 1.0], rel=1e-15)


def test_linear_equations_of_any_scale(units: c.CDLL) -> None:
    random = np.random.default_rng(5)
    for n in (1, 2, 5, 12):
        rows, columns = 10.0 ** random.uniform(-12, 12, (n, 1)), 10.0 ** random.uniform(-12, 12, n)
        balanced, x = random.normal(size=(n, n)), random.normal(size=n)
        right = (rows * balanced) @ x
        found = _solve(units, (rows * balanced * columns).tolist(), right.tolist())
        assert found is not None
        assert columns * found == pytest.approx(x, rel=1e-10 * np.linalg.cond(balanced))


@pytest.mark.parametrize(
    "matrix",
    [
        [[0.0]],
        [[1.0, 2.0], [2.0, 4.0]],
        # In decimal fractions the last pivot is not exactly zero.
        [[0.1, 0.3], [0.3, 0.9]],
        [[0.1, 0.2, 0.3], [0.4, 0.5, 0.6], [0.7, 0.8, 0.9]],
    ],
)
@pytest.mark.parametrize("scale", [1.0, 1e-12, 1e12])
def test_equations_that_depend_on_each_other_are_singular(
    units: c.CDLL, matrix: list[list[float]], scale: float
) -> None:
    assert _solve(units, [[scale * a for a in row] for row in matrix], [1.0] * len(matrix)) is None


# Algebraic loops.


class _Unknown(c.Structure):
    _fields_ = (("index", c.c_size_t), ("name", c.c_char_p), ("nominal", c.c_double))


class _Block(c.Structure):
    _fields_ = (
        ("size", c.c_size_t),
        ("unknowns", c.POINTER(_Unknown)),
        ("linear", c.c_bool),
        ("residual", _BlockFunction),
        ("jacobian", _BlockFunction),
    )


def _block(
    residual: Callable[..., Sequence[float]],
    jacobian: Callable[..., Sequence[float]],
    size: int,
    *,
    linear: bool = False,
    nominal: float = 1.0,
) -> _Block:
    """The loop in which `residual` of the unknowns is zero; `jacobian` is row-major."""

    def written(function: Callable[..., Sequence[float]]) -> Callable[..., None]:
        def write(_time: float, y: Sequence[float], _p: object, out: list[float]) -> None:
            for i, value in enumerate(function(*y[:size])):
                out[i] = value

        return write

    unknowns = (_Unknown * size)(*(_Unknown(i, b"u", nominal) for i in range(size)))
    return _Block(
        size, unknowns, linear, _BlockFunction(written(residual)), _BlockFunction(written(jacobian))
    )


def _solve_block(
    units: c.CDLL,
    residual: Callable[..., Sequence[float]],
    jacobian: Callable[..., Sequence[float]],
    guess: Sequence[float],
    *,
    linear: bool = False,
    nominal: float = 1.0,
) -> list[float] | None:
    """The unknowns that solve `_block`."""
    block = _block(residual, jacobian, len(guess), linear=linear, nominal=nominal)
    y = _array(guess)
    units.block_solve.restype = c.c_bool
    units.block_solve.argtypes = (c.c_void_p, c.c_double, c.c_void_p, c.c_void_p)
    if not units.block_solve(c.addressof(block), 0.0, c.addressof(y), None):
        assert list(y) == list(guess), "the unknowns are left as they were"
        return None
    return list(y)


@pytest.mark.parametrize("guess", [3.0, -40.0, 5e8])
def test_steps_that_lead_away_are_shortened(units: c.CDLL, guess: float) -> None:
    """Newton's method alone diverges for the arctangent from 1.4 on; from 5e8, 29 halvings are needed."""
    found = _solve_block(units, lambda u: [math.atan(u)], lambda u: [1.0 / (1.0 + u * u)], [guess])
    assert found == pytest.approx([0.0], abs=1e-14)


@pytest.mark.parametrize("scale", [1e-20, 1.0, 1e20])
def test_the_scale_of_an_equation_does_not_matter(units: c.CDLL, scale: float) -> None:
    """Beside an equation of size 1 that is fulfilled from the start."""
    found = _solve_block(
        units,
        lambda u, v: [u - 1.0, scale * (v * v - 2.0)],
        lambda _, v: [1.0, 0.0, 0.0, scale * 2.0 * v],
        [1.0, 1.0],
    )
    assert found == pytest.approx([1.0, math.sqrt(2.0)], rel=1e-15)


def test_the_scale_of_an_unknown_is_its_nominal_value(units: c.CDLL) -> None:
    """A step of 1e-15 from 0 is no small one where the solution is 1e-15."""
    found = _solve_block(
        units,
        lambda q: [1e15 * q + (1e15 * q) ** 3 - 2.0],
        lambda q: [1e15 + 3e45 * q * q],
        [0.0],
        nominal=1e-15,
    )
    assert found == pytest.approx([1e-15], rel=1e-14, abs=0.0)


@pytest.mark.parametrize(("large", "linear"), [(1e4, False), (1e8, False), (1e8, True), (1e12, True)])
def test_terms_that_cancel_leave_rounding(units: c.CDLL, large: float, linear: bool) -> None:
    """The residual comes in steps of the rounding of `large`, none of which need be zero."""
    for k in range(40):
        b = math.sin(k)
        found = _solve_block(
            units,
            lambda u, v, b=b: [(((large + u) + v) - large) - b, u - 0.7 * v - 0.1],
            lambda *_: [1.0, 1.0, 1.0, -0.7],
            [0.0, 0.0],
            linear=linear,
        )
        v = (b - 0.1) / 1.7
        assert found == pytest.approx([0.1 + 0.7 * v, v], abs=4e-16 * large)


def test_no_solution(units: c.CDLL) -> None:
    assert _solve_block(units, lambda u: [u * u + 1.0], lambda u: [2.0 * u], [0.3]) is None
    assert _solve_block(units, lambda u: [math.exp(u)], lambda u: [math.exp(u)], [0.0]) is None
    assert _solve_block(units, lambda u: [math.nan], lambda u: [1.0], [0.0]) is None
    assert _solve_block(units, lambda u: [u - math.inf], lambda u: [1.0], [0.0], linear=True) is None
    # The kink holds the iteration at a residual of 1.
    assert _solve_block(units, lambda u: [abs(u) + 1.0], lambda u: [math.copysign(1.0, u)], [2.0]) is None


@pytest.mark.parametrize("size", [1.0, 1e3])
def test_rounding_moves_no_unknown(units: c.CDLL, size: float) -> None:
    """A step that lowers the residual nowhere is not taken: 1e-7 of the unknown is rounding, 1e-5 is not."""
    assert _solve_block(units, lambda _: [1e-7 * size], lambda _: [1.0], [size]) == [size]
    assert _solve_block(units, lambda _: [1e-5 * size], lambda _: [1.0], [size]) is None


@pytest.fixture
def fail(units: c.CDLL) -> Iterator[Callable[[bool, float], None]]:
    """Makes the model's loop have no solution, if wanted, and the Jacobian of the given entry."""
    loop, solvable = _Block.in_dll(units, "test_loop"), c.c_bool.in_dll(units, "test_solvable")
    kept = []

    def put(unsolvable: bool, entry: float) -> None:
        kept.append(_block(lambda _: [math.nan], lambda _: [entry], 1))
        c.memmove(c.addressof(loop), c.addressof(kept[-1]), c.sizeof(loop))
        solvable.value = not unsolvable

    yield put
    solvable.value = True


@pytest.mark.parametrize(
    ("unsolvable", "entry", "why"),
    [
        (True, 1.0, "the algebraic loop of `u` could not be solved: residual or Jacobian not finite"),
        (
            False,
            0.0,
            "the algebraic loop of `u` could not be solved: "
            "singular Jacobian: the equations do not determine `u`",
        ),
        (False, 1.0, "a system of equations has no solution, or memory was short"),
    ],
)
def test_a_loop_is_explained(
    units: c.CDLL, fail: Callable[[bool, float], None], unsolvable: bool, entry: float, why: str
) -> None:
    """One that has no solution, one whose tangents are undetermined, and one that now has both."""
    fail(unsolvable, entry)
    units.blocks_explain.restype = c.c_char_p
    text = c.create_string_buffer(768)
    assert units.blocks_explain(c.c_double(0.0), _array([0.0, 0.0]), None, text).decode() == why


def test_a_large_linear_loop(units: c.CDLL) -> None:
    """More unknowns than fit onto the stack; the first guess may be anything."""
    n = 30
    random = np.random.default_rng(2)
    matrix, x = random.normal(size=(n, n)), random.normal(size=n)
    found = _solve_block(
        units,
        lambda *y: (matrix @ (np.array(y) - x)).tolist(),
        lambda *_: matrix.ravel().tolist(),
        (1e6 * random.normal(size=n)).tolist(),
        linear=True,
    )
    assert found == pytest.approx(x, rel=1e-10)


# The integrator.


class _Record(c.Structure):
    _fields_ = (
        ("time", c.c_double),
        ("suggestion", c.c_double),
        ("base", c.c_double),
        ("step", c.c_double),
        ("slope_known", c.c_bool),
        ("evaluations", c.c_size_t),
        ("accepted", c.c_size_t),
        ("rejected", c.c_size_t),
    )


class _Integrator(c.Structure):
    _fields_ = (
        ("nominal", _Doubles),
        ("tolerance", c.c_double),
        ("largest_step", c.c_double),
        ("argument", _Doubles),
        ("context", c.c_void_p),
        ("record", _Record),
        ("arrays", _Doubles),
    )


def _one_step(
    units: c.CDLL,
    derivatives: Callable[[float, Sequence[float]], Sequence[float]],
    states: Sequence[float],
    *,
    tolerance: float = 1e-6,
    suggestion: float = 0.0,
    largest: float = math.inf,
) -> _Record:
    """What the integrator notes of one step from time 0; it has two states."""
    argument, nominal = _array([0.0, 0.0]), _array([1.0, 1.0])

    def write(time: float, out: list[float]) -> None:
        out[0], out[1] = derivatives(time, list(argument))

    function = _Function(_AtTime(write))
    units.integrator_count.restype = c.c_size_t
    block = _array([0.0] * units.integrator_count())
    integrator = _Integrator(nominal, tolerance, largest, argument, c.addressof(function))
    units.integrator_bind(c.byref(integrator), block)
    units.integrator_restart(c.byref(integrator), c.c_double(0.0), _array(states))
    integrator.record.suggestion = suggestion
    assert units.integrator_step(c.byref(integrator), c.c_double(1e9)) == 0
    return integrator.record


def _error(slope: Callable[[float], float], y: float, h: float) -> float:
    """The error estimate of one step of Dormand's and Prince's method for y' = slope(y)."""
    k = [slope(y)]
    for row in RK45.A[1:]:
        k.append(slope(y + h * sum(a * b for a, b in zip(row, k, strict=False))))
    end = y + h * float(np.dot(RK45.B, k))
    return abs(h * float(np.dot(RK45.E, [*k, slope(end)])))


@pytest.mark.parametrize(("second", "share"), [(1.0, 1.0), (0.0, 0.5)])
def test_the_next_step_follows_from_the_mean_square_error(units: c.CDLL, second: float, share: float) -> None:
    """The second state moves as the first one does, or rests."""
    h, tolerance = 0.5, 1e-3
    record = _one_step(
        units,
        lambda _, y: [-y[0], -second * y[1]],
        [1.0, 1.0],
        tolerance=tolerance,
        suggestion=h,
    )
    assert record.step == h
    scaled = _error(lambda y: -y, 1.0, h) / (tolerance * (1.0 + 1.0))
    wanted = 0.9 * (share * scaled**2) ** -0.1
    assert 0.2 < wanted < 5.0
    assert record.suggestion / h == pytest.approx(wanted, rel=0.01)


def test_a_step_that_follows_a_rejected_one_does_not_grow(units: c.CDLL) -> None:
    grew = 0
    for k in range(20):
        h = 3.0 * 1.3**k
        record = _one_step(units, lambda _, y: [-y[0], -y[1]], [1.0, 1.0], suggestion=h)
        assert record.rejected > 0
        assert record.suggestion <= record.step
        again = _one_step(units, lambda _, y: [-y[0], -y[1]], [1.0, 1.0], suggestion=record.step)
        assert again.rejected == 0
        grew += again.suggestion > again.step
    assert grew > 0, "without the rejected step before it"


@pytest.mark.parametrize("suggestion", [0.0, 5.0])
def test_no_step_is_longer_than_the_largest(units: c.CDLL, suggestion: float) -> None:
    record = _one_step(units, lambda *_: [0.0, 0.0], [1.0, 1.0], suggestion=suggestion, largest=1e-9)
    assert 0.0 < record.step <= 1e-9


# The search for crossings.


class _Finder(c.Structure):
    _fields_ = (
        ("context", c.c_void_p),
        *((name, _Doubles) for name in ("start", "sample", "end", "agrees")),
        ("work", _Doubles * 3),
    )


class _Crossing(c.Structure):
    _fields_ = (("result", c.c_int), ("time", c.c_double), ("relation", c.c_size_t))


def _search(units: c.CDLL, root: Callable[[float], float]) -> float | None:
    """When the root falls below zero first within the step from 0 to 1."""

    def write(time: float, out: list[float]) -> None:
        out[0] = root(time)

    function = _Function(_AtTime(write))
    units.roots_count.restype = c.c_size_t
    block = _array([0.0] * units.roots_count())
    finder = _Finder(c.addressof(function))
    units.roots_bind(c.byref(finder), block)
    finder.start[0], finder.sample[0], finder.end[0] = (root(time) for time in (0.0, 0.8, 1.0))
    units.roots_search.restype = _Crossing
    found = units.roots_search(c.byref(finder), _array([0.0] * 3), c.c_double(0.0), c.c_double(1.0))
    return found.time if found.result == 1 else None


def test_crossings_of_a_line_and_of_a_parabola(units: c.CDLL) -> None:
    assert _search(units, lambda t: 0.3 - t) == pytest.approx(0.3, abs=1e-15)
    assert _search(units, lambda t: (t - 0.4) * (t - 0.6)) == pytest.approx(0.4, abs=1e-15)
    assert _search(units, lambda t: (t - 0.4) * (t - 0.6) + 0.011) is None


def test_a_dip_that_three_samples_place_just_outside_the_step(units: c.CDLL) -> None:
    """The parabola through the samples has its vertex at -0.047, the root its minimum at 0.26, below zero."""
    root = np.polynomial.Polynomial([0.05, -0.83, 1.55, 1.19, -1.28])
    assert min(root(t) for t in (0.0, 0.8, 1.0)) > 0.0
    crossing = min(float(r.real) for r in root.roots() if abs(r.imag) < 1e-9 and 0.0 < r.real < 1.0)
    assert _search(units, lambda t: float(root(t))) == pytest.approx(crossing, abs=1e-14)


# Actions.


class _Values(c.Structure):
    _fields_ = (
        ("time", c.c_double),
        *((name, _Doubles) for name in ("y", "p", "clock_tick", "clock_zero", "reported", "any_reported")),
    )


class _Reporter(c.Structure):
    _fields_ = (("context", c.c_void_p), ("report", _Report))


@pytest.mark.parametrize("function", ["actions_take", "event_check_asserts"])
def test_actions(units: c.CDLL, function: str) -> None:
    """An error outweighs the end of the simulation, a warning is told once while its condition holds."""
    told: list[tuple[int, str]] = []
    reporter = _Reporter(None, _Report(lambda _, kind, text: told.append((kind, text.decode()))))
    error, warning, terminate = (0, "action 0"), (1, "action 1"), (2, "action 2")
    p, active = _array([0.0] * 3), (c.c_bool * 3)()
    values = _Values(0.0, _array([0.0] * 2), p, None, None, _array([0.0] * 3), _array([0.0]))
    scratch = (active,) if function == "actions_take" else ()
    for conditions, status, expected in (
        ((0, 0, 0), OK, []),
        ((0, 1, 0), OK, [warning]),
        ((0, 1, 0), OK, []),
        ((0, 1, 1), TERMINATED, [terminate]),
        ((1, 1, 1), FAILED, [error, terminate]),
        ((0, 0, 0), OK, []),
        ((0, 1, 0), OK, [warning]),
        ((1, 0, 0), FAILED, [error]),
        ((0, 1, 1), TERMINATED, [warning, terminate]),
    ):
        p[:] = conditions
        told.clear()
        assert units[function](c.byref(values), *scratch, c.byref(reporter)) == status
        assert told == expected


def test_actions_that_cannot_be_evaluated(units: c.CDLL, fail: Callable[[bool, float], None]) -> None:
    told: list[tuple[int, str]] = []
    reporter = _Reporter(None, _Report(lambda _, kind, text: told.append((kind, text.decode()))))
    values = _Values(0.0, _array([0.0] * 2), _array([0.0] * 3), None, _array([0.0] * 3), _array([0.0]))
    fail(True, 1.0)
    assert units.actions_take(c.byref(values), (c.c_bool * 3)(), c.byref(reporter)) == FAILED
    assert [kind for kind, _ in told] == [0]
