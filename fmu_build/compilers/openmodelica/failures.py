"""What omc's messages mean for a build: the project's errors, with omc's places."""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from fmu_build.compilers.openmodelica.messages import Message, errors
from fmu_build.modelica_source.places import located
from fmu_build.support.errors import BuildError, ModelicaError, ToolchainError, UnsupportedModelError

# Only repeat that there was an error, or follow from one.
_FOLLOWS = re.compile(r"Error occurred while flattening model |Failed to load package |.*\bfailed\.?$")
_TOOLS = re.compile(r"Error building simulator|Failed to make clean|omc (?:ended|stopped)|Build commands? ")
_VERSION = re.compile(r"Unknown FMU version|Export of FMU type")
_HINT = re.compile(r"Variable .* does not have any remaining equation")
_UNSUPPORTED = re.compile(r"(?i)not (?:yet )?(?:supported|implemented)|internal error")


def failure(messages: Sequence[Message], model: str, file: Path) -> BuildError:
    """The error for a build that has failed with these messages.

    `file` is where the model is declared; it stands for the place of a message that has none.
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
