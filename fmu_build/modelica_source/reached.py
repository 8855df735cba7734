"""The part of large libraries that a model can reach, found without reading the rest.

A compiler that reads the whole Modelica Standard Library for one model spends most of a build on classes that
the model never names. A name refers to a class only through words of the text: every part of it is declared
in an enclosing scope, in a package that is named, or in a base class that is named. So it suffices to keep
the classes whose simple name is a word of a class that is kept, and that are declared in one that is kept;
beside those that the language uses without a name, such as constructors. This is more than the model needs,
and never less.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from fmu_build.modelica_source.text import blanked, declarations

IN_MEMORY = "reached:"
"""Stands before the path of a file whose text the compiler was handed: it then reads no files beside it."""

_WORD = re.compile(r"'(?:[^'\\\n]|\\.)*'|[A-Za-z_]\w*")
_PREFIXES = re.compile(
    r"(?:\b(?:final|redeclare|replaceable|encapsulated|partial|expandable|pure|impure|operator)\s+)+\Z"
)
_IMPLICIT = frozenset(
    (
        "constructor",
        "destructor",
        "equalityConstraint",
        "'constructor'",
        "'String'",
        "'0'",
        "'not'",
        "'and'",
        "'or'",
    )
).union(f"'{operator}'" for operator in ("+", "-", "*", "/", "^", "==", "<>", "<", "<=", ">", ">="))
"""Classes that the language uses without their name."""

_PREFIXES_AT_MOST = 100
"""Characters before a class in which its prefixes are looked for."""


@dataclass(frozen=True, slots=True)
class SourceClass:
    """A class in the text of a file, or in a file of its own that has not been read (`span` is None)."""

    name: str
    file: Path
    kind: str = ""
    """Its restriction, such as "partial model"."""
    span: tuple[int, int] | None = None
    words: frozenset[str] = frozenset()
    """The words of its text outside its inner classes."""


class ReachedSource:
    """The classes that a model can reach in libraries, and the texts of their files without the others."""

    classes: dict[str, SourceClass]
    """By qualified name."""
    texts: dict[Path, str]
    """The files, with spaces in place of the classes that cannot be reached: lines and columns are kept."""

    def __init__(self, model: str, roots: Mapping[str, Path], read: Callable[[Path], str]) -> None:
        """Find what the model reaches.

        Args:
            model: qualified class name.
            roots: package folders or files by their top-level class.
            read: returns the text of a file; what it raises propagates.
        """
        self.classes, self.texts = {}, {}
        self._read_text = read
        self._inner: dict[str, list[SourceClass]] = defaultdict(list)
        self._words: set[str] = set()
        self._unnamed: dict[str, list[SourceClass]] = defaultdict(list)
        waiting = self._named(_IMPLICIT.union(model.split(".")))
        waiting += self._offered(SourceClass(name, path) for name, path in roots.items())
        while waiting:
            waiting += self._keep(waiting.pop())
        self._blank_the_rest()

    def _keep(self, kept: SourceClass) -> list[SourceClass]:
        """Keep a class; return those that are now both named and declared in a kept one."""
        if kept.span is None:
            return self._read(kept)
        self.classes.setdefault(kept.name, kept)
        return [*self._named(kept.words), *self._offered(self._inner.pop(kept.name, ()))]

    def _named(self, words: frozenset[str]) -> list[SourceClass]:
        """Take note of words; return the classes that were waiting for them."""
        new = words - self._words
        self._words |= new
        return [found for word in sorted(new) for found in self._unnamed.pop(word, ())]

    def _offered(self, declared: Iterable[SourceClass]) -> list[SourceClass]:
        """Return those of the classes that are named; the others wait."""
        named: list[SourceClass] = []
        for found in declared:
            simple = found.name.rpartition(".")[2]
            (named if simple in self._words else self._unnamed[simple]).append(found)
        return named

    def _read(self, whole: SourceClass) -> list[SourceClass]:
        """Read the file of a class, and see what lies beside it if it is a package folder."""
        is_folder = whole.file.is_dir()
        file = whole.file / "package.mo" if is_folder else whole.file
        children = filter(_holds_class, sorted(whole.file.iterdir())) if is_folder else ()
        self.texts[file] = self._read_text(file)
        own = []
        for found in _classes(file, self.texts[file]):
            if found.name == whole.name:
                own.append(found)
            else:
                self._inner[found.name.rpartition(".")[0]].append(found)
        return [*own, *self._offered(SourceClass(f"{whole.name}.{entry.stem}", entry) for entry in children)]

    def _blank_the_rest(self) -> None:
        for found in (found for unnamed in self._unnamed.values() for found in unnamed):
            if found.span is not None:
                text, (start, end) = self.texts[found.file], found.span
                self.texts[found.file] = text[:start] + re.sub(r"[^\n]", " ", text[start:end]) + text[end:]


def _holds_class(entry: Path) -> bool:
    if entry.is_dir():
        return (entry / "package.mo").is_file()
    return entry.suffix == ".mo" and entry.name != "package.mo"


def _classes(file: Path, text: str) -> Iterator[SourceClass]:
    """Yield the classes in a text: their elements with prefixes and semicolon, and their own words."""
    plain = blanked(text)
    found = sorted(declarations(text), key=lambda declared: declared.start)
    for number, declared in enumerate(found):
        if declared.in_modifier:
            continue
        pieces, cursor = [], declared.start
        for inner in found[number + 1 :]:
            if inner.start >= declared.end:
                break
            if inner.start >= cursor and not inner.in_modifier:
                pieces.append(plain[cursor : inner.start])
                cursor = inner.end
        pieces.append(plain[cursor : declared.end])
        words = frozenset(word for piece in pieces for word in _WORD.findall(piece))
        span = _element(plain, declared.start, declared.end)
        yield SourceClass(declared.name, file, declared.kind, span, words)


def _element(plain: str, start: int, end: int) -> tuple[int, int]:
    """Return the span from the first prefix to the semicolon, so with the clause of a constraining class."""
    prefixes = _PREFIXES.search(plain[max(0, start - _PREFIXES_AT_MOST) : start])
    semicolon = plain.find(";", end - 1)
    return start - (len(prefixes[0]) if prefixes else 0), semicolon + 1 if semicolon >= 0 else len(plain)
