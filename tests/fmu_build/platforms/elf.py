"""Reading Linux shared libraries."""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator
from typing import NamedTuple

from .shared_library import SharedLibrary, text_at

_PROCESSORS = {62: "x86_64", 183: "aarch64"}
_NEEDED, _SONAME, _RPATH, _RUNPATH = 1, 14, 15, 29
_UNDEFINED_SECTION = 0
_VERSION_NEEDS = 0x6FFFFFFE


class _Section(NamedTuple):
    name: str
    type: int
    content: bytes


def read_elf(data: bytes) -> SharedLibrary:
    """A little-endian 64-bit library; needs its section headers, which stripping leaves."""
    assert data[:7] == b"\x7fELF\x02\x01\x01"
    (machine,) = struct.unpack_from("<H", data, 18)
    sections = {section.name: section for section in _sections(data)}
    strings = sections[".dynstr"].content
    entries = list(struct.iter_unpack("<QQ", sections[".dynamic"].content))

    def texts(*tags: int) -> list[str]:
        return [text_at(strings, value) for tag, value in entries if tag in tags]

    return SharedLibrary(
        processor=_PROCESSORS[machine],
        name="".join(texts(_SONAME)),
        needed=frozenset(texts(_NEEDED)),
        exports=frozenset(_exports(sections[".dynsym"].content, strings)),
        search_paths=tuple(texts(_RPATH, _RUNPATH)),
        debug_information=tuple(name for name in sections if name.startswith((".debug", ".symtab"))),
        oldest_system=max(_versions(sections, strings)),
    )


def _sections(data: bytes) -> Iterator[_Section]:
    (table,) = struct.unpack_from("<Q", data, 40)
    size, count, names_index = struct.unpack_from("<HHH", data, 58)
    headers = [struct.unpack_from("<IIQQQQ", data, table + size * index) for index in range(count)]
    names = headers[names_index][4]
    for name, kind, _flags, _address, offset, length in headers:
        yield _Section(text_at(data, names + name), kind, data[offset : offset + length])


def _exports(symbols: bytes, strings: bytes) -> Iterator[str]:
    for name, _info, _visibility, section, _value, _size in struct.iter_unpack("<IBBHQQ", symbols):
        if name and section != _UNDEFINED_SECTION:
            yield text_at(strings, name)


def _versions(sections: dict[str, _Section], strings: bytes) -> Iterator[tuple[int, ...]]:
    """The versions of glibc that functions of the library are bound to."""
    for section in sections.values():
        if section.type == _VERSION_NEEDS:
            for match in re.finditer(rb"GLIBC_([\d.]+)\0", strings):
                yield tuple(map(int, match[1].split(b".")))
