"""Conversion of values as an FMU stores them to double precision."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.stepping.program import BOOLEAN, FLOAT32, FLOAT64, SIGNED, TEXT, Group
from pyjoystick.support import FloatArray

_TWO_TO_32 = np.int64(2**32)


def decode(
    outputs: Sequence[Group],
    columns: Sequence[int] | NDArray[np.intp],
    raw: NDArray[np.uint8],
    stride: int,
    samples: FloatArray,
) -> None:
    """Fill `samples`, shape (samples, variables), from rows of `stride` bytes; texts are skipped."""
    doubles, floats = raw.view(np.float64), raw.view(np.float32)
    done = 0
    for i in range(len(outputs)):
        kind, size = outputs[i].kind, _size(outputs[i].kind)
        for j in range(outputs[i].size):
            place = outputs[i].offset + j * size
            column = columns[done + j]
            if column < 0 or kind == TEXT:
                continue
            for row in range(len(samples)):
                if kind == FLOAT64:
                    samples[row, column] = doubles[place // 8]
                elif kind == FLOAT32:
                    samples[row, column] = floats[place // 4]
                else:
                    number = _whole_number(raw, place, size, kind % 4 == SIGNED)
                    samples[row, column] = (1.0 if number != 0.0 else 0.0) if kind % 4 == BOOLEAN else number
                place += stride
        done += outputs[i].size


def _size(kind: int) -> int:
    if kind == FLOAT64:
        return 8
    return 4 if kind == FLOAT32 else kind // 4


def _whole_number(raw: NDArray[np.uint8], place: int, size: int, is_signed: bool) -> float:
    """Integer of 1 to 8 bytes, little-endian; beyond 2^53 it is rounded once."""
    low = high = np.int64(0)
    for i in range(size):
        octet = np.int64(raw[place + i])
        if i < 4:
            low += octet << (8 * i)
        else:
            high += octet << (8 * (i - 4))
    if is_signed and raw[place + size - 1] >= 128:
        if size > 4:
            high -= _TWO_TO_32
        else:
            low -= np.int64(1) << (8 * size)
    return float(high) * float(_TWO_TO_32) + float(low)


#: Functions to compile, each after those that it calls.
FUNCTIONS = (_size, _whole_number, decode)
