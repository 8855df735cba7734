"""The properties of a shared library that can be read without loading it, for any format."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class SharedLibrary:
    """`name` is what the library calls itself, `needed` what it asks the system for besides itself."""

    processor: str
    name: str
    needed: frozenset[str]
    exports: frozenset[str]
    search_paths: tuple[str, ...] = ()
    debug_information: tuple[str, ...] = ()
    """Names of the sections or entries that hold some."""
    oldest_system: tuple[int, ...] = ()
    """The version of glibc, Windows or macOS that it needs at least."""
    signed: bool = False


def text_at(data: bytes, offset: int) -> str:
    """The text that ends with a zero byte."""
    return data[offset : data.index(b"\0", offset)].decode()
