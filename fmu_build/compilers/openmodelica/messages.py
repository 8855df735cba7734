"""What omc writes: answers to statements, and messages with their places."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from fmu_build.modelica_source.places import Place

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
    """What came of one statement: its value as omc prints it, and the messages on the way."""

    value: str
    messages: tuple[Message, ...]

    @property
    def text(self) -> str:
        """The value of a statement that gives a String."""
        return unquoted(self.value)

    @property
    def succeeded(self) -> bool:
        """Whether a statement that gives a Boolean gave true, whatever was printed before that."""
        return self.value.endswith("true")


def quoted(text: str) -> str:
    """The text as a Modelica String literal."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def unquoted(literal: str) -> str:
    """The text of a Modelica String literal; anything else as it is."""
    if len(literal) < 2 or not literal.startswith('"') or not literal.endswith('"'):
        return literal
    return _ESCAPE.sub(r"\1", literal[1:-1])


def read_messages(text: str) -> tuple[Message, ...]:
    """The messages in what ``getErrorString()`` gives, or in what omc prints when it gives up.

    A message may have many lines, and begins where one begins with its place or its level. What stands
    before the first of them is a message of its own.
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
    """The messages that are errors."""
    return [message for message in messages if message.level == "error"]


def watched(statement: str, marker: str) -> str:
    """The statement, followed by what makes its value and its messages stand apart in omc's answer."""
    return f'{statement}; "{marker}"; getErrorString(); "{marker}"'


def read_answers(output: str, marker: str, count: int) -> list[Answer]:
    """The answers to that many watched statements; `output` is all that omc has printed.

    Where omc has given up on the way, what it printed last is in the messages of the last answer, and the
    answers after it are missing.
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
