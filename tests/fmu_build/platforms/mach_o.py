"""Reading macOS shared libraries, for one processor and universal."""

from __future__ import annotations

import hashlib
import struct
from collections.abc import Iterator

from .shared_library import SharedLibrary, text_at

_PROCESSORS = {0x01000007: "x86_64", 0x0100000C: "aarch64"}
_SYMBOLS, _NEEDED, _OWN_NAME, _SEARCH_PATH, _SEGMENT, _SIGNATURE, _BUILD, _LINKING = (
    0x2, 0xC, 0xD, 0x8000001C, 0x19, 0x1D, 0x32, 0x80000022,
)  # fmt: skip
_DEBUG_SYMBOL = 0xE0  # bits of a symbol's type
_SIGNATURE_MAGIC, _DIRECTORY_MAGIC = 0xFADE0CC0, 0xFADE0C02
_AD_HOC = 2
_SHA256 = 2


def split_universal(data: bytes) -> list[bytes]:
    """The libraries for the single processors."""
    magic, count = struct.unpack_from(">II", data)
    assert magic == 0xCAFEBABE
    libraries = []
    for index in range(count):
        processor, _subtype, offset, size, alignment = struct.unpack_from(">IIIII", data, 8 + 20 * index)
        assert offset % (1 << alignment) == 0
        assert processor == struct.unpack_from("<I", data, offset + 4)[0]
        libraries.append(data[offset : offset + size])
    return libraries


def read_mach_o(data: bytes) -> SharedLibrary:
    """A 64-bit library for one processor."""
    magic, processor, _subtype, kind = struct.unpack_from("<IIII", data)
    assert (magic, kind) == (0xFEEDFACF, 6)
    commands = list(_commands(data))
    names = {code: [_text(command) for c, command in commands if c == code] for code in (_NEEDED, _OWN_NAME)}
    symbols = [symbol for code, command in commands if code == _SYMBOLS for symbol in _table(data, command)]
    ((exports, size),) = (
        struct.unpack_from("<II", command, 40) for code, command in commands if code == _LINKING
    )
    (system,) = (struct.unpack_from("<I", command, 12)[0] for code, command in commands if code == _BUILD)
    segments = [command[8:24].rstrip(b"\0").decode() for code, command in commands if code == _SEGMENT]
    debug = [name for name, kind in symbols if kind & _DEBUG_SYMBOL]
    return SharedLibrary(
        processor=_PROCESSORS[processor],
        name=names[_OWN_NAME][0],
        needed=frozenset(names[_NEEDED]),
        exports=frozenset(name.removeprefix("_") for name in _names(data[exports : exports + size])),
        search_paths=tuple(_text(command) for code, command in commands if code == _SEARCH_PATH),
        debug_information=(*debug, *(name for name in segments if "DWARF" in name)),
        oldest_system=(system >> 16, system >> 8 & 0xFF),
        signed=any(code == _SIGNATURE and _is_signed(data, command) for code, command in commands),
    )


def _commands(data: bytes) -> Iterator[tuple[int, bytes]]:
    (count,) = struct.unpack_from("<I", data, 16)
    position = 32
    for _ in range(count):
        code, size = struct.unpack_from("<II", data, position)
        yield code, data[position : position + size]
        position += size


def _text(command: bytes) -> str:
    return text_at(command, struct.unpack_from("<I", command, 8)[0])


def _table(data: bytes, command: bytes) -> Iterator[tuple[str, int]]:
    """Names and types of the symbols."""
    table, count, strings = struct.unpack_from("<III", command, 8)
    for index in range(count):
        name, kind = struct.unpack_from("<IB", data, table + 16 * index)
        yield text_at(data, strings + name), kind


def _names(trie: bytes, node: int = 0, prefix: str = "") -> Iterator[str]:
    """The exported names: a node says something of the name that ends there, if any, and has branches."""
    size, position = trie[node], node + 1
    assert size < 0x80, "sizes of more than one byte are not read"
    if size:
        yield prefix
    branches, position = trie[position + size], position + size + 1
    for _ in range(branches):
        label = text_at(trie, position)
        child, position = _number(trie, position + len(label) + 1)
        yield from _names(trie, child, prefix + label)


def _number(data: bytes, position: int) -> tuple[int, int]:
    """A number of seven bits a byte, the lowest first, and the position after it."""
    value = shift = 0
    while True:
        byte = data[position]
        value |= (byte & 0x7F) << shift
        shift += 7
        position += 1
        if byte < 0x80:
            return value, position


def _is_signed(data: bytes, command: bytes) -> bool:
    """Whether the file has an ad-hoc signature, with the right digest of every page before it."""
    offset, _size = struct.unpack_from("<II", command, 8)
    magic, _length, count, _kind, start = struct.unpack_from(">IIIII", data, offset)
    directory = offset + start
    assert (magic, count) == (_SIGNATURE_MAGIC, 1)
    fields = struct.unpack_from(">IIIIIIIIIBBBB", data, directory)
    magic, _, _, flags, digests, _, _, pages, end, size, kind, _, page_bits = fields
    assert (magic, kind, end) == (_DIRECTORY_MAGIC, _SHA256, offset)
    page = 1 << page_bits
    assert pages == -(-end // page)
    found = [data[directory + digests + size * i :][:size] for i in range(pages)]
    right = [hashlib.sha256(data[page * i : min(page * (i + 1), end)]).digest() for i in range(pages)]
    return bool(flags & _AD_HOC) and found == right
