"""Markers from C3D files, with frames of reals or scaled integers."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Final

import numpy as np

from pyjoystick.laboratory.measurements.c3d_parameters import BLOCK, C3dHead, read_c3d_head
from pyjoystick.laboratory.measurements.markers import Markers, length_factor
from pyjoystick.motion import RecordError
from pyjoystick.support import FloatArray

_DAMAGED: Final = "is the file damaged? Export it again"
#: Relative difference of two frame rates that are meant to be one.
_SAME_RATE: Final = 0.01
#: Largest frame number that fits into one word.
_LAST_FRAME: Final = 0xFFFF
#: In a point's fourth word, the lower byte is the residual and the upper one a mask of the cameras.
_RESIDUAL: Final = 0xFF


def read_c3d(path: Path, *, unit: str | None = None) -> Markers:
    """Read the marker trajectories of a C3D file; analog channels are ignored.

    Args:
        path: the file
        unit: unit of the coordinates, overriding POINT:UNITS

    Returns:
        the markers; points with a negative residual, which marks points that were not seen, are NaN.
        `rows` are the frame numbers; time is zero at the first frame.

    Raises:
        RecordError: the file cannot be read, is not a C3D file or is damaged, has fewer frames than it
            declares or more than it can declare, no points, no rate or no known unit
    """
    source = str(path)
    try:
        data = path.read_bytes()
    except OSError as error:
        reason = f"cannot be read: {error.strerror}"
        raise RecordError(source, reason, "check the path and its permissions") from error
    head = read_c3d_head(source, data)
    points = int(head.value("POINT:USED", head.header[1]))
    labels = _labels(head, points)
    column = "POINT:UNITS"
    factor = length_factor(source, unit or " ".join(head.texts(column)[:1]), column)
    rate = _rate(head)
    frames = head.frame_count()
    first = head.header[3]
    values = _frames(head, data, points, frames, first)
    scale = abs(_scale(head))
    fourth = np.clip(np.nan_to_num(values[:, :, 3], nan=-1.0), -1.0, 0x7FFF).astype(np.int32)
    unseen = (fourth < 0) | np.isnan(values[:, :, :3]).any(axis=2)
    positions = values[:, :, :3] * (factor if _scale(head) < 0.0 else factor * scale)
    positions[unseen] = np.nan
    residuals = np.where(unseen, np.nan, (fourth & _RESIDUAL) * scale * factor)
    rows = np.arange(first, first + frames, dtype=np.int64)
    return Markers(source, labels, np.arange(frames) / rate, positions, residuals, rows)


def _labels(head: C3dHead, points: int) -> tuple[str, ...]:
    """Names of the points in the frames; there may be more labels than points, but not fewer."""
    labels = head.texts("POINT:LABELS")
    if points < 1:
        advice = "reconstruct and label the markers before the export"
        raise RecordError(head.source, "has no points", advice, column="POINT:USED", value=points)
    if len(labels) < points:
        reason = f"has {len(labels)} labels for {points} points"
        raise RecordError(head.source, reason, "label every marker", column="POINT:LABELS")
    return tuple(labels[:points])


def _rate(head: C3dHead) -> float:
    rate = head.value("POINT:RATE", head.header_rate)
    if not (math.isfinite(rate) and rate > 0.0):
        advice = "a rate in Hz is needed: export the file again"
        raise RecordError(head.source, "has no frame rate", advice, column="POINT:RATE", value=rate)
    other = head.header_rate
    if math.isfinite(other) and other > 0.0 and abs(other / rate - 1.0) > _SAME_RATE:
        reason = f"has two frame rates: {rate:.6g} Hz, and {other:.6g} Hz in its header"
        raise RecordError(head.source, reason, _DAMAGED, column="POINT:RATE")
    return rate


def _scale(head: C3dHead) -> float:
    """Scale of integers, in the file's unit; negative if the frames contain reals."""
    scale = head.value("POINT:SCALE", head.header_scale)
    if not math.isfinite(scale) or scale == 0.0:
        raise RecordError(head.source, "has no scale of points", _DAMAGED, column="POINT:SCALE", value=scale)
    if math.isfinite(head.header_scale) and head.header_scale * scale < 0.0:
        reason = f"has two scales of points: {scale:.6g}, and {head.header_scale:.6g} in its header"
        raise RecordError(head.source, reason, _DAMAGED, column="POINT:SCALE")
    return scale


def _frames(head: C3dHead, data: bytes, points: int, frames: int, first: int) -> FloatArray:
    """The four words of each point, shape (frames, points, 4)."""
    real = _scale(head) < 0.0
    size = 4 if real else 2
    words = 4 * points + head.header[2]
    start = (int(head.value("POINT:DATA_START", head.header[8])) - 1) * BLOCK
    if frames < 1 or start < BLOCK:
        reason = f"declares {frames} frames from byte {start}, which is impossible"
        raise RecordError(head.source, reason, _DAMAGED)
    present = max(len(data) - start, 0) // (words * size)
    if present < frames:
        raise RecordError(
            head.source,
            f"is cut off: it declares {frames} frames and has {present}",
            "copy or export the file again",
            rows=range(first + present, first + frames),
            value=f"{len(data)} bytes, {start + frames * words * size} needed",
        )
    if frames < head.frames_in_header <= present and head.header[4] != _LAST_FRAME:
        raise RecordError(
            head.source,
            f"declares {frames} frames, but {head.frames_in_header} in its header, and has them",
            _DAMAGED,
            column="POINT:FRAMES",
            rows=[first + frames],
        )
    end = start + frames * words * size
    clipped = _LAST_FRAME in (frames, first + frames - 1) and head.value("ROTATION:USED", 0.0) == 0.0
    if clipped and len(data) - end >= BLOCK:
        raise RecordError(
            head.source,
            f"continues after the {frames} frames that it declares: their count ends at {_LAST_FRAME}",
            "export a shorter record, or one with its last frame in TRIAL:ACTUAL_END_FIELD",
            column="POINT:FRAMES",
            rows=[first + frames],
        )
    body = data[start:end]
    numbers = head.numbers.reals(body) if real else head.numbers.integers(body).astype(np.float64)
    return numbers.reshape(frames, words)[:, : 4 * points].reshape(frames, points, 4)
