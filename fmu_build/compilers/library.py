"""Modelica libraries on disk: where they are and which classes they declare."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from importlib import resources
from pathlib import Path

from fmu_build.errors import ModelicaError, ModelNotFoundError

DEFAULT_LIBRARY = "PreloadedSprings"
MODEL_KINDS = ("model", "block", "class")

_TOKEN = re.compile(
    r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\])*"'  # comments and strings, skipped
    r"|'(?:\\.|[^'\\])*'|[A-Za-z_][A-Za-z0-9_]*|[=;.]",
    re.DOTALL,
)
_KINDS = frozenset({*MODEL_KINDS, "package", "function", "record", "connector", "type", "operator"})


@dataclass(frozen=True, slots=True)
class ModelicaClass:
    """A class that a library declares: its qualified name, its restriction ("model", ...) and its file."""

    name: str
    kind: str
    file: Path


def default_library() -> Path:
    """The package folder of this project's own library: inside an installation, or beside it in a checkout.

    Raises `ModelNotFoundError` where it is in neither place.
    """
    package = Path(str(resources.files("fmu_build")))
    for folder in (package / "modelica", package.parent / "modelica"):
        if (folder / DEFAULT_LIBRARY / "package.mo").is_file():
            return folder / DEFAULT_LIBRARY
    raise ModelNotFoundError(f"the library {DEFAULT_LIBRARY} is missing from this installation")


def entry_file(library: Path) -> Path:
    """The file that a compiler opens: a single .mo file itself, package.mo of a package folder.

    Raises `ModelNotFoundError` where there is none.
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


def source_files(library: Path) -> list[Path]:
    """All Modelica files of a library."""
    return sorted(library.rglob("*.mo")) if library.is_dir() else [library]


def read_classes(library: Path) -> dict[str, ModelicaClass]:
    """The classes that the library's files declare, by qualified name; inherited ones are not among them.

    Reads leniently: it is for finding and suggesting names, and a file with errors must not hide others.
    """
    classes: dict[str, ModelicaClass] = {}
    for file in source_files(library):
        for name, kind in _declarations(_read(file)):
            classes.setdefault(name, ModelicaClass(name, kind, file))
    return classes


def not_found(
    model: str, library: Path, classes: dict[str, ModelicaClass], syntax_errors: Sequence[str] = ()
) -> ModelNotFoundError:
    """The error for a class that is not there or is no model, with the names that come closest.

    `syntax_errors` are told too where the class is not there: they may be what hides it.
    """
    known = classes.get(model)
    if known is not None:
        return ModelNotFoundError(
            f"{model} in {known.file} is a {known.kind}; only complete models and blocks become FMUs"
        )
    models = [c.name for c in classes.values() if c.kind in MODEL_KINDS]
    close = difflib.get_close_matches(model, models, n=3, cutoff=0.6)
    last = model.rpartition(".")[2].lower()
    close += [name for name in models if name.rpartition(".")[2].lower() == last and name not in close]
    hint = f"; did you mean {', '.join(close)}?" if close else ""
    return ModelNotFoundError("\n".join([f"there is no model {model!r} in {library}{hint}", *syntax_errors]))


def mentions(library: Path, name: str) -> bool:
    """Whether the library's source has `name` as a word."""
    pattern = re.compile(rf"\b{re.escape(name)}\b")
    return any(pattern.search(_read(file)) for file in source_files(library))


def _read(file: Path) -> str:
    try:
        return file.read_text("utf-8", errors="replace")
    except OSError as error:
        raise ModelicaError(f"cannot read {file}: {error.strerror}") from error


def _declarations(text: str) -> Iterator[tuple[str, str]]:
    """(qualified name, kind) of the classes that a file declares, read from its tokens alone."""
    tokens = [token for token in _TOKEN.findall(text) if not token.startswith(("//", "/*", '"'))]
    scope: list[str] = []
    prefix = _within(tokens)
    for position, token in enumerate(tokens):
        previous = tokens[position - 1] if position else ";"
        if previous == "end" and scope and token == scope[-1]:
            scope.pop()
        elif token in _KINDS and previous not in ("end", "."):
            name, following = (*tokens[position + 1 : position + 3], "", "")[:2]
            if not name or name in _KINDS or not (name[0].isalpha() or name[0] in "_'"):
                continue
            if name == "extends":
                name, following = following, ""
            yield ".".join((*prefix, *scope, name)), f"partial {token}" if previous == "partial" else token
            if following != "=":
                scope.append(name)


def _within(tokens: list[str]) -> list[str]:
    if tokens[:1] != ["within"]:
        return []
    return [token for token in tokens[1 : tokens.index(";")] if token != "."] if ";" in tokens else []
