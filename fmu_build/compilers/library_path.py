"""Locate the libraries that a model uses: given with the request, next to those, or in MODELICAPATH.

A library NAME is a folder ``NAME`` or ``NAME VERSION`` with a package.mo, or a file ``NAME.mo``.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_build.codegen.modelica_source.places import place_at
from fmu_build.codegen.modelica_source.reached import ReachedSource
from fmu_build.codegen.modelica_source.text import blanked
from fmu_build.compilers.library import default_library, entry_file, read_text, top_level_classes
from fmu_build.support.errors import ModelNotFoundError

VARIABLE = "MODELICAPATH"
"""The environment variable defined by the Modelica specification: folders that contain libraries."""

_STANDARD = ("Modelica", "ModelicaServices", "Complex")
_USES = re.compile(r"\buses\s*\((?P<uses>(?:[^()]|\([^()]*\))*)\)")
_USED = re.compile(r'(\w+)\s*\(\s*version\s*=\s*"([^"]*)"')


@dataclass(frozen=True, slots=True)
class Libraries:
    """The library that declares a model, and all libraries to which the model can refer."""

    own: Path
    roots: Mapping[str, Path]


def find_libraries(model: str, given: Sequence[Path]) -> Libraries:
    """Find the library of a model among those given, then in MODELICAPATH; the default is this project's.

    Raises `ModelNotFoundError` if a given library does not exist.
    """
    roots: dict[str, Path] = {}
    for library in given:
        roots.update((name, library) for name in top_level_classes(library) if name not in roots)
    first = model.partition(".")[0]
    versions = _versions([roots.get(first, path) for path in given[:1]])
    folders = [library.absolute().parent for library in given]
    folders += [Path(part) for part in os.environ.get(VARIABLE, "").split(os.pathsep) if part]
    for folder in dict.fromkeys([*folders, default_library().parent]):
        for name, library in _libraries_in(folder, versions):
            roots.setdefault(name, library)
    return Libraries(roots.get(first, given[0] if given else default_library()), roots)


def reached_source(model: str, libraries: Libraries) -> ReachedSource:
    """Return the parts of its libraries that the model reaches.

    Raises `ModelNotFoundError` if it uses the Modelica Standard Library and this is not installed.
    """
    first = model.partition(".")[0]
    if first in _STANDARD and first not in libraries.roots:
        raise _needs_standard_library(model)
    reached = ReachedSource(model, libraries.roots, read_text)
    missing = "|".join(name for name in _STANDARD[:2] if name not in libraries.roots)
    for file, text in reached.texts.items() if missing else ():
        used = re.search(rf"(?<![\w.])(?:{missing})\s*\.\s*\w|\bimport\s+(?:{missing})\b", blanked(text))
        if used is not None:
            raise _needs_standard_library(f"{place_at(file, text, used.start())}: {model}")
    return reached


def used_libraries(libraries: Libraries, reached: ReachedSource) -> set[Path]:
    """Return the libraries of which the model reaches at least one class."""
    return {libraries.roots[name] for name in reached.classes if name in libraries.roots}


def _needs_standard_library(what: str) -> ModelNotFoundError:
    return ModelNotFoundError(
        f"{what} needs the Modelica Standard Library; name its folder Modelica by --library, "
        f"or the folder above it in {VARIABLE}"
    )


def _versions(libraries: Sequence[Path]) -> dict[str, str]:
    """Return the versions of other libraries that are requested by annotations in these."""
    texts = (read_text(entry_file(library)) for library in libraries)
    return {
        name: version
        for text in texts
        for uses in _USES.finditer(text)
        for name, version in _USED.findall(uses[0])
    }


def _libraries_in(folder: Path, versions: Mapping[str, str]) -> Iterator[tuple[str, Path]]:
    """Yield the libraries in a folder by name: the requested version, else one without, else the newest."""
    found: list[tuple[str, tuple[bool, bool, list[int]], Path]] = []
    for path in sorted(folder.iterdir()) if folder.is_dir() else ():
        if (path / "package.mo").is_file() or (path.suffix == ".mo" and path.name != "package.mo"):
            name, _, version = (path.name if path.is_dir() else path.stem).partition(" ")
            rank = (
                version == versions.get(name, ""),
                not version,
                [int(n) for n in re.findall(r"\d+", version)],
            )
            found.append((name, rank, path))
    for name, _, path in sorted(found, key=lambda each: each[1], reverse=True):
        yield name, path
