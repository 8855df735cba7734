"""Find constructs in the Modelica source of a model, for errors that lack a position."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Container, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from fmu_build.codegen.modelica_source.modifiers import closing
from fmu_build.codegen.modelica_source.places import Place, place_at
from fmu_build.codegen.modelica_source.text import blanked, declarations

_ARRAY_INPUT = re.compile(r"\binput\s+[\w.]+\s*(?:\w+\s*)?\[")
_ARRAY_TYPE = re.compile(
    r"\A\s*(?:type|connector)\s+\w+\s*=\s*(?:(?:input|output|flow)\s+)?[\w.]+\s*\[[^\]]*[A-Za-z]"
)
_INHERITS = re.compile(r"\bextends\b|\bpackage\s+\w+\s*=")
_ENUMERATION = re.compile(r"\A\s*type\s+\w+\s*=\s*enumeration\b")
_WORD = re.compile(r"'(?:[^'\\\n]|\\.)*'|[A-Za-z_]\w*")


@dataclass(frozen=True, slots=True)
class Construct:
    """A piece of source, joined into one line, and its position; `plain` has no comments and strings."""

    text: str
    place: Place
    plain: str = field(default="", compare=False)


class ModelText:
    """The text of the classes that may contribute to a model, from the files of its libraries.

    These are the class itself, its enclosing classes if `around` is set, and every class to which a name in
    one of these can refer: in an enclosing scope, or in a package that is mentioned. The cause of any error
    is in one of them.
    """

    def __init__(self, model: str, texts: Mapping[Path, str], *, around: bool = True) -> None:
        self._texts = texts
        parts = [part for file, text in self._texts.items() for part in _parts(file, text)]
        reached = _reached(model, parts, around)
        self._classes = {part.name: self._plain_text(part) for part in reached}
        self._kinds = {part.name: part.kind for part in reached}
        self._plain = {
            file: _only(blanked(text), [span for part in reached if part.file == file for span in part.spans])
            for file, text in self._texts.items()
        }
        self._found: dict[str, list[Construct]] = {}

    def plain(self, file: Path) -> str:
        """Return the text of the classes in a file, at its offsets and without comments and strings."""
        return self._plain[file]

    def find(self, patterns: Sequence[str]) -> list[Construct]:
        """Return all matches of the first pattern that has any; a final ``(`` extends to its ``)``."""
        return next(filter(None, map(self._all, patterns)), [])

    def _all(self, pattern: str) -> list[Construct]:
        """Return all matches of a pattern; cached, because several checks look for the same."""
        if pattern not in self._found:
            self._found[pattern] = [
                self._construct(file, match.start(), _end(plain, match))
                for file, plain in self._plain.items()
                for match in re.finditer(pattern, plain)
            ]
        return self._found[pattern]

    def mentions(self, simple_name: str, pattern: str) -> bool | None:
        """Return whether the pattern occurs in a class with this simple name; None without such a class."""
        found = self.of(simple_name)
        return any(re.search(pattern, text) for text in found) if found else None

    def headers(self, simple_name: str) -> list[Construct]:
        """Return the first words, such as ``model M``, of the classes with this simple name, for messages."""
        return self.find([rf"\b(?:model|block|record|type|package|class)\s+{simple_name}\b"])

    def of(self, simple_name: str) -> list[str]:
        """Return the texts, without comments and strings, of the classes with this simple name."""
        return [text for name, text in self._classes.items() if name.rpartition(".")[2] == simple_name]

    def bodies(self, name: str) -> list[str]:
        """Return the text, without comments and strings, of the class with this qualified name, if any."""
        return [self._classes[name]] if name in self._classes else []

    def named(self) -> Iterator[tuple[str, str, str]]:
        """Yield qualified name, restriction and text, without comments and strings, of all classes."""
        return ((name, self._kinds[name], text) for name, text in self._classes.items())

    @cached_property
    def records(self) -> frozenset[str]:
        """The simple names of the classes that are records."""
        return frozenset(
            name.rpartition(".")[2] for name, kind in self._kinds.items() if kind.endswith("record")
        )

    @cached_property
    def functions_of_arrays(self) -> frozenset[str]:
        """The simple names of the functions with an array among their inputs."""
        return frozenset(
            name.rpartition(".")[2]
            for name, kind in self._kinds.items()
            if kind.endswith("function") and _ARRAY_INPUT.search(self._classes[name])
        )

    @cached_property
    def component_classes(self) -> frozenset[str]:
        """The simple names of the models, blocks, connectors and records."""
        kinds = ("model", "block", "class", "connector", "record")
        return frozenset(
            name.rpartition(".")[2] for name, kind in self._kinds.items() if kind.endswith(kinds)
        )

    @cached_property
    def flow_connectors(self) -> frozenset[str]:
        """The simple names of the connectors that have flow variables, or that inherit and may have some."""
        return frozenset(
            name.rpartition(".")[2]
            for name, kind in self._kinds.items()
            if kind.endswith("connector") and re.search(r"\b(?:flow|extends)\b", self._classes[name])
        )

    @cached_property
    def array_types(self) -> frozenset[str]:
        """The simple names of types and connectors that are arrays of a computed size, as ``Real[n]``."""
        return self._simple_names(_ARRAY_TYPE)

    @cached_property
    def heirs(self) -> frozenset[str]:
        """The simple names of the packages that inherit."""
        return frozenset(
            name.rpartition(".")[2]
            for name, kind in self._kinds.items()
            if kind.endswith("package") and _INHERITS.search(self._classes[name])
        )

    @cached_property
    def enumerations(self) -> frozenset[str]:
        """The simple names of the enumerations."""
        return self._simple_names(_ENUMERATION)

    def _simple_names(self, pattern: re.Pattern[str]) -> frozenset[str]:
        found = (name for name, text in self._classes.items() if pattern.search(text))
        return frozenset(name.rpartition(".")[2] for name in found)

    def classes(self) -> list[str]:
        """Return the texts of all classes, without comments and strings."""
        return list(self._classes.values())

    def _plain_text(self, part: _Part) -> str:
        plain = blanked(self._texts[part.file])
        return " ".join(plain[start:end] for start, end in part.spans)

    def at_bytes(self, start: int, end: int, pattern: str) -> list[Construct]:
        """Return the matching text at these bytes in any file, for byte ranges whose file is unknown."""
        found = []
        for file, plain in self._plain.items():
            content = self._texts[file].encode()
            first, last = (len(content[:position].decode(errors="ignore")) for position in (start, end))
            if re.fullmatch(pattern, plain[first:last], re.DOTALL):
                found.append(self._construct(file, first, last))
        return found

    def _construct(self, file: Path, start: int, end: int) -> Construct:
        text = self._texts[file]
        one_line, plain = (" ".join(t[start:end].split()) for t in (text, self._plain[file]))
        return Construct(one_line, place_at(file, text, start), plain)


@dataclass(frozen=True, slots=True)
class _Part:
    """A class without its inner classes: the spans of its own text in its file, and the words in it."""

    name: str
    kind: str
    file: Path
    spans: tuple[tuple[int, int], ...]
    words: frozenset[str]


def _parts(file: Path, text: str) -> list[_Part]:
    plain = blanked(text)
    classes = sorted(declarations(text), key=lambda declared: declared.start)
    parts = []
    for declared in classes:
        spans, cursor = [], declared.start
        for inner in classes:
            if not inner.in_modifier and cursor <= inner.start < declared.end and inner is not declared:
                spans.append((cursor, inner.start))
                cursor = inner.end
        spans.append((cursor, declared.end))
        words = frozenset(word for start, end in spans for word in _WORD.findall(plain[start:end]))
        parts.append(_Part(declared.name, declared.kind, file, tuple(spans), words))
    return parts


def _reached(model: str, parts: Sequence[_Part], around: bool) -> list[_Part]:
    named: dict[str, list[_Part]] = defaultdict(list)
    for part in parts:
        named[part.name].append(part)
    reached: list[_Part] = []
    waiting = list(named.pop(model, ()))
    words: set[str] = set()
    mentioned: set[str] = set()
    while waiting:
        for part in waiting:
            scopes = _scopes(part.name)
            words |= part.words.union(part.name.split(".") if around else ())
            mentioned.update(part.words, scopes, *(outer.words for s in scopes for outer in named.get(s, ())))
        reached += waiting
        found = [name for name in named if _can_be_meant(name, words, mentioned)]
        waiting = [part for name in found for part in named.pop(name)]
    return reached


def _scopes(name: str) -> list[str]:
    """Return the qualified names of a class and of all its enclosing classes."""
    parts = name.split(".")
    return [".".join(parts[: n + 1]) for n in range(len(parts))]


def _can_be_meant(name: str, words: Container[str], mentioned: Container[str]) -> bool:
    """Return whether a word can refer to a class: its scope encloses the word or is mentioned somewhere."""
    scope, _, simple = name.rpartition(".")
    return simple in words and _is_mentioned(scope, mentioned)


def _is_mentioned(scope: str, mentioned: Container[str]) -> bool:
    """Return whether a scope encloses a reached class, or is mentioned, as are the scopes around it."""
    around, _, simple = scope.rpartition(".")
    return not scope or scope in mentioned or (simple in mentioned and _is_mentioned(around, mentioned))


def _only(text: str, spans: Sequence[tuple[int, int]]) -> str:
    """Return the text inside the spans, with spaces in place of everything before and between them."""
    kept, cursor = [], 0
    for start, end in sorted(spans):
        first = max(start, cursor)
        if first < end:
            kept += [" " * (first - cursor), text[first:end]]
            cursor = end
    return "".join(kept)


def _end(text: str, match: re.Match[str]) -> int:
    """Return the end of the match, or of the parenthesis that its last character opens."""
    return closing(text, match.end() - 1) if match[0].endswith("(") else match.end()
