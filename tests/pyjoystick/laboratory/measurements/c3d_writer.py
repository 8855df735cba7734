"""A small writer of C3D files, from the format's description alone: every processor and both kinds of data.

It shares nothing with the reader under test. A file is a header of 512 bytes, the parameters, and the frames:
four numbers a point, of which the fourth is below zero where the point was not seen.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Processor = Literal["intel", "dec", "mips"]
_CODES = {"intel": 84, "dec": 85, "mips": 86}
_BLOCK = 512


@dataclass(frozen=True)
class Writer:
    """How the numbers of a file are written."""

    processor: Processor = "intel"

    def integers(self, *values: int) -> bytes:
        order = ">" if self.processor == "mips" else "<"
        return struct.pack(
            f"{order}{len(values)}h", *((value + 0x8000) % 0x10000 - 0x8000 for value in values)
        )

    def floats(self, values: Sequence[float] | NDArray[np.float64]) -> bytes:
        numbers = np.asarray(values, dtype=np.float32)
        if self.processor == "mips":
            return numbers.astype(">f4").tobytes()
        if self.processor == "intel":
            return numbers.astype("<f4").tobytes()
        # F_floating of the VAX: a quarter of the value for the same bits, and the words exchanged.
        words = (numbers * np.float32(4.0)).astype("<f4").view("<u2").reshape(-1, 2)
        return words[:, ::-1].tobytes()

    def array(self, values: NDArray[np.int16]) -> bytes:
        return values.astype(">i2" if self.processor == "mips" else "<i2").tobytes()

    def group(self, number: int, name: str) -> bytes:
        return struct.pack("bb", len(name), -number) + name.encode() + self.integers(3) + b"\0"

    def parameter(self, group: int, name: str, code: int, dimensions: Sequence[int], data: bytes) -> bytes:
        body = struct.pack(f"bB{len(dimensions)}B", code, len(dimensions), *dimensions) + data + b"\0"
        head = struct.pack("bb", len(name), group) + name.encode()
        return head + self.integers(len(body) + 2) + body


def write_c3d(
    path: Path,
    names: Sequence[str],
    points: NDArray[np.float64],
    *,
    rate: float,
    unit: str | None = "mm",
    processor: Processor = "intel",
    scale: float = -1.0,
    residuals: NDArray[np.float64] | None = None,
    first_frame: int = 1,
) -> None:
    """Write points of shape (frames, markers, 3); NaN is a point that was not seen.

    Args:
        path: the file
        names: of the markers
        points: coordinates in the unit of the file
        rate: frames a second (Hz)
        unit: what POINT:UNITS says, None for a file without it
        processor: the order of bytes
        scale: above 0, integers times this are written; below 0, real numbers
        residuals: of each point, in the unit of the file, shape (frames, markers)
        first_frame: number of the first frame
    """
    writer = Writer(processor)
    frames, count, _ = points.shape
    width = max(map(len, names))
    labels = "".join(name.ljust(width) for name in names).encode()
    parameters = [
        writer.group(1, "POINT"),
        writer.parameter(1, "USED", 2, (), writer.integers(count)),
        writer.parameter(1, "FRAMES", 2, (), writer.integers(frames)),
        writer.parameter(1, "SCALE", 4, (), writer.floats([scale])),
        writer.parameter(1, "RATE", 4, (), writer.floats([rate])),
        writer.parameter(1, "LABELS", -1, (width, count), labels),
    ]
    if unit is not None:
        parameters.append(writer.parameter(1, "UNITS", -1, (len(unit),), unit.encode()))
    parameters.append(writer.group(2, "ANALOG"))
    parameters.append(writer.parameter(2, "USED", 2, (), writer.integers(0)))
    section = b"".join(parameters)
    blocks = -(-(len(section) + 6) // _BLOCK)
    start = 2 + blocks
    # DATA_START takes 19 bytes, which the spare bytes of a section may not have: it is counted in.
    data_start = writer.parameter(1, "DATA_START", 2, (), writer.integers(start))
    if len(section) + len(data_start) + 6 > blocks * _BLOCK:
        blocks += 1
        data_start = writer.parameter(1, "DATA_START", 2, (), writer.integers(start + 1))
    section += data_start
    header = struct.pack("BB", 2, 0x50) + writer.integers(count, 0, first_frame, first_frame + frames - 1, 0)
    header += writer.floats([scale]) + writer.integers(2 + blocks, 0) + writer.floats([rate])
    with path.open("wb") as file:
        file.write(header.ljust(_BLOCK, b"\0"))
        file.write(
            (struct.pack("BBBB", 1, 0x50, blocks, _CODES[processor]) + section).ljust(blocks * _BLOCK, b"\0")
        )
        file.write(_frames(writer, points, residuals, scale))


def _frames(
    writer: Writer, points: NDArray[np.float64], residuals: NDArray[np.float64] | None, scale: float
) -> bytes:
    unseen = np.isnan(points).any(axis=2)
    fourth = np.zeros(unseen.shape) if residuals is None else np.round(residuals / abs(scale))
    fourth[unseen] = -1.0
    values = np.concatenate([np.nan_to_num(points), fourth[:, :, None]], axis=2)
    if scale < 0.0:
        return writer.floats(values.ravel())
    values[:, :, :3] = np.round(values[:, :, :3] / scale)
    return writer.array(values.astype(np.int16).ravel())
