"""Universal libraries of macOS: one file with the code for several processors."""

from __future__ import annotations

import struct
from collections.abc import Sequence

_MAGIC = 0xCAFEBABE
_HEADER = struct.Struct(">II")  # magic number, number of libraries
_ENTRY = struct.Struct(">IIIII")  # processor, its subtype, offset, size, alignment as a power of two
_ALIGNMENT = 14  # pages of 16 kB, those of aarch64


def universal_library(libraries: Sequence[bytes]) -> bytes:
    """The libraries, each for one processor, in one file; macOS loads the one that suits the process."""
    page = 1 << _ALIGNMENT
    content = bytearray(_HEADER.pack(_MAGIC, len(libraries)))
    offset = page
    for library in libraries:
        processor, subtype = struct.unpack_from("<II", library, 4)
        content += _ENTRY.pack(processor, subtype, offset, len(library), _ALIGNMENT)
        offset += -(-len(library) // page) * page
    for library in libraries:
        content += bytes(-len(content) % page) + library
    return bytes(content)
