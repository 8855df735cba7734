"""Modelica libraries on disk: their files and the classes that they declare."""

from __future__ import annotations

import difflib
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

from fmu_build.codegen.modelica_source.text import declarations
from fmu_build.support.errors import ModelicaError, ModelNotFoundError

DEFAULT_LIBRARY = "PreloadedSprings"
MODEL_KINDS = ("model", "block", "class")


@dataclass(frozen=True, slots=True)
class ModelicaClass:
    """A class declared in a library: its qualified name, its restriction ("model", ...) and its file."""

    name: str
    kind: str
    file: Path


def default_library() -> Path:
    """Return the package folder of this project's library, in an installation or a checkout.

    Raises `ModelNotFoundError` if it is in neither.
    """
    package = Path(str(resources.files("fmu_build")))
    for folder in (package / "modelica", package.parent / "modelica"):
        if (folder / DEFAULT_LIBRARY / "package.mo").is_file():
            return folder / DEFAULT_LIBRARY
    raise ModelNotFoundError(f"the library {DEFAULT_LIBRARY} is missing from this installation")


def entry_file(library: Path) -> Path:
    """Return the file that a compiler opens: a single .mo file, or package.mo of a package folder.

    Raises `ModelNotFoundError` if there is none.
    """
    if library.is_dir():
        if not (library / "package.mo").is_file():
            raise ModelNotFoundError(f"{library} is not a Modelica package: it has no package.mo")
        return library / "package.mo"
    if not library.is_file():
        raise ModelNotFoundError(f"the Modelica library {library} does not exist")
    if library.suffix != ".mo":
        raise ModelNotFoundError(f"{library} is not a Modelica file: its name must end in .mo")
    return library


def top_level_classes(library: Path) -> list[str]:
    """Return the top-level classes of a library: exactly one for a package folder.

    Raises `ModelNotFoundError` if there is no library.
    """
    names = (declared.name for declared in declarations(read_text(entry_file(library))))
    return list(dict.fromkeys(name for name in names if "." not in name))


def source_files(library: Path) -> list[Path]:
    """Return all Modelica files of a library."""
    return sorted(library.rglob("*.mo")) if library.is_dir() else [library]


def readable_files(library: Path) -> list[Path]:
    """Return the files that a compiler may read.

    They are the library's, those next to a library that is a single file, and this project's library.
    """
    beside = () if library.is_dir() else filter(Path.is_file, sorted(library.parent.glob("*.mo")))
    own = source_files(default_library())
    return list({file.resolve(): file for file in (*own, *beside, *source_files(library))}.values())


def declared_twice(library: Path) -> set[str]:
    """Return the top-level classes that a single file and those next to it declare twice, as copies do."""
    if library.is_dir():
        return set()
    files = filter(Path.is_file, library.parent.glob("*.mo"))
    times = Counter(name for file in files for name in top_level_classes(file))
    return {name for name, number in times.items() if number > 1}


def needed_files(library: Path, given: Sequence[Path] = ()) -> list[Path]:
    """Return the entry files to open for a library: first those of the libraries that it needs, then its own.

    Candidates are this project's library, those `given` and, for a single file, other files in its folder. A
    candidate is needed if its top-level class is mentioned, directly or by another needed library. Raises
    `ModelNotFoundError` if there is no library.
    """
    entry = entry_file(library)
    own = top_level_classes(library)
    others = {DEFAULT_LIBRARY: default_library()}
    others.update((name, other) for other in given for name in top_level_classes(other))
    if not library.is_dir():
        for file in sorted(library.parent.glob("*.mo")):
            others.update((name, file) for name in top_level_classes(file))
    needed: list[Path] = []
    waiting = [library]
    while waiting:
        user = waiting.pop()
        for name, other in others.items():
            if name not in own and other not in needed and other != user and mentions(user, name):
                needed.append(other)
                waiting.append(other)
    return [*(entry_file(other) for other in reversed(needed)), entry]


def read_classes(library: Path) -> dict[str, ModelicaClass]:
    """Return the classes declared in the library's files by qualified name, without inherited ones.

    Parsing is lenient: the names are used for look-up and suggestions, and a file with errors must not hide
    others.
    """
    classes: dict[str, ModelicaClass] = {}
    for file in source_files(library):
        for declared in declarations(read_text(file)):
            classes.setdefault(declared.name, ModelicaClass(declared.name, declared.kind, file))
    return classes


def not_found(
    model: str, library: Path, classes: dict[str, ModelicaClass], syntax_errors: Sequence[str] = ()
) -> ModelNotFoundError:
    """Return the error for a class that is missing or not a model, with the closest names.

    `syntax_errors` are appended if the class is missing: one of them may hide it.
    """
    known = classes.get(model)
    if known is not None:
        return ModelNotFoundError(
            f"{model} in {known.file} is a {known.kind}; only complete models and blocks can become FMUs"
        )
    models = [c.name for c in classes.values() if c.kind in MODEL_KINDS]
    close = difflib.get_close_matches(model, models, n=3, cutoff=0.6)
    last = model.rpartition(".")[2].lower()
    close += [name for name in models if name.rpartition(".")[2].lower() == last and name not in close]
    hint = f"; did you mean {', '.join(close)}?" if close else ""
    return ModelNotFoundError("\n".join([f"there is no model {model!r} in {library}{hint}", *syntax_errors]))


def mentions(library: Path, name: str) -> bool:
    """Return whether the library's source contains `name` as a word."""
    pattern = re.compile(rf"\b{re.escape(name)}\b")
    return any(pattern.search(read_text(file)) for file in source_files(library))


def read_text(file: Path) -> str:
    """Return a file's text with its line ends unchanged; raises `ModelicaError` if it cannot be read."""
    try:
        return file.read_bytes().decode("utf-8", errors="replace")
    except OSError as error:
        raise ModelicaError(f"cannot read {file}: {error.strerror}") from error
