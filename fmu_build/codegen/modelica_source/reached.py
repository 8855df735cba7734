"""Find the part of large libraries that a model can reach, without reading the rest.

A compiler that reads the whole Modelica Standard Library for one model spends most of a build on classes that
the model never names. A name refers to a class only through words of the text: each part of it is declared in
an enclosing scope, in a named package or in a named base class. It therefore suffices to keep a class if it
is declared in a kept class and its simple name is a word in a kept class, in addition to classes that the
language uses without a name, such as constructors. The result may include more than the model needs, but
never less.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from fmu_build.codegen.modelica_source.text import blanked, declarations

IN_MEMORY = "reached:"
"""Prefix for the path of a file whose text is passed to the compiler, which then reads no neighboring files.
"""

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
"""Classes that the language uses implicitly."""

_PREFIXES_AT_MOST = 100
"""Maximal distance before a class in which its prefixes are searched."""


@dataclass(frozen=True, slots=True)
class SourceClass:
    """A class in the text of a file, or in a file of its own that is still unread (`span` is None)."""

    name: str
    file: Path
    kind: str = ""
    """Its restriction, such as "partial model"."""
    span: tuple[int, int] | None = None
    words: frozenset[str] = frozenset()
    """The words of its text, excluding inner classes."""


class ReachedSource:
    """The classes that a model can reach in libraries, and their files without all other classes."""

    classes: dict[str, SourceClass]
    """By qualified name."""
    texts: dict[Path, str]
    """The files, with spaces in place of unreachable classes, so that lines and columns do not change."""

    def __init__(self, model: str, roots: Mapping[str, Path], read: Callable[[Path], str]) -> None:
        """Find what the model reaches.

        Args:
            model: qualified class name.
            roots: package folders or files by their top-level class.
            read: returns the text of a file; its exceptions propagate.
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
        """Keep a class; return the classes that are now both named and declared in a kept class."""
        if kept.span is None:
            return self._read(kept)
        self.classes.setdefault(kept.name, kept)
        return [*self._named(kept.words), *self._offered(self._inner.pop(kept.name, ()))]

    def _named(self, words: frozenset[str]) -> list[SourceClass]:
        """Record words; return the classes that were waiting for one of them."""
        new = words - self._words
        self._words |= new
        return [found for word in sorted(new) for found in self._unnamed.pop(word, ())]

    def _offered(self, declared: Iterable[SourceClass]) -> list[SourceClass]:
        """Return those of the classes that are already named; the others wait."""
        named: list[SourceClass] = []
        for found in declared:
            simple = found.name.rpartition(".")[2]
            (named if simple in self._words else self._unnamed[simple]).append(found)
        return named

    def _read(self, whole: SourceClass) -> list[SourceClass]:
        """Read the file of a class and, for a package folder, list its neighbors."""
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
    """Yield the classes in a text, each with its element (prefixes to semicolon) and its own words."""
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
    """Return the span from the first prefix to the semicolon, including a constraining clause."""
    prefixes = _PREFIXES.search(plain[max(0, start - _PREFIXES_AT_MOST) : start])
    semicolon = plain.find(";", end - 1)
    return start - (len(prefixes[0]) if prefixes else 0), semicolon + 1 if semicolon >= 0 else len(plain)
