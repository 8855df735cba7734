"""A model as compiled by rumoca, before lowering: its flat form and its source."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.places import Place, located, place_at
from fmu_build.codegen.modelica_source.text import declarations
from fmu_build.support.errors import ModelicaError, UnsupportedModelError

Span = Mapping[str, int]
"""A byte range of a source file: ``source`` is the number of the file, ``start`` and ``end`` are offsets."""


@dataclass(frozen=True)
class CompiledModel:
    """A compiled model; `flat` holds facts that later stages drop (display units, final flags)."""

    name: str
    flat: dict[str, Any]
    source_files: tuple[tuple[int, str, str], ...]

    @cached_property
    def sources(self) -> dict[int, tuple[str, str]]:
        """Path and text of the source files, by their numbers in spans."""
        return {number: (path, text) for number, path, text in self.source_files}

    @cached_property
    def _file(self) -> str:
        """The file that declares the model."""
        for path, text in self.sources.values():
            if any(declared.name == self.name for declared in declarations(text)):
                return path
        return self.name

    @cached_property
    def classes(self) -> ModelText:
        """The source text of all classes that the model can reach."""
        return ModelText(self.name, {Path(path): text for path, text in self.sources.values()}, around=False)

    @cached_property
    def classes_around(self) -> ModelText:
        """The same, and the text of the classes around them."""
        return ModelText(self.name, {Path(path): text for path, text in self.sources.values()})

    def text(self, span: Span) -> str:
        """Return the source text of a span."""
        text = self.sources[span["source"]][1]
        if text.isascii():
            return text[span["start"] : span["end"]]
        return text.encode()[span["start"] : span["end"]].decode()

    def span(self, source: int, start: int, end: int) -> Span:
        """Return the span between two positions in the text of a file."""
        text = self.sources[source][1]
        return {
            "source": source,
            "start": len(text[:start].encode()),
            "end": len(text[:end].encode()),
        }

    def offset(self, span: Span) -> int:
        """Return the position of a span's first character in the text of its file."""
        if self.sources[span["source"]][1].isascii():
            return span["start"]
        return len(self.sources[span["source"]][1].encode()[: span["start"]].decode(errors="ignore"))

    def place(self, span: Span | None) -> Place | None:
        """Return the place of a source span, or None if the compiler gave none."""
        if span is None or span.get("source") not in self.sources:
            return None
        path, text = self.sources[span["source"]]
        return place_at(path, text, self.offset(span))

    def class_around(self, span: Span) -> str:
        """Return the qualified name of the innermost class around a span."""
        text = self.sources[span["source"]][1]
        place = self.offset(span)
        around = (one for one in declarations(text) if one.start <= place < one.end)
        return max(around, key=lambda one: one.start).name

    def unsupported(self, what: str, span: Span | None = None) -> UnsupportedModelError:
        """Return the error for an unsupported construct, with its place in the source."""
        place = self.place(span)
        return UnsupportedModelError(located(what, [place] if place else [], self.name, self._file))

    def invalid(self, what: str, places: Sequence[Place]) -> ModelicaError:
        """Return the error for invalid source, with the places that may be meant."""
        return ModelicaError(located(what, places, self.name, self._file))

    def unsupported_at(self, what: str, construct: Construct) -> UnsupportedModelError:
        """Return the error for a construct that was found in the source."""
        return UnsupportedModelError(located(what, [construct.place], self.name, construct.place.file))


def expressions(tree: Any, kind: str) -> Iterator[dict[str, Any]]:
    """Yield all expressions of a kind in one of rumoca's trees, including nested ones."""
    if isinstance(tree, dict):
        if kind in tree:
            yield tree[kind]
        tree = tree.values()
    elif not isinstance(tree, list):
        return
    for child in tree:
        yield from expressions(child, kind)


def is_fixed(variable: Mapping[str, Any]) -> bool:
    """Return whether a variable of the flat model is a parameter or a constant."""
    return any(kind in variable["variability"] for kind in ("Parameter", "Constant"))
