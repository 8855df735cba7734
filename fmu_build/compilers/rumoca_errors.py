"""Translate rumoca's failures to this project's errors with file, line and column."""

from __future__ import annotations

import os
import re
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from fmu_build.codegen.modelica_source.constructs import ModelText
from fmu_build.codegen.modelica_source.places import located
from fmu_build.codegen.modelica_source.reached import IN_MEMORY
from fmu_build.compilers.library import read_text
from fmu_build.compilers.rumoca_messages import meaning_of
from fmu_build.support.errors import BuildError, ModelicaError, UnsupportedModelError

_LOCATED = re.compile(r"(?:; )?(?P<text>.+?) \[(?P<place>[^\[\]\n]+\.mo:\d+:\d+)\]", re.DOTALL)
_IN_FILE = re.compile(r"^- (?P<file>.+\.mo) \[\w+\]: ", re.MULTILINE)
_SNIPPET = re.compile(
    r"\u00d7\s*(?P<text>[^\n]*)\n\s*╭─\[.*?:(?P<line>\d+):(?P<column>\d+)\]\n(?P<snippet>.*?)\n\s*╰─",
    re.DOTALL,
)
_QUOTED = re.compile(r"[`']([A-Za-z_][\w.\[\], ]*)[`']")
_SPAN = re.compile(r"Span \{[^}]*start: BytePos\((\d+)\), end: BytePos\((\d+)\)")
_DERIVATIVE = r"der\s*\(.*\)"
_UNEXPLAINED = "because resolve/parse failed"
# A failure after type checking means that the Modelica is valid but not supported.
_AFTER_TYPES = re.compile(r"^(?:flatten|todae) failed: ")
_SIZE = re.compile(
    r"unevaluable array dimensions for '(?P<name>[^']*)': dimension expression could not be evaluated: "
    r"\[(?:Expression\()?(?P<size>.*?)\)?\]"
)
_PHASE = re.compile(r"^\w+ failed: \S+ failed in \w+: ")
_OWNER = re.compile(r"unsupported Flat semantic owner `([^`]*)`: ")


@contextmanager
def native_stderr() -> Iterator[Callable[[], str]]:
    """Capture what compiled code writes to standard error; yield a function that returns it afterwards.

    rumoca prints its panics there before they reach Python as exceptions.
    """
    sys.stderr.flush()
    with tempfile.TemporaryFile() as sink:
        collected = ""
        saved = os.dup(2)
        os.dup2(sink.fileno(), 2)
        try:
            yield lambda: collected
        finally:
            os.dup2(saved, 2)
            os.close(saved)
            sink.seek(0)
            collected = sink.read().decode(errors="replace")


@contextmanager
def translated_errors(model: str, file: Path, files: Iterable[Path]) -> Iterator[None]:
    """Convert rumoca's exceptions to build errors.

    `file` declares the model; `files` are all files that may contribute to it.
    """
    import rumoca

    try:
        yield
    except BuildError:
        raise
    except RecursionError as error:
        raise UnsupportedModelError(
            f"{file}: an expression of {model} is nested too deep, such as a sum of several hundred terms; "
            "use sum(), or variables for its parts"
        ) from error
    except (rumoca.RumocaError, RuntimeError) as error:
        raise _translated(str(error).replace(IN_MEMORY, ""), model, file, files) from error
    except BaseException as error:
        # A panic in Rust code: its class derives from BaseException and cannot be imported.
        if type(error).__module__ != "pyo3_runtime":
            raise
        raise _panic(str(error).replace(IN_MEMORY, ""), model, file, files) from error


def syntax_errors(files: Iterable[Path]) -> list[str]:
    """Return the first syntax error of each file, with file, line, column and source line."""
    return [error for file in files if (error := _syntax_error(file)) is not None]


def _translated(text: str, model: str, file: Path, files: Iterable[Path]) -> BuildError:
    broken = _IN_FILE.search(text)
    if broken is not None or _UNEXPLAINED in text:
        syntax = _syntax_error(Path(broken["file"]) if broken is not None else file)
        if syntax is not None:
            return ModelicaError(syntax)
    message = _PHASE.sub("", text)
    errors = [(match["place"], match["text"].strip()) for match in _LOCATED.finditer(message)]
    if errors:
        return _of_places(errors, model, file, files)
    message = message.partition("\nRelated failures")[0]
    message = message.removeprefix(f"{model} could not be compiled: ")
    explained = _explained(message, model, file, files)
    if explained is not None:
        return explained
    source = ModelText(model, {file: read_text(file) for file in files})
    quoted = _QUOTED.search(_OWNER.sub("", message))
    found = source.find([rf"(?<![\w.]){re.escape(quoted[1])}(?!\w)"]) if quoted is not None else []
    not_carried = "unsupported" in message or _AFTER_TYPES.match(text)
    error = UnsupportedModelError if not_carried else ModelicaError
    what = _OWNER.sub(r"rumoca does not support this \1: ", message)
    return error(located(what, [construct.place for construct in found], model, file))


def _of_places(
    errors: Sequence[tuple[str, str]], model: str, file: Path, files: Iterable[Path]
) -> BuildError:
    """Return the error for messages with their places: one of the source, unless rumoca is wrong in all."""
    if any(_SIZE.search(text) for _, text in errors):
        lines = [f"{place}: {text}" for place, text in errors]
        return UnsupportedModelError(_SIZE.sub(_unknown_size, "\n".join(lines)))
    explained = [_explained(text, model, file, files, place) for place, text in errors]
    unsupported = [one for one in explained if isinstance(one, UnsupportedModelError)]
    if len(unsupported) == len(errors):
        return unsupported[0]
    return ModelicaError("\n".join(f"{place}: {text}" for place, text in errors))


def _explained(
    message: str, model: str, file: Path, files: Iterable[Path], place: str | None = None
) -> BuildError | None:
    """Return the error for a message that has a meaning, with the places of what may have caused it.

    `place` is the one that rumoca gives, which decides between several.
    """
    source = ModelText(model, {file: read_text(file) for file in files})
    meaning = meaning_of(message, source)
    if meaning is None:
        return None
    found = meaning.search(message, source)
    what = meaning.text(message, found)
    if place is not None and len(found) != 1:
        return meaning.error(f"{place}: {what}")
    return meaning.error(located(what, [construct.place for construct in found], model, file))


def _unknown_size(found: re.Match[str]) -> str:
    return (
        f"the size of {found['name']}, {found['size']}, is not a number that the compiler can compute; "
        "declare the array with a number"
    )


def _syntax_error(file: Path) -> str | None:
    """Return the first syntax error of a file with its line; later ones are only consequences."""
    import rumoca

    try:
        diagnostics = rumoca.validate(str(file))
    except RuntimeError as error:  # not a text file
        return f"{file}: {error}"
    for diagnostic in diagnostics:
        match = _SNIPPET.search(diagnostic.message)
        if match is not None:
            return f"{file}:{match['line']}:{match['column']}: {match['text']}\n{match['snippet']}"
    return None


def _panic(text: str, model: str, file: Path, files: Iterable[Path]) -> BuildError:
    """Return the error for a panic, whose text may name a construct and its byte range but not its file."""
    source = ModelText(model, {file: read_text(file) for file in files})
    meaning, span = meaning_of(text, source), _SPAN.search(text)
    if meaning is not None:
        at_bytes = span and source.at_bytes(int(span[1]), int(span[2]), _DERIVATIVE)
        found = at_bytes or meaning.search(text, source)
        what = meaning.text(text, found)
        return meaning.error(located(what, [construct.place for construct in found], model, file))
    detail = re.search(r'detail: "([^"]*)"', text)
    what = f"the compiler ends at this model, which need not be wrong: {detail[1] if detail else text}"
    return UnsupportedModelError(located(what, [], model, file))
