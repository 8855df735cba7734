"""Header and parameters of a C3D file (c3d.org), in the number formats of its three processors.

A file has a header of one block of 512 bytes, a section of parameters in groups, and the frames. A byte at
the start of the parameters determines the format of all numbers: as on Intel (little-endian), MIPS
(big-endian) or DEC machines (little-endian integers, F_floating reals).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from pyjoystick.motion import RecordError
from pyjoystick.support import FloatArray

BLOCK: Final = 512
_MAGIC: Final = 0x50
_INTEL: Final = 84
_DEC: Final = 85
_MIPS: Final = 86
_CHARACTERS: Final = -1
_BYTES: Final = 1
_INTEGERS: Final = 2
_REALS: Final = 4


@dataclass(frozen=True, slots=True)
class NumberFormat:
    """Number format of a processor; raises RecordError if its code is not one of the three."""

    source: str
    processor: int

    def __post_init__(self) -> None:
        if self.processor not in (_INTEL, _DEC, _MIPS):
            raise RecordError(
                self.source,
                "has a processor that C3D does not know",
                "known are 84 (Intel), 85 (DEC) and 86 (MIPS); is the file damaged?",
                column="processor",
                value=self.processor,
            )

    def integers(self, data: bytes) -> np.ndarray[tuple[int], np.dtype[np.int16]]:
        """Signed 16-bit integers."""
        return np.frombuffer(data, dtype=">i2" if self.processor == _MIPS else "<i2").astype(np.int16)

    def words(self, data: bytes) -> list[int]:
        """Unsigned 16-bit integers."""
        return [int(value) % 0x10000 for value in self.integers(data)]

    def reals(self, data: bytes) -> FloatArray:
        """32-bit reals. F_floating has its two words exchanged and is a quarter of the IEEE value."""
        with np.errstate(invalid="ignore"):  # signaling NaN
            if self.processor == _DEC:
                words = np.frombuffer(data, dtype="<u2").reshape(-1, 2)[:, ::-1]
                return np.ascontiguousarray(words).view("<f4").ravel().astype(np.float64) / 4.0
            order = ">f4" if self.processor == _MIPS else "<f4"
            return np.frombuffer(data, dtype=order).astype(np.float64)


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter as stored: type code, dimensions (first one fastest), bytes."""

    code: int
    dimensions: tuple[int, ...]
    data: bytes

    def texts(self) -> list[str]:
        """Strings; the first dimension is their length."""
        width = self.dimensions[0] if self.dimensions else 1
        count = len(self.data) // width if width else 0
        pieces = [self.data[i * width : (i + 1) * width] for i in range(count)]
        return [piece.decode("latin-1").strip("\0 ") for piece in pieces]

    def numbers(self, numbers: NumberFormat) -> list[float]:
        """Numbers of any type; 16-bit integers are unsigned, as required for frame counts."""
        if self.code == _REALS:
            return [float(value) for value in numbers.reals(self.data)]
        if self.code == _INTEGERS:
            return [float(value) for value in numbers.words(self.data)]
        return [float(value) for value in self.data]


@dataclass(frozen=True, slots=True)
class C3dHead:
    """Everything before the frames.

    Attributes:
        source: the file
        numbers: its number format
        header: the 256 words of the header, unsigned
        header_scale, header_rate: scale of the points and frame rate (Hz), from the header
        parameters: by group and name in capitals: ``POINT:RATE``
    """

    source: str
    numbers: NumberFormat
    header: list[int]
    header_scale: float
    header_rate: float
    parameters: Mapping[str, Parameter]

    def texts(self, name: str) -> list[str]:
        """Strings of a parameter and of its continuations (LABELS2, LABELS3, ...); empty if there is none."""
        found: list[str] = []
        for suffix in ("", *(str(i) for i in range(2, 100))):
            parameter = self.parameters.get(name + suffix)
            if parameter is None:
                break
            found += parameter.texts()
        return found

    def value(self, name: str, default: float) -> float:
        """First number of a parameter, or the default."""
        parameter = self.parameters.get(name)
        values = parameter.numbers(self.numbers) if parameter else []
        return values[0] if values else default

    def frame_count(self) -> int:
        """Number of frames: a large one is in two words of TRIAL or in a real, otherwise in one word."""
        limits = [self.parameters.get(f"TRIAL:ACTUAL_{end}_FIELD") for end in ("START", "END")]
        if all(limits):
            words = [limit.numbers(self.numbers) for limit in limits if limit]
            if all(len(pair) == 2 for pair in words):
                first, last = (int(low) + 0x10000 * int(high) for low, high in words)
                return last - first + 1
        return int(self.value("POINT:LONG_FRAMES", self.value("POINT:FRAMES", self.frames_in_header)))

    @property
    def frames_in_header(self) -> int:
        """Number of frames by the header, whose words end at 65535."""
        return self.header[4] - self.header[3] + 1


def read_c3d_head(source: str, data: bytes) -> C3dHead:
    """Parse header and parameters from the bytes of a file.

    Raises:
        RecordError: it is not a C3D file, is of an unknown processor, or ends before the parameters do
    """
    if len(data) < 2 or data[1] != _MAGIC:
        raise RecordError(source, "is not a C3D file", "its second byte must be 80; export it again as C3D")
    start = (data[0] - 1) * BLOCK
    if len(data) < max(start + 4, BLOCK):
        raise _truncated(source, "header", len(data))
    numbers = NumberFormat(source, data[start + 3])
    end = start + data[start + 2] * BLOCK
    if len(data) < end:
        raise _truncated(source, "parameters", len(data))
    return C3dHead(
        source,
        numbers,
        numbers.words(data[:BLOCK]),
        float(numbers.reals(data[12:16])[0]),
        float(numbers.reals(data[20:24])[0]),
        _parameters(source, numbers, data[start + 4 : end]),
    )


def _truncated(source: str, part: str, size: int) -> RecordError:
    advice = "copy or export the file again"
    return RecordError(source, f"ends within its {part}", advice, value=f"{size} bytes")


def _parameters(source: str, numbers: NumberFormat, data: bytes) -> dict[str, Parameter]:
    """Parameters by group and name; a group may come after its parameters."""
    groups: dict[int, str] = {}
    found: list[tuple[int, str, Parameter]] = []
    place = 0
    while place + 2 <= len(data) and data[place] != 0:
        length, group = np.frombuffer(data[place : place + 2], dtype=np.int8).tolist()
        name = data[place + 2 : place + 2 + abs(length)].decode("latin-1").strip().upper()
        place += 2 + abs(length)
        body = data[place + 2 :]
        step = numbers.words(data[place : place + 2])
        if group < 0:
            groups[-group] = name
        elif len(body) >= 2:
            found.append((group, name, _parameter(source, name, body)))
        if not step or step[0] == 0:
            break
        place += step[0]
    return {f"{groups.get(group, group)}:{name}": parameter for group, name, parameter in found}


def _parameter(source: str, name: str, body: bytes) -> Parameter:
    code = int(np.frombuffer(body[:1], dtype=np.int8)[0])
    dimensions = tuple(body[2 : 2 + body[1]])
    sizes = {_CHARACTERS: 1, _BYTES: 1, _INTEGERS: 2, _REALS: 4}
    if code not in sizes:
        advice = "is the file damaged? Export it again"
        raise RecordError(source, "has a type that C3D does not know", advice, column=name, value=code)
    size = sizes[code] * int(np.prod(dimensions, dtype=np.int64))
    data = body[2 + body[1] : 2 + body[1] + size]
    if len(data) < size:
        raise RecordError(source, "ends within this parameter", "export the file again", column=name)
    return Parameter(code, dimensions, data)
