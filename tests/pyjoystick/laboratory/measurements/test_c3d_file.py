from __future__ import annotations

import contextlib
import tempfile
import warnings
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from pyjoystick.laboratory.measurements.c3d_file import read_c3d
from pyjoystick.motion import RecordError
from tests.pyjoystick.laboratory.measurements.c3d_writer import Processor, write_c3d
from tests.pyjoystick.laboratory.measurements.made import NAMES, scattered

POINTS = scattered()
LOST = np.isnan(POINTS).any(axis=2)


@pytest.mark.parametrize("processor", get_args(Processor))
@pytest.mark.parametrize(("unit", "metres"), [("mm", 1e-3), ("cm", 1e-2), ("m", 1.0)])
def test_real_numbers_are_read_exactly(
    tmp_path: Path, processor: Processor, unit: str, metres: float
) -> None:
    file = tmp_path / "a.c3d"
    write_c3d(file, NAMES, POINTS, rate=60.0, unit=unit, processor=processor, first_frame=11)
    markers = read_c3d(file)
    np.testing.assert_array_equal(markers.positions, POINTS * metres)
    assert markers.names == NAMES
    assert markers.rows.tolist() == list(range(11, 51))
    np.testing.assert_array_equal(markers.time, np.arange(40) / 60.0)


@pytest.mark.parametrize("processor", get_args(Processor))
def test_scaled_integers_are_read_exactly(tmp_path: Path, processor: Processor) -> None:
    file = tmp_path / "a.c3d"
    write_c3d(file, NAMES, POINTS, rate=120.0, processor=processor, scale=0.125)
    markers = read_c3d(file)
    np.testing.assert_array_equal(markers.positions, POINTS * (1e-3 * 0.125) / 0.125)
    assert markers.rate == pytest.approx(120.0, rel=1e-12)


@pytest.mark.parametrize("processor", get_args(Processor))
@pytest.mark.parametrize("scale", [-0.125, 0.125])
def test_residuals_and_lost_points(tmp_path: Path, processor: Processor, scale: float) -> None:
    residuals = np.round(np.random.default_rng(2).uniform(0.0, 3.0, LOST.shape) * 8.0) / 8.0
    file = tmp_path / "a.c3d"
    write_c3d(file, NAMES, POINTS, rate=60.0, processor=processor, scale=scale, residuals=residuals)
    markers = read_c3d(file)
    assert markers.residuals is not None
    np.testing.assert_array_equal(markers.missing("BASE1"), LOST[:, 1])
    np.testing.assert_allclose(markers.residuals[~LOST], 1e-3 * residuals[~LOST], rtol=1e-15)
    assert np.isnan(markers.residuals[LOST]).all()


@pytest.mark.parametrize("rate", [50.0, 59.94, 60.0, 100.0, 240.0, 1000.0])
def test_point_rates(tmp_path: Path, rate: float) -> None:
    file = tmp_path / "a.c3d"
    write_c3d(file, NAMES, POINTS, rate=rate)
    assert read_c3d(file).rate == pytest.approx(float(np.float32(rate)), rel=1e-12)


def test_a_file_by_the_library_c3d(tmp_path: Path) -> None:
    c3d = pytest.importorskip("c3d")
    with warnings.catch_warnings():  # it warns of what it does not find in the file that it makes
        warnings.simplefilter("ignore")
        writer = c3d.Writer(point_rate=100.0, analog_rate=200.0)
        writer.set_point_labels(list(NAMES))
        writer.set_analog_labels(["V"])
        for frame in POINTS:
            four = np.concatenate([np.nan_to_num(frame), np.where(np.isnan(frame[:, :1]), -1.0, 0.0)], axis=1)
            five = np.concatenate([four, np.zeros((3, 1))], axis=1)
            writer.add_frames([(five, np.array([[1.0, 2.0]]))])
        with (tmp_path / "a.c3d").open("wb") as file:
            writer.write(file)
    markers = read_c3d(tmp_path / "a.c3d", unit="mm")
    np.testing.assert_array_equal(markers.positions, POINTS * 1e-3)
    assert markers.names == NAMES
    assert markers.rate == pytest.approx(100.0)


def test_a_file_by_the_library_ezc3d(tmp_path: Path) -> None:
    ezc3d = pytest.importorskip("ezc3d")
    file = ezc3d.c3d()
    file["parameters"]["POINT"]["RATE"]["value"] = [240.0]
    file["parameters"]["POINT"]["LABELS"]["value"] = list(NAMES)
    file["parameters"]["POINT"]["UNITS"]["value"] = ["mm"]
    file["parameters"]["ANALOG"]["RATE"]["value"] = [480.0]
    file["parameters"]["ANALOG"]["LABELS"]["value"] = ["V"]
    file["data"]["points"] = np.concatenate([POINTS.transpose(2, 1, 0), np.ones((1, 3, 40))])
    file["data"]["analogs"] = np.arange(80.0).reshape(1, 1, 80)
    file.write(str(tmp_path / "a.c3d"))
    markers = read_c3d(tmp_path / "a.c3d")
    np.testing.assert_array_equal(markers.positions, POINTS * 1e-3)
    assert markers.rate == pytest.approx(240.0)


@pytest.mark.parametrize("scale", [-1.0, 0.125])
def test_a_file_that_is_cut_off_says_which_frames_are_missing(tmp_path: Path, scale: float) -> None:
    file = tmp_path / "a.c3d"
    write_c3d(file, NAMES, POINTS, rate=60.0, scale=scale)
    whole = file.read_bytes()
    file.write_bytes(whole[:-1])
    with pytest.raises(RecordError, match=r"row 40: is cut off: it declares 40 frames and has 39 .*again"):
        read_c3d(file)
    file.write_bytes(whole[:700])
    with pytest.raises(RecordError, match="ends within its parameters"):
        read_c3d(file)
    file.write_bytes(whole[:80])
    with pytest.raises(RecordError, match="ends within its header"):
        read_c3d(file)


def test_frames_beyond_the_largest_number_of_them_are_not_lost_in_silence(tmp_path: Path) -> None:
    file = tmp_path / "a.c3d"
    write_c3d(file, ["TOP"], np.zeros((65_535, 1, 3)), rate=60.0)
    assert len(read_c3d(file).time) == 65_535
    with file.open("ab") as more:  # 4465 frames of one point
        more.write(bytes(4465 * 16))
    with pytest.raises(RecordError, match=r"row 65536: continues after the 65535 frames .*shorter"):
        read_c3d(file)


def test_a_number_of_frames_that_contradicts_the_header_is_refused(tmp_path: Path) -> None:
    """A flipped bit in POINT:FRAMES would drop frames."""
    file = tmp_path / "a.c3d"
    write_c3d(file, ["TOP"], np.arange(900.0).reshape(300, 1, 3), rate=60.0)
    data = bytearray(file.read_bytes())
    place = data.index(b"FRAMES") + 6 + 2 + 1 + 1  # offset, type, number of dimensions
    assert int.from_bytes(data[place : place + 2], "little") == 300
    data[place : place + 2] = (268).to_bytes(2, "little")
    file.write_bytes(data)
    with pytest.raises(RecordError, match=r"row 269: declares 268 frames, but 300 in its header"):
        read_c3d(file)


@pytest.mark.parametrize(
    ("place", "number", "message"),
    [
        (20, 30.0, "has two frame rates: 60 Hz, and 30 Hz in its header"),
        (12, 1.0, "has two scales of points: -1, and 1 in its header"),
    ],
)
def test_another_number_in_the_header_is_refused(
    place: int, number: float, message: str, tmp_path: Path
) -> None:
    file = tmp_path / "a.c3d"
    write_c3d(file, ["TOP"], np.arange(900.0).reshape(300, 1, 3), rate=60.0)
    data = bytearray(file.read_bytes())
    data[place : place + 4] = np.array([number], dtype="<f4").tobytes()
    file.write_bytes(data)
    with pytest.raises(RecordError, match=message):
        read_c3d(file)


def test_what_is_no_c3d_file_is_refused(tmp_path: Path) -> None:
    file = tmp_path / "a.c3d"
    file.write_text("time,theta\n", encoding="utf-8")
    with pytest.raises(RecordError, match=r"a\.c3d: is not a C3D file"):
        read_c3d(file)
    with pytest.raises(RecordError, match=r"b\.c3d: cannot be read: No such file"):
        read_c3d(tmp_path / "b.c3d")


@pytest.mark.parametrize(
    ("unit", "words"), [("furlong", "an unknown unit .found 'furlong'"), (None, "no unit")]
)
def test_units_that_are_not_known_are_refused_unless_given(
    tmp_path: Path, unit: str | None, words: str
) -> None:
    file = tmp_path / "a.c3d"
    write_c3d(file, NAMES, POINTS, rate=60.0, unit=unit)
    with pytest.raises(RecordError, match=f"'POINT:UNITS': has {words}") as caught:
        read_c3d(file)
    assert "known are m, cm, mm" in str(caught.value)
    np.testing.assert_array_equal(read_c3d(file, unit="cm").positions, POINTS * 1e-2)


def test_a_missing_rate_and_a_foreign_processor_are_refused(tmp_path: Path) -> None:
    file = tmp_path / "a.c3d"
    write_c3d(file, NAMES, POINTS, rate=0.0)
    with pytest.raises(RecordError, match=r"POINT:RATE.*no frame rate"):
        read_c3d(file)
    data = bytearray(file.read_bytes())
    data[512 + 3] = 87
    file.write_bytes(data)
    with pytest.raises(RecordError, match=r"processor.*\(found 87\)"):
        read_c3d(file)


@settings(max_examples=150, deadline=None)
@given(changes=st.lists(st.tuples(st.integers(0, 1535), st.integers(0, 255)), min_size=1, max_size=4))
def test_damage_to_a_file_is_refused_or_harmless(changes: list[tuple[int, int]]) -> None:
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "a.c3d"
        write_c3d(file, NAMES, POINTS, rate=60.0)
        data = bytearray(file.read_bytes())
        for place, value in changes:
            data[place] = value
        file.write_bytes(data)
        with contextlib.suppress(RecordError):
            markers = read_c3d(file)
            assert markers.positions.shape == (len(markers.time), len(markers.names), 3)
