from __future__ import annotations

import struct

import pytest

from pyjoystick.laboratory.measurements.c3d_parameters import C3dHead, NumberFormat, Parameter
from pyjoystick.motion import RecordError


def _head(**parameters: Parameter) -> C3dHead:
    """A head whose header says 100 frames."""
    header = [0, 3, 0, 1, 100] + [0] * 251
    named = {name.replace("__", ":"): parameter for name, parameter in parameters.items()}
    return C3dHead("made.c3d", NumberFormat("made.c3d", 84), header, -1.0, 60.0, named)


def _words(*values: int) -> Parameter:
    return Parameter(2, (len(values),), struct.pack(f"<{len(values)}H", *values))


def test_the_number_of_frames_is_taken_from_where_a_long_record_has_it() -> None:
    assert _head().frame_count() == 100
    assert _head(POINT__FRAMES=_words(60_000)).frame_count() == 60_000
    real = Parameter(4, (), struct.pack("<f", 90_000.0))
    assert _head(POINT__FRAMES=real).frame_count() == 90_000
    assert _head(POINT__FRAMES=_words(65_535), POINT__LONG_FRAMES=real).frame_count() == 90_000
    trial = _head(
        POINT__FRAMES=_words(65_535),
        TRIAL__ACTUAL_START_FIELD=_words(1, 0),
        TRIAL__ACTUAL_END_FIELD=_words(4464, 1),
    )
    assert trial.frame_count() == 70_000


def test_labels_go_on_in_further_parameters() -> None:
    head = _head(
        POINT__LABELS=Parameter(-1, (4, 2), b"TOP BASE"), POINT__LABELS2=Parameter(-1, (3, 1), b"ARM")
    )
    assert head.texts("POINT:LABELS") == ["TOP", "BASE", "ARM"]


def test_numbers_of_three_processors() -> None:
    assert NumberFormat("a", 84).reals(struct.pack("<f", -12.5)).tolist() == [-12.5]
    assert NumberFormat("a", 86).reals(struct.pack(">f", -12.5)).tolist() == [-12.5]
    # F_floating 1.0: exponent 129 over 128, in the first word of two.
    assert NumberFormat("a", 85).reals(bytes([0x80, 0x40, 0, 0])).tolist() == [1.0]
    assert NumberFormat("a", 86).words(b"\xff\xfe") == [65_534]
    with pytest.raises(RecordError, match=r"known are 84 .Intel., 85 .DEC. and 86 .MIPS"):
        NumberFormat("a", 83)
