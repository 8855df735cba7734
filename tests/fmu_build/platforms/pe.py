"""Reading Windows shared libraries."""

from __future__ import annotations

import struct
from collections.abc import Iterator

from .shared_library import SharedLibrary, text_at

_PROCESSORS = {0x8664: "x86_64", 0xAA64: "aarch64"}
_EXPORTS, _IMPORTS, _DEBUG = 0, 1, 6  # positions in the table of directories
_REPRODUCIBLE = 16  # kind of a debug entry: the time stamp is made from the content
_OPTIONAL_HEADER = 20  # size of the header before it


class _Image:
    """The file, read by the addresses that its parts have in memory."""

    def __init__(self, data: bytes, header: int) -> None:
        self.data = data
        (count,) = struct.unpack_from("<H", data, header + 2)
        (optional_size,) = struct.unpack_from("<H", data, header + 16)
        optional = header + _OPTIONAL_HEADER
        table = optional + optional_size
        self.sections = [struct.unpack_from("<8sIIII", data, table + 40 * i) for i in range(count)]
        self.directories = list(struct.iter_unpack("<II", data[optional + 112 : optional + 240]))
        self.oldest_system = struct.unpack_from("<HH", data, optional + 48)

    def position(self, address: int) -> int:
        for _name, size, start, _raw_size, raw in self.sections:
            if start <= address < start + size:
                return int(raw) + address - int(start)
        raise AssertionError(f"no section holds the address {address:#x}")

    def text(self, address: int) -> str:
        return text_at(self.data, self.position(address))


def read_pe(data: bytes) -> SharedLibrary:
    """A 64-bit library."""
    (start,) = struct.unpack_from("<I", data, 60)
    assert data[:2] == b"MZ"
    assert data[start : start + 4] == b"PE\0\0"
    header = start + 4
    machine, _sections, _timestamp, symbols = struct.unpack_from("<HHII", data, header)
    image = _Image(data, header)
    debug = [name.rstrip(b"\0").decode() for name, *_ in image.sections if name.startswith(b".debug")]
    debug += ["symbol table"] * bool(symbols)
    entries = struct.iter_unpack("<12xI12x", _block(image, *image.directories[_DEBUG]))
    debug += [f"debug entry {kind}" for (kind,) in entries if kind != _REPRODUCIBLE]
    exports = image.position(image.directories[_EXPORTS][0])
    name, count, names = struct.unpack_from("<I8xI4xI", data, exports + 12)
    return SharedLibrary(
        processor=_PROCESSORS[machine],
        name=image.text(name),
        needed=frozenset(_imports(image)),
        exports=frozenset(
            image.text(address) for (address,) in struct.iter_unpack("<I", _block(image, names, 4 * count))
        ),
        debug_information=tuple(debug),
        oldest_system=tuple(image.oldest_system),
    )


def _block(image: _Image, address: int, size: int) -> bytes:
    position = image.position(address)
    return image.data[position : position + size]


def _imports(image: _Image) -> Iterator[str]:
    position = image.position(image.directories[_IMPORTS][0])
    while True:
        *_, name, _functions = struct.unpack_from("<IIIII", image.data, position)
        if not name:
            return
        yield image.text(name).lower()
        position += 20
