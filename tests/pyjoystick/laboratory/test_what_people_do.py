"""Files as people really write them: refused at once, with file, position and what is allowed."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.cli import main
from pyjoystick.laboratory import Markers, fit_load_curve, read_accelerometer, read_load_curve, read_markers
from pyjoystick.laboratory.measurements.resampling import resample
from pyjoystick.model import FORWARD_TABLE
from pyjoystick.motion import RecordError, read_record
from pyjoystick.support import SeriesError
from tests.pyjoystick.laboratory.load_curve.machine import cycle
from tests.pyjoystick.laboratory.measurements.c3d_writer import write_c3d
from tests.pyjoystick.laboratory.measurements.made import NAMES, nexus_text, plain_text, swing, write

TIME = np.arange(180) / 60.0
POINTS = np.full((180, 3, 3), 1.5) + np.arange(180)[:, None, None] / 100.0


def _samples(scale: float, unit: str = "s") -> str:
    rows = (f"{scale * t:.9g},{np.degrees(a):.6g}" for t, a in zip(TIME, swing(TIME), strict=True))
    return "\n".join([f"time ({unit}),theta (deg)", *rows, ""])


@pytest.mark.parametrize(("scale", "found"), [(1e3, "16.6667 s"), (1e6, "16666.7 s")])
def test_times_in_ms_or_us_under_s(scale: float, found: str, tmp_path: Path) -> None:
    path = write(tmp_path / "record.csv", _samples(scale))
    with pytest.raises(RecordError, match=rf"'time', rows 2-3: .*found {found}\).* ms or us labeled as s"):
        read_record(path)
    with pytest.raises(RecordError, match="ms or us labeled as s"):
        read_markers(write(tmp_path / "markers.csv", plain_text(scale * TIME, POINTS)))
    rows = "".join(f"{scale * t},{i % 7}\n" for i, t in enumerate(TIME))
    with pytest.raises(RecordError, match="ms or us labeled as s"):
        read_accelerometer(write(tmp_path / "a.csv", f"time (s),acceleration (m/s2)\n{rows}"))


def test_the_same_times_under_their_own_unit(tmp_path: Path) -> None:
    record = read_record(write(tmp_path / "record.csv", _samples(1e3, "ms")))
    np.testing.assert_allclose(record.time, TIME, rtol=0.0, atol=1e-8)


@pytest.mark.parametrize("cell", ["inf", "-inf", "1e50"])
def test_a_coordinate_that_is_no_place(cell: str, tmp_path: Path) -> None:
    points = POINTS.copy()
    points[7, 1, 2] = float(cell)
    for text, marker, row in (
        (plain_text(TIME, points), "BASE1", 9),
        (nexus_text(points), "Joystick:BASE1", 18),
    ):
        with pytest.raises(RecordError, match=rf"column '{marker}', row {row}: is not within 1000 m"):
            read_markers(write(tmp_path / "markers.csv", text))
    points[7, 1, 2] = 1234.5
    path = tmp_path / "markers.c3d"
    write_c3d(path, NAMES, points, rate=60.0)
    number = max(min(float(cell), 3e38), -3e38) if cell == "1e50" else float(cell)
    path.write_bytes(path.read_bytes().replace(struct.pack("<f", 1234.5), struct.pack("<f", number)))
    with pytest.raises(RecordError, match=r"column 'BASE1', row 8: is not within 1000 m"):
        read_markers(path)


def test_a_coordinate_that_is_nan_is_not_seen(tmp_path: Path) -> None:
    points = POINTS.copy()
    points[7, 1] = np.nan
    assert read_markers(write(tmp_path / "a.csv", plain_text(TIME, points))).missing("BASE1").sum() == 1
    positions = POINTS / 1e3
    assert not Markers("arrays", NAMES, TIME, positions).missing("BASE1").any()


@pytest.mark.parametrize("column", ["travel", "force"])
def test_a_column_that_never_changes(column: str, tmp_path: Path) -> None:
    rows = ((0.2, i) if column == "travel" else (i / 100.0, 3.5) for i in range(90))
    text = "travel (mm),force (N)\n" + "".join(f"{x},{f}\n" for x, f in rows)
    with pytest.raises(RecordError, match=f"column '{column}': never changes"):
        read_load_curve(write(tmp_path / "curve.csv", text))


@pytest.mark.parametrize("number", ["1e61", "-1e300"])
def test_numbers_that_no_measurement_has(number: str, tmp_path: Path) -> None:
    lines = _samples(1.0).splitlines()
    lines[31] = f"0.5,{number}"
    with pytest.raises(RecordError, match=r"'theta \(deg\)', row 32: a number beyond 1e\+60"):
        read_record(write(tmp_path / "a.csv", "\n".join([*lines, ""])))


def test_one_wrong_time_does_not_fill_the_memory() -> None:
    time = np.append(TIME, 1e12)
    with pytest.raises(SeriesError, match=r"extends from 0 to 1e\+12 s, more than 10000000 samples"):
        resample(time, np.cos(time), 600.0, longest_gap=0.05)


def test_an_accelerometer_whose_time_stands_still(tmp_path: Path) -> None:
    rows = "".join(f"{min(i, 20) / 1e3},{i % 7}\n" for i in range(60))
    with pytest.raises(RecordError, match="row 23: the time does not increase"):
        read_accelerometer(write(tmp_path / "a.csv", f"time (s),acceleration (m/s2)\n{rows}"))


def test_samples_that_do_not_determine_the_segments(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    travel, force = cycle(FORWARD_TABLE, 6)
    rows = "".join(f"{1e3 * x:.6g},{f:.6g}\n" for x, f in zip(travel[::8], force[::8], strict=True))
    curve = read_load_curve(write(tmp_path / "curve.csv", f"travel (mm),force (N)\n{rows}"))

    def singular(matrix: object) -> None:
        raise np.linalg.LinAlgError("Singular matrix")

    monkeypatch.setattr("numpy.linalg.inv", singular)
    with pytest.raises(RecordError, match=r"curve\.csv: does not determine 4 segments; try fewer"):
        fit_load_curve(curve)


@pytest.mark.parametrize("head", [b"{'descr': '<f8', 'shape': (60,), ", b"{'descr': '<q9'", b"1" * 40])
def test_the_damaged_head_of_an_npy_file(head: bytes, tmp_path: Path) -> None:
    path = tmp_path / "a.npy"
    np.save(path, np.arange(60.0) % 7.0)
    content = path.read_bytes()
    path.write_bytes(content[:10] + head.ljust(118)[:118] + content[128:])
    with pytest.raises(RecordError, match=r"a\.npy: is not a \.npy file: "):
        read_accelerometer(path, rate=600.0, unit="m/s2")


@pytest.mark.parametrize("angle", [0.0, 5.0])
def test_an_accelerometer_beside_an_angle_that_never_changes(
    angle: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    rows = "".join(f"{t:.9g},{angle}\n" for t in TIME)
    write(Path("angle.csv"), f"time (s),theta (deg)\n{rows}")
    np.save("a.npy", np.arange(1800.0) % 7.0)
    options = ("--angle", "angle.csv", "--distance", "0.25", "--samples-per-second", "600", "--unit", "m/s2")
    assert main(["import", "accelerometer", "a.npy", *options]) == 1
    assert "a.npy: cannot be compared with an angle that never changes" in capsys.readouterr().err
