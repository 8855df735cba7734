from __future__ import annotations

import math
import tracemalloc
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from pyjoystick.laboratory import Chain, angular_acceleration, read_accelerometer, synthetic_acceleration
from pyjoystick.laboratory.measurements.accelerometer import AccelerometerRecord
from pyjoystick.laboratory.measurements.chain import Motion
from pyjoystick.laboratory.measurements.saturation import SaturationWatch
from pyjoystick.model import NOMINAL, JoystickParameters, simulate
from pyjoystick.motion import GRAVITY, RecordError
from pyjoystick.support import ParameterError
from tests.pyjoystick.laboratory.measurements.made import write

RATE = 1800.0
DISTANCE = 0.25
REST = (2.7, 2.99)
HELD = 450


def _released(parameters: JoystickParameters, angle: float) -> tuple[NDArray[np.float64], ...]:
    """Time, angle and acceleration of a joystick that is held for 0.25 s and let go."""
    time = np.arange(int(3.0 * RATE)) / RATE
    run = simulate(parameters, time=time[HELD:], theta_start=math.radians(angle))
    theta, alpha = np.full(len(time), math.radians(angle)), np.zeros(len(time))
    theta[HELD:], alpha[HELD:] = run.theta, run.alpha
    return time, theta, alpha


@pytest.fixture(scope="module")
def release() -> tuple[NDArray[np.float64], ...]:
    return _released(NOMINAL, -20.0)


def _record(time: NDArray[np.float64], acceleration: NDArray[np.float64]) -> AccelerometerRecord:
    rows = np.arange(len(time), dtype=np.int64)
    low, high = float(acceleration.min()), float(acceleration.max())
    return AccelerometerRecord("made", time, acceleration, rows, len(time), RATE, low, high, ())


def _motion(time: NDArray[np.float64], theta: NDArray[np.float64]) -> Motion:
    """What the chain makes of the angle at 240 Hz, without noise."""
    frames = np.arange(int(3.0 * 240.0)) / 240.0
    return Chain().run(frames, np.interp(frames, time, theta))


def test_gravity_is_taken_off(release: tuple[NDArray[np.float64], ...]) -> None:
    time, theta, alpha = release
    random = np.random.default_rng(1)
    reading = synthetic_acceleration(theta, alpha, distance=DISTANCE, random=random, noise=0.0)
    # The exact angle in the place of the chain's.
    motion = Motion(time, theta, alpha, alpha, np.zeros(len(time), dtype=bool), ())
    found = angular_acceleration(_record(time, reading), motion, distance=DISTANCE, rest=REST)
    still = (time >= REST[0]) & (time <= REST[1])
    np.testing.assert_allclose(found.alpha, alpha - alpha[still].mean(), atol=1e-9)


def test_less_gravity_the_accelerometer_is_nearer_to_the_differentiated_angle(
    release: tuple[NDArray[np.float64], ...],
) -> None:
    time, theta, alpha = release
    random = np.random.default_rng(2)
    reading = synthetic_acceleration(theta, alpha, distance=DISTANCE, random=random)
    found = angular_acceleration(_record(time, reading), _motion(time, theta), distance=DISTANCE, rest=REST)
    whole = found.differences["differentiated"]
    assert found.differences["less gravity"] < 0.02 * whole
    assert found.differences["with gravity"] > 0.05 * whole
    assert found.correlation > 0.999
    assert abs(found.lag) <= 5e-4


@pytest.mark.parametrize(("angle", "share"), [(-20.0, 0.070), (-17.0, 0.063), (20.0, 0.061)])
def test_gravity_is_about_6_percent_of_the_peak_acceleration(angle: float, share: float) -> None:
    """Section 2 of the paper: its component "has been estimated to be about 6%" of the peak."""
    _, theta, alpha = _released(NOMINAL, angle)
    component = GRAVITY * np.max(np.abs(np.sin(theta)))
    assert component / (0.266 * np.max(np.abs(alpha))) == pytest.approx(share, abs=5e-4)


def test_the_share_of_gravity_is_reported(release: tuple[NDArray[np.float64], ...]) -> None:
    time, theta, alpha = release
    reading = synthetic_acceleration(theta, alpha, distance=0.266, random=np.random.default_rng(3))
    found = angular_acceleration(_record(time, reading), _motion(time, theta), distance=0.266, rest=REST)
    assert found.gravity_share == pytest.approx(0.066, abs=0.002)


@pytest.mark.parametrize("shift", [0.03, -0.0125])
def test_a_clock_that_is_off_is_told(release: tuple[NDArray[np.float64], ...], shift: float) -> None:
    time, theta, alpha = release
    reading = synthetic_acceleration(theta, alpha, distance=DISTANCE, random=np.random.default_rng(4))
    late = _record(time + shift, reading)
    found = angular_acceleration(late, _motion(time, theta), distance=DISTANCE, rest=REST)
    assert found.lag == pytest.approx(shift, abs=5e-4)


def test_an_accelerometer_that_points_backward(release: tuple[NDArray[np.float64], ...]) -> None:
    time, theta, alpha = release
    reading = synthetic_acceleration(theta, alpha, distance=DISTANCE, random=np.random.default_rng(5))
    motion = _motion(time, theta)
    forward = angular_acceleration(_record(time, reading), motion, distance=DISTANCE, rest=REST)
    turned = angular_acceleration(
        _record(time, -reading), motion, distance=DISTANCE, rest=REST, backward=True
    )
    np.testing.assert_array_equal(turned.filtered, forward.filtered)
    wrong = angular_acceleration(_record(time, -reading), motion, distance=DISTANCE, rest=REST)
    assert wrong.correlation < -0.9


def test_what_cannot_be_compared_is_refused(release: tuple[NDArray[np.float64], ...]) -> None:
    time, theta, alpha = release
    record, motion = _record(time, alpha), _motion(time, theta)
    with pytest.raises(ParameterError, match=r"distance = 0\.0"):
        angular_acceleration(record, motion, distance=0.0, rest=REST)
    with pytest.raises(RecordError, match="has no samples with a known angle from 7 to 8 s, called at rest"):
        angular_acceleration(record, motion, distance=DISTANCE, rest=(7.0, 8.0))


SERIES = 0.5 * np.sin(np.arange(4000) / 50.0)


def _csv(values: NDArray[np.float64], heading: str = "acceleration (m/s2)") -> str:
    rows = [f"{i / RATE:.9g},{value:.9g}" for i, value in enumerate(values)]
    return "\n".join(["# made for a test", f"time (s),{heading}", *rows, ""])


@pytest.mark.parametrize("piece", [70, 1000, 1 << 16])
def test_csv_and_npy_hold_the_same_in_pieces_of_any_size(tmp_path: Path, piece: int) -> None:
    np.save(tmp_path / "a.npy", SERIES)
    text = read_accelerometer(write(tmp_path / "a.csv", _csv(SERIES)), piece=piece)
    array = read_accelerometer(tmp_path / "a.npy", unit="m/s2", rate=RATE, piece=piece)
    for found in (text, array):
        np.testing.assert_allclose(found.acceleration, SERIES, atol=1e-9)
        np.testing.assert_allclose(found.time, np.arange(4000) / RATE, atol=1e-8)
        assert (found.samples, found.notes) == (4000, ())
        assert found.rate == pytest.approx(RATE, rel=1e-4)
    assert (int(text.rows[0]), int(array.rows[0])) == (3, 0)


@pytest.mark.parametrize(
    ("unit", "sensitivity", "factor"),
    [("g", None, GRAVITY), ("mm/s2", None, 1e-3), ("V", 0.02, 50.0), ("mV", 0.02, 0.05)],
)
def test_units_of_the_readings(tmp_path: Path, unit: str, sensitivity: float | None, factor: float) -> None:
    file = write(tmp_path / "a.csv", _csv(SERIES, "acceleration"))
    found = read_accelerometer(file, unit=unit, sensitivity=sensitivity)
    np.testing.assert_allclose(found.acceleration, SERIES * factor, atol=1e-8 * factor)
    if sensitivity is None:
        with pytest.raises(RecordError, match=rf"is in {unit}, not in volts; leave the sensitivity out"):
            read_accelerometer(file, unit=unit, sensitivity=0.02)


def test_the_rate_of_rounded_times_is_their_mean(tmp_path: Path) -> None:
    """120 Hz in tenths of a millisecond are steps of 8.3 and 8.4 ms."""
    lines = [f"{number / 120.0:.4f},{math.sin(number):.3f}" for number in range(600)]
    path = write(tmp_path / "rounded.csv", "\n".join(["time (s),acceleration (m/s2)", *lines]))
    assert read_accelerometer(path).rate == pytest.approx(120.0, rel=1e-4)


def test_the_window_is_on_the_other_clock(tmp_path: Path) -> None:
    np.save(tmp_path / "a.npy", SERIES)
    found = read_accelerometer(
        tmp_path / "a.npy", unit="m/s2", rate=1000.0, window=(0.5, 0.6001), delay=1.0, piece=64
    )
    assert (int(found.rows[0]), int(found.rows[-1])) == (1500, 1600)
    np.testing.assert_allclose(found.time[[0, -1]], [0.5, 0.6], atol=1e-12)
    assert found.samples == 4000


def test_ten_million_samples_are_never_in_memory_as_a_whole(tmp_path: Path) -> None:
    count, piece = 10_000_000, 1 << 16
    file = tmp_path / "long.npy"
    with file.open("wb") as stream:  # zeros that take no place on the disk, with a pulse in their middle
        header = {"descr": "<f4", "fortran_order": False, "shape": (count,)}
        np.lib.format.write_array_header_1_0(stream, header)
        start = stream.tell()
        stream.seek(start + 4 * (count // 2))
        stream.write(np.float32(3.5).tobytes())
        stream.truncate(start + 4 * count)
    tracemalloc.start()
    try:
        found = read_accelerometer(file, unit="m/s2", rate=RATE, window=(2777.0, 2778.0), piece=piece)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert (found.samples, found.largest) == (count, 3.5)
    assert found.acceleration[np.flatnonzero(found.rows == count // 2)].tolist() == [3.5]
    # The file has 40 MB, as doubles 80 MB. A piece has 0.5 MB as doubles; a few of these live at once.
    assert peak < 12 * 8 * piece


def test_a_long_csv_is_never_in_memory_as_a_whole(tmp_path: Path) -> None:
    text = "time (s),acceleration (m/s2)\n" + "".join(f"{i / RATE:.7f},{i % 97}.25\n" for i in range(200_000))
    file = write(tmp_path / "long.csv", text)
    tracemalloc.start()
    try:
        found = read_accelerometer(file, window=(50.0, 51.0), piece=2000)
        _, peak = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert found.samples == 200_000
    # As columns of doubles the whole takes 3.2 MB, and its text 3.4 MB; pandas' own buffers take 1 MB.
    assert peak < 0.5 * len(text)


@pytest.mark.parametrize("piece", [13, 100, 4000])
@pytest.mark.parametrize("full_scale", [None, 0.4])
def test_saturation_is_found_across_pieces(tmp_path: Path, piece: int, full_scale: float | None) -> None:
    clipped = np.clip(SERIES, -0.45, 0.4)
    file = write(tmp_path / "a.csv", _csv(clipped))
    (note,) = read_accelerometer(file, piece=piece, full_scale=full_scale).notes
    level = 0.4 * (0.999 if full_scale else 1.0)
    high = np.flatnonzero(level <= SERIES)
    assert f"rows {high[0] + 3}-" in note
    assert "column 'acceleration (m/s2)'" in note
    assert "lower the amplifier's gain" in note


def test_peaks_and_a_quiet_signal_are_not_saturated() -> None:
    watch = SaturationWatch()
    quiet = np.zeros(500)
    quiet[200:203] = [0.5, 1.0, 0.5]
    quiet[300:303] = [-0.5, -1.0, -0.5]
    for start in range(0, 500, 50):
        watch.add(quiet[start : start + 50], start)
    assert watch.found() == []


def _changed(text: str, line: int, new: str) -> str:
    lines = text.splitlines()
    lines[line - 1] = new
    return "\n".join(lines) + "\n"


GOOD = _csv(SERIES[:40])


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (
            _changed(GOOD, 9, "0.0033,x"),
            r"a\.csv, column 'acceleration \(m/s2\)', row 9: is not a number \(found 'x'\)",
        ),
        (_changed(GOOD, 9, "0.0033,"), r"'acceleration \(m/s2\)', row 9: samples without a finite number"),
        (_changed(GOOD, 9, "0.0033,0,5"), r"not a table of columns.*line 9.*decimal marks commas"),
        (GOOD.replace(".", ","), r"not a table of columns.*line 4, saw 4; .*decimal marks commas"),
        (
            GOOD.replace("\n0", "\n0,0"),
            r"row 3: has 3 cells under 2 headings; was the file cut off",
        ),
        (GOOD.replace(",", ";").replace(".", ","), r"row 4: is not a number.*decimal point"),
        (_changed(GOOD, 9, "0.0001,0.5"), r"column 'time', row 9: the time does not increase"),
        (_changed(GOOD, 42, "0.5,0.5"), r"column 'time', row 42: the time step differs from the usual"),
        (
            GOOD.replace("time (s)", "time"),
            r"'time', row 2: has no unit; write .* as in 'time \(s\)'",
        ),
        (GOOD.replace("time (s)", "sample"), r"has no time; give the rate"),
        (GOOD.replace("acceleration", "channel 1"), r"row 2: has no column 'acceleration'; which column"),
        (GOOD.replace("(m/s2)", "(ft/s2)"), r"has an unknown unit \(found ft/s2\).*mV"),
        (GOOD.replace(" (m/s2)", ""), r"'acceleration', row 2: has no unit; write it in the heading"),
        (GOOD.replace("(m/s2)", "(V)"), r"is a voltage \(found V\); give the sensitivity"),
        (_csv(np.full(40, 1.5)), r"never changes \(found 1\.5\); is the charge amplifier on"),
        ("# nothing\n", r"has no headings; begin with"),
    ],
)
def test_bad_files_say_where_and_what_to_do(tmp_path: Path, text: str, words: str) -> None:
    with pytest.raises(RecordError, match=words):
        read_accelerometer(write(tmp_path / "a.csv", text))


def test_bad_arrays_say_what_to_do(tmp_path: Path) -> None:
    file = tmp_path / "a.npy"
    np.save(file, SERIES)
    with pytest.raises(RecordError, match="has no time; give the rate of its samples"):
        read_accelerometer(file, unit="m/s2")
    with pytest.raises(RecordError, match="has no samples from 7 to 8 s, where the angle is known"):
        read_accelerometer(file, unit="m/s2", rate=RATE, window=(7.0, 8.0))
    file.write_bytes(file.read_bytes()[:-800])
    with pytest.raises(RecordError, match="is cut off: it declares 4000 samples and has 3900"):
        read_accelerometer(file, unit="m/s2", rate=RATE)
    np.save(file, np.zeros((5, 2)))
    with pytest.raises(RecordError, match=r"found float64 of shape \(5, 2\)"):
        read_accelerometer(file, unit="m/s2", rate=RATE)
    file.write_text("no array", encoding="utf-8")
    with pytest.raises(RecordError, match=r"is not a \.npy file"):
        read_accelerometer(file, unit="m/s2", rate=RATE)
