"""Text files with random changes are refused with a RecordError or read; nothing else happens."""

from __future__ import annotations

import contextlib
import tempfile
from pathlib import Path

import numpy as np
from hypothesis import given, settings, strategies as st

from pyjoystick.laboratory import read_accelerometer, read_markers
from pyjoystick.motion import RecordError
from tests.pyjoystick.laboratory.measurements.made import nexus_text, plain_text, write

POINTS = np.full((8, 3, 3), 1.5)
NEXUS = nexus_text(POINTS)
PLAIN = plain_text(np.arange(8) / 60.0, POINTS)
SAMPLES = "# made\ntime (s),acceleration (m/s2)\n" + "".join(f"{i / 1e3},{i % 5}\n" for i in range(30))
CHANGES = st.lists(
    st.tuples(
        st.integers(0, 2000),
        st.sampled_from(["", ",", ";", "\n", "\n\n", '"', "x", "-", "1e999", "nan", "#"]),
    ),
    min_size=1,
    max_size=5,
)


def _changed(text: str, changes: list[tuple[int, str]]) -> str:
    for place, new in changes:
        at = place % len(text)
        text = text[:at] + new + text[at + 1 :]
    return text


@settings(max_examples=120, deadline=None)
@given(changes=CHANGES, text=st.sampled_from([NEXUS, PLAIN]))
def test_damaged_markers(changes: list[tuple[int, str]], text: str) -> None:
    with tempfile.TemporaryDirectory() as folder, contextlib.suppress(RecordError):
        markers = read_markers(write(Path(folder) / "a.csv", _changed(text, changes)))
        assert markers.positions.shape == (len(markers.time), len(markers.names), 3)
        assert (np.diff(markers.time) > 0.0).all()


@settings(max_examples=120, deadline=None)
@given(changes=CHANGES, piece=st.sampled_from([7, 1000]))
def test_damaged_samples(changes: list[tuple[int, str]], piece: int) -> None:
    with tempfile.TemporaryDirectory() as folder, contextlib.suppress(RecordError):
        record = read_accelerometer(write(Path(folder) / "a.csv", _changed(SAMPLES, changes)), piece=piece)
        assert len(record.time) == len(record.acceleration) == record.samples
        assert np.isfinite(record.acceleration).all()
