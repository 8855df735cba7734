"""What rumoca reports when it fails, as this project's errors with file, line and column."""

from __future__ import annotations

import os
import re
import sys
import tempfile
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from fmu_build.errors import BuildError, ModelicaError, UnsupportedModelError

_LOCATED = re.compile(r"(?P<text>[^;\[\]][^\[\]]*?) \[(?P<place>[^\[\]\n]+\.mo:\d+:\d+)\]")
_IN_FILE = re.compile(r"^- (?P<file>.+\.mo) \[\w+\]: ", re.MULTILINE)
_SNIPPET = re.compile(
    r"\u00d7\s*(?P<text>[^\n]*)\n\s*╭─\[.*?:(?P<line>\d+):(?P<column>\d+)\]\n(?P<snippet>.*?)\n\s*╰─",
    re.DOTALL,
)
_QUOTED = re.compile(r"[`']([A-Za-z_][\w.\[\], ]*)[`']")
_SPAN = re.compile(r"Span \{[^}]*start: BytePos\((\d+)\), end: BytePos\((\d+)\)")
_UNEXPLAINED = "because resolve/parse failed"
_PHASE = re.compile(r"^\w+ failed: \S+ failed in \w+: ")


@contextmanager
def native_stderr() -> Iterator[Callable[[], str]]:
    """Keeps what compiled code writes to the process's standard error; yields a function that reads it.

    rumoca announces its panics there, before they reach Python as exceptions.
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
def translated_errors(model: str, file: Path) -> Iterator[None]:
    """Turns rumoca's exceptions into build errors; `file` is where the model is declared."""
    import rumoca

    try:
        yield
    except BuildError:
        raise
    except rumoca.RumocaError as error:
        raise ModelicaError(_describe(str(error), model, file)) from error
    except RuntimeError as error:
        raise UnsupportedModelError(f"rumoca cannot lower {model}: {error}") from error
    except BaseException as error:
        # A panic of the Rust code; its class derives from BaseException and cannot be imported.
        if type(error).__module__ != "pyo3_runtime":
            raise
        raise _panic(str(error), model, file) from error


def syntax_errors(files: Iterable[Path]) -> list[str]:
    """The first syntax error of each file that has one, with file, line, column and the line itself."""
    return [error for file in files if (error := _syntax_error(file)) is not None]


def _describe(text: str, model: str, file: Path) -> str:
    broken = _IN_FILE.search(text)
    if broken is not None or _UNEXPLAINED in text:
        syntax = _syntax_error(Path(broken["file"]) if broken is not None else file)
        if syntax is not None:
            return syntax
    message = _PHASE.sub("", text)
    located = [f"{match['place']}: {match['text'].strip()}" for match in _LOCATED.finditer(message)]
    if located:
        return "\n".join(located)
    message = message.partition("\nRelated failures")[0]
    message = message.removeprefix(f"{model} could not be compiled: ")
    return f"{_place(message, file)}: {message}"


def _syntax_error(file: Path) -> str | None:
    """The first syntax error of a file, with the line; the ones after it only follow from it."""
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


def _place(message: str, file: Path) -> str:
    """The file, with line and column where the name that the message quotes occurs in it exactly once."""
    quoted = _QUOTED.search(message)
    text = file.read_text("utf-8", errors="replace")
    if quoted is None:
        return str(file)
    found = list(re.finditer(rf"(?<![\w.]){re.escape(quoted[1])}(?!\w)", text))
    return _position(file, text, found[0].start()) if len(found) == 1 else str(file)


def _panic(text: str, model: str, file: Path) -> BuildError:
    """A panic names its construct and the bytes where it is written, but not the file."""
    detail = re.search(r'detail: "([^"]*)"', text)
    message = f"rumoca cannot compile {model}: {detail[1] if detail else text}"
    span = _SPAN.search(text)
    if span is not None:
        content = file.read_bytes()
        construct = content[int(span[1]) : int(span[2])].decode(errors="replace")
        if construct.startswith("der("):
            place = _position(
                file, content.decode(errors="replace"), len(content[: int(span[1])].decode(errors="replace"))
            )
            return UnsupportedModelError(f"{place}: {construct}: {message}")
    return UnsupportedModelError(message) if "Unsupported" in text else BuildError(message)


def _position(file: Path, text: str, offset: int) -> str:
    line = text.count("\n", 0, offset) + 1
    column = offset - (text.rfind("\n", 0, offset) + 1) + 1
    return f"{file}:{line}:{column}"
