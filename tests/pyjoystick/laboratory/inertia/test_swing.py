"""The swing test: the effects of amplitude and damping, and the uncertainty of the inertia."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from pyjoystick.laboratory import (
    Measured,
    combined,
    inertia_of_swing,
    period_of_readings,
    period_of_record,
    synthetic_swing,
)
from pyjoystick.laboratory.inertia.swing import amplitude_factor, mean_amplitude_factor
from pyjoystick.model import NOMINAL, swing_frequency
from pyjoystick.motion import Record, RecordError
from pyjoystick.support import FloatArray, ParameterError
from tests.pyjoystick.laboratory.inertia.pendulum import DAMPING, WEIGHT, swing

EXACT = (Measured(NOMINAL.m), Measured(NOMINAL.h), Measured(NOMINAL.g))


@pytest.mark.parametrize("degrees", [5.0, 20.0, 60.0])
def test_the_amplitude_factor_is_the_integral_of_the_motion(degrees: float) -> None:
    """Over a quarter swing, dt = dtheta/omega, with theta = A sin(u) so that the end is no singularity."""
    top = math.radians(degrees)

    def slowness(u: float) -> float:
        speed_squared = 2.0 * (math.cos(top * math.sin(u)) - math.cos(top))
        return top * math.cos(u) / math.sqrt(speed_squared)

    quarter = quad(slowness, 0.0, math.pi / 2.0 - 1e-9)[0]
    assert amplitude_factor(top) == pytest.approx(quarter / (math.pi / 2.0), rel=1e-7)


def test_the_mean_factor_lies_between_those_of_the_ends() -> None:
    first, last = math.radians(20.0), math.radians(5.0)
    decay = np.exp(np.linspace(math.log(first), math.log(last), 20_001))
    expected = float(np.trapezoid(amplitude_factor(decay)) / 20_000)
    assert mean_amplitude_factor(first, last) == pytest.approx(expected, rel=1e-9)
    assert mean_amplitude_factor(first, first) == pytest.approx(float(amplitude_factor(first)), rel=1e-14)
    assert mean_amplitude_factor(0.0, 0.0) == 1.0


def test_the_inertia_of_table_2_from_its_own_frequency() -> None:
    period = combined(lambda T: T, {"T": Measured(1.0 / swing_frequency(NOMINAL), 1e-4)})  # noqa: N803
    found = inertia_of_swing(period, *EXACT)
    assert found.value == pytest.approx(NOMINAL.J, rel=1e-14)
    assert found.uncertainty == pytest.approx(2.0 * 1e-4 * swing_frequency(NOMINAL) * NOMINAL.J, rel=1e-6)


def test_a_recorded_swing_without_noise() -> None:
    """What the method itself leaves: the amplitude makes 0.34 %, 0.7 % of J, and 1.6e-6 is left."""
    period = period_of_record(swing(None))
    assert inertia_of_swing(period.period, *EXACT).value == pytest.approx(NOMINAL.J, rel=4e-6)
    assert period.amplitude_factor - 1.0 == pytest.approx(3.4e-3, rel=0.05)
    assert period.decay is not None
    expected = DAMPING / (2.0 * math.sqrt(NOMINAL.J * WEIGHT))
    assert period.decay.damping_ratio.value == pytest.approx(expected, rel=1e-3)
    assert period.decay.preferred == "viscous damping alone"


def test_stated_intervals_of_recorded_swings_cover_the_truth() -> None:
    deviations = []
    for seed in range(12):
        period = period_of_record(swing(seed, offset=math.radians(0.3)))
        found = inertia_of_swing(period.period, *EXACT)
        deviations.append((found.value - NOMINAL.J) / found.uncertainty)
    assert np.sum(np.abs(deviations) < 2.0) >= 10
    assert np.max(np.abs(deviations)) < 4.0


@pytest.mark.parametrize(
    ("degrees", "rate", "duration", "noise"), [(60.0, 100.0, 20.0, 0.05), (25.0, 200.0, 30.0, 0.1)]
)
def test_errors_of_large_swings_are_the_stated_ones(
    degrees: float, rate: float, duration: float, noise: float
) -> None:
    """The error of a height changes all later crossings, which do not scatter about their line by as much."""
    clean = synthetic_swing(
        NOMINAL,
        random=np.random.default_rng(0),
        amplitude=math.radians(degrees),
        damping=0.001,
        duration=duration,
        rate=rate,
        noise=0.0,
    )
    true = 1.0 / swing_frequency(NOMINAL)
    random = np.random.default_rng(1)
    deviations = []
    for _ in range(24):
        theta = clean.theta + math.radians(noise) * random.standard_normal(len(clean))
        period = period_of_record(Record("large", clean.time, theta)).period
        deviations.append((period.value - true) / period.uncertainty)
    assert np.sqrt(np.mean(np.square(deviations))) < 1.3
    assert np.max(np.abs(deviations)) < 3.5


def test_stated_intervals_of_stopwatch_readings_cover_the_truth() -> None:
    """Ten swings from 15 degrees; scatter of 0.1 s a reading and 0.05 s that all readings share."""
    random = np.random.default_rng(1)
    top = math.radians(15.0)
    last = top * math.exp(-DAMPING / (2.0 * NOMINAL.J) * 10.0 / swing_frequency(NOMINAL))
    true_time = 10.0 * mean_amplitude_factor(top, last) / swing_frequency(NOMINAL)
    inside = 0
    for _ in range(200):
        shared = 0.05 * random.standard_normal()
        readings = true_time + shared + 0.1 * random.standard_normal(5)
        error = math.radians(1.0)
        tops = (Measured(top + error * random.standard_normal(), error), Measured(last, error))
        low, high = inertia_of_swing(period_of_readings(list(readings), 10, *tops).period, *EXACT).interval
        inside += low <= NOMINAL.J <= high
    # 95 % of 200, and three standard deviations of that number either way.
    assert inside == pytest.approx(190, abs=9)


def test_the_budget_adds_up() -> None:
    period = period_of_readings([8.05, 8.1, 8.0], 10, Measured(0.2, 0.02))
    known = (Measured(0.87, 0.001), Measured(0.082, 0.0005), Measured(9.80665))
    found = inertia_of_swing(period.period, *known)
    assert found.uncertainty == pytest.approx(math.hypot(*found.budget.values()))
    assert found.budget["h"] == pytest.approx(found.value * 0.0005 / 0.082, rel=1e-9)
    assert found.budget["g"] == 0.0
    scatter = 0.05 / math.sqrt(3.0) / 10.0
    factor = mean_amplitude_factor(0.2, 0.2)
    assert period.period.budget["mean of the readings"] == pytest.approx(scatter / factor, rel=1e-9)
    assert found.freedom > period.period.freedom > 2.0


@pytest.mark.parametrize(
    ("readings", "swings", "amplitude", "message"),
    [
        ([], 10, 0.1, "readings"),
        ([8.0, -1.0], 10, 0.1, r"readings\[1\]"),
        ([8.03, 80.3], 10, 0.1, "readings"),
        ([8.0], 0, 0.1, "swings"),
        ([8.0], 10, 20.0, "first_amplitude"),
        ([8.0], 10, -0.1, "first_amplitude"),
    ],
)
def test_readings_that_are_refused(
    readings: list[float], swings: int, amplitude: float, message: str
) -> None:
    with pytest.raises(ParameterError, match=f"^{message} = "):
        period_of_readings(readings, swings, Measured(amplitude))


def test_an_amplitude_that_grows_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"^last_amplitude = 0\.2: must be at most the first"):
        period_of_readings([8.0], 10, Measured(0.1), Measured(0.2))


def test_a_negative_uncertainty_and_an_endless_reaction_are_refused() -> None:
    with pytest.raises(ParameterError, match=r"^first_amplitude\.uncertainty = -0\.1: "):
        period_of_readings([8.0], 10, Measured(0.1, -0.1))
    with pytest.raises(ParameterError, match=r"^reaction_time = 9\.0: must be at most the reading, 8 s"):
        period_of_readings([8.0], 10, Measured(0.1), reaction_time=9.0)


def test_nothing_swings_without_weight() -> None:
    period = period_of_readings([8.0], 10, Measured(0.1)).period
    with pytest.raises(ParameterError, match=r"^h = "):
        inertia_of_swing(period, Measured(0.87), Measured(0.0), Measured(9.81))


def test_a_record_that_is_too_short_or_too_sparse() -> None:
    record = swing(1)
    with pytest.raises(RecordError, match=r"has \d whole half swings that count; at least 5 are needed"):
        period_of_record(record.between(0.0, 2.0))
    sparse = swing(1)
    thinned = type(sparse)("sparse", sparse.time[::8], sparse.theta[::8])
    with pytest.raises(RecordError, match="record with more samples a second"):
        period_of_record(thinned)


def test_the_degrees_of_freedom_are_those_of_the_readings() -> None:
    """Alone the scatter of n readings has n - 1; with two readings the 95 % interval is 12.7 errors wide."""
    for readings in ([8.05, 8.1], [8.05, 8.1, 8.0, 8.2]):
        period = period_of_readings(readings, 10, Measured(0.2), reaction_time=0.0).period
        assert period.freedom == pytest.approx(len(readings) - 1.0, rel=1e-9)
    low, high = period_of_readings([8.05, 8.1], 10, Measured(0.2), reaction_time=0.0).period.interval
    error = 0.05 / math.sqrt(2.0) / math.sqrt(2.0) / 10.0 / float(amplitude_factor(0.2))
    assert (high - low) / 2.0 == pytest.approx(12.7062 * error, rel=1e-4)
    assert period_of_readings([8.05], 10, Measured(0.2)).period.freedom == math.inf


def test_an_amplitude_of_zero_with_an_uncertainty_counts() -> None:
    """The factor of the amplitude is 1 + A^2/16, whose mean square is 3*(u^2/16)^2."""
    error = math.radians(10.0)
    budget = period_of_readings([8.0], 10, Measured(0.0, error)).period.budget
    assert budget["first amplitude"] == pytest.approx(0.8 * math.sqrt(3.0) * error**2 / 16.0, rel=0.02)


def test_one_amplitude_for_start_and_end_is_one_quantity() -> None:
    """Its error moves both ends together: more than two independent errors of the same size."""
    amplitude = Measured(0.2, 0.02)
    one = period_of_readings([8.0], 10, amplitude).period.budget
    two = period_of_readings([8.0], 10, amplitude, amplitude).period.budget
    both = two["first amplitude"] + two["last amplitude"]
    assert one["first amplitude"] == pytest.approx(both, rel=1e-2)


@pytest.mark.parametrize(("value", "error"), [(1.0, math.nan), (1.0, math.inf), (math.nan, 0.1)])
def test_numbers_that_are_not_finite_have_no_budget(value: float, error: float) -> None:
    with pytest.raises(ParameterError, match=r"^(x|u\(x\)) = (nan|inf): must be a finite number"):
        combined(lambda x: x, {"x": Measured(value, error)})


def test_the_period_as_measured_is_that_of_the_large_swings() -> None:
    readings = period_of_readings([8.05, 8.1, 8.3], 10, Measured(0.2), Measured(0.1))
    assert readings.measured == pytest.approx(0.815, rel=1e-12)
    assert readings.period.value == pytest.approx(0.815 / mean_amplitude_factor(0.2, 0.1), rel=1e-12)
    passages = _passages(swing(None))
    expected = 2.0 * (passages[-1] - passages[0]) / (len(passages) - 1)
    assert period_of_record(swing(None)).measured == pytest.approx(expected, rel=1e-5)


def test_the_degrees_of_freedom_of_a_record_are_those_of_its_passages() -> None:
    # A line has two unknowns; what the heights say of friction has degrees of its own, and the method adds.
    record = swing(3)
    assert period_of_record(record).period.freedom == pytest.approx(len(_passages(record)) - 2, rel=0.1)


def _passages(record: Record) -> FloatArray:
    """Instants at which a swing passes zero, by straight lines between samples.

    Between half swings higher than a fifth of the largest; the first and the last of these may be cut off.
    """
    before = np.flatnonzero(np.diff(np.signbit(record.theta)))
    heights = [np.max(np.abs(part)) for part in np.split(record.theta, before + 1)]
    counted = int(np.sum(np.array(heights) > 0.2 * max(heights)))
    inner = before[1 : counted - 2]
    step = record.theta[inner + 1] - record.theta[inner]
    return np.asarray(record.time[inner] - record.theta[inner] / step * record.interval)


def test_a_reading_of_another_number_of_swings_is_refused() -> None:
    with pytest.raises(ParameterError, match=r"readings = from 8.03 to 8.81 s: .*miscounted"):
        period_of_readings([8.03, 8.07, 8.81], 10, Measured(0.1, 0.01))


def test_swings_that_are_too_fast_for_their_body_are_refused() -> None:
    """J about the pivot is at least m h^2; here 20 half swings were counted as swings."""
    period = period_of_readings([8.03], 20, Measured(0.1, 0.01)).period
    with pytest.raises(ParameterError, match=r"J = 0\.0028.* at least m h\^2 = 0\.00585"):
        inertia_of_swing(period, Measured(0.87), Measured(0.082), Measured(9.81))
