"""Parse omc's output: answers to statements, and messages with source positions."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_build.codegen.modelica_source.places import Place, located
from fmu_build.support.errors import BuildError, ModelicaError, ToolchainError, UnsupportedModelError

_MESSAGE = re.compile(
    r"^(?:\[(?P<file>[^\n]*?):(?P<line>\d+):(?P<column>\d+)-\d+:\d+:(?:readonly|writable)\] )?"
    r"(?P<level>Internal error|Error|Warning|Notification): ",
    re.MULTILINE,
)
_ESCAPE = re.compile(r'\\(["\\])')


@dataclass(frozen=True, slots=True)
class Message:
    """One message of omc; `level` is ``error``, ``warning`` or ``notification``."""

    level: str
    text: str
    place: Place | None = None

    def __str__(self) -> str:
        place = f"{self.place}: " if self.place is not None else ""
        return f"{place}{self.level}: {self.text}"


@dataclass(frozen=True, slots=True)
class Answer:
    """The answer to one statement: its value as printed by omc, and the messages it caused."""

    value: str
    messages: tuple[Message, ...]

    @property
    def text(self) -> str:
        """The value of a statement that returns a String."""
        return unquoted(self.value)

    @property
    def succeeded(self) -> bool:
        """Whether a statement that returns a Boolean returned true, whatever it printed before."""
        return self.value.endswith("true")


def quoted(text: str) -> str:
    """Return the text as a Modelica String literal."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def unquoted(literal: str) -> str:
    """Return the text of a Modelica String literal; anything else is returned as it is."""
    if len(literal) < 2 or not literal.startswith('"') or not literal.endswith('"'):
        return literal
    return _ESCAPE.sub(r"\1", literal[1:-1])


def read_messages(text: str) -> tuple[Message, ...]:
    """Return the messages in the result of ``getErrorString()``, or in omc's output when it gives up.

    A message may have several lines; it begins at a line that starts with a source position or a level. Text
    before the first such line is one message of level ``error``.
    """
    starts = list(_MESSAGE.finditer(text))
    before = text[: starts[0].start()] if starts else text
    found = [Message("error", before.strip())] if before.strip() else []
    ends = [match.start() for match in starts[1:]] + [len(text)]
    for match, end in zip(starts, ends, strict=False):
        place = Place(match["file"], int(match["line"]), int(match["column"])) if match["file"] else None
        level = match["level"].lower().removeprefix("internal ")
        found.append(Message(level, text[match.end() : end].strip(), place))
    return tuple(dict.fromkeys(found))


def errors(messages: Iterable[Message]) -> list[Message]:
    """Return the messages that are errors."""
    return [message for message in messages if message.level == "error"]


def watched(statement: str, marker: str) -> str:
    """Return the statement, followed by statements that delimit its value and messages in the output."""
    return f'{statement}; "{marker}"; getErrorString(); "{marker}"'


def read_answers(output: str, marker: str, count: int) -> list[Answer]:
    """Return the answers to `count` watched statements; `output` is everything that omc has printed.

    If omc gave up, the messages of the last answer contain the end of its output, and later answers are
    missing.
    """
    parts = re.split(rf'^"{re.escape(marker)}"\n?', output, flags=re.MULTILINE)
    complete = min(count, (len(parts) - 1) // 2)
    answers = [
        Answer(value.strip(), read_messages(unquoted(text.strip())))
        for value, text in zip(parts[0 : 2 * complete : 2], parts[1 : 2 * complete : 2], strict=True)
    ]
    if complete < count:
        rest = "\n".join(parts[2 * complete :]).strip()
        answers.append(Answer("", read_messages(rest or "Error: omc stopped without a message")))
    return answers


# These messages only say that there was an error, or are consequences of another one.
_FOLLOWS = re.compile(r"Error occurred while flattening model |Failed to load package |.*\bfailed\.?$")
_TOOLS = re.compile(r"Error building simulator|Failed to make clean|omc (?:ended|stopped)|Build commands? ")
_VERSION = re.compile(r"Unknown FMU version|Export of FMU type")
_HINT = re.compile(r"Variable .* does not have any remaining equation")
_UNSUPPORTED = re.compile(r"(?i)not (?:yet )?(?:supported|implemented)|internal error")


def failure(messages: Sequence[Message], model: str, file: Path) -> BuildError:
    """Return the error for a build that failed with these messages.

    `file` declares the model; messages without a position are attributed to it.
    """
    found = errors(messages)
    tools = [message for message in found if _TOOLS.match(message.text)]
    if tools:
        return ToolchainError("\n".join(message.text for message in tools))
    versions = [message for message in found if _VERSION.match(message.text)]
    if versions:
        return UnsupportedModelError(f"{model}: {versions[0].text}")
    placed = [message for message in found if message.place is not None]
    told = placed or [message for message in found if not _FOLLOWS.match(message.text)] or found
    if not told:
        return BuildError(located("omc made no FMU and gave no reason", [], model, file))
    kind = UnsupportedModelError if any(_UNSUPPORTED.search(m.text) for m in told) else ModelicaError
    hints = [] if placed else [message for message in messages if _HINT.match(message.text)]
    return kind("\n".join(_line(message, model, file) for message in [*told, *hints]))


def _line(message: Message, model: str, file: Path) -> str:
    places = [message.place] if message.place is not None else []
    return located(message.text, places, model, file)
