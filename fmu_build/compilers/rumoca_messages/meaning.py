"""Translations of rumoca's messages to Modelica's terms."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.support.errors import BuildError

QUALIFIED = r"(?:[^`']*\.)?(?P<name>\w+)(?:\[[^`'.]*\])?"
"""The last part of a qualified name, as written in the source."""


def _any_of(names: Iterable[str]) -> str:
    """A pattern for any of the names."""
    return f"(?:{'|'.join(map(re.escape, names)) or '(?!)'})"


@dataclass(frozen=True, slots=True)
class Meaning:
    """The explanation of a message.

    `message` is a pattern; `says` may use its named groups. `constructs` are patterns of possible causes in
    the source, most likely first, in which NAME stands for the group ``name``, RECORD for the simple name of
    any record and FUNCTION for that of any function of arrays. `called` is set if the explanation begins with
    the construct itself; it replaces the construct if several different ones match.
    """

    message: str
    error: type[BuildError]
    says: str
    constructs: tuple[str, ...] = ()
    called: str = ""
    only_there: bool = False
    """Whether the explanation applies only if one of the constructs occurs in the source."""

    def search(self, message: str, source: ModelText) -> list[Construct]:
        """Return the constructs in the source that may have caused the message."""
        match = re.search(self.message, message)
        name = re.escape(match.groupdict().get("name") or "") if match is not None else ""
        stands_for = {
            "NAME": name,
            "RECORD": _any_of(source.records),
            "FUNCTION": _any_of(source.functions_of_arrays),
        }
        placeholder = re.compile("|".join(stands_for))
        return source.find(
            [placeholder.sub(lambda found: stands_for[found[0]], one) for one in self.constructs]
        )

    def text(self, message: str, found: Sequence[Construct]) -> str:
        """Return the explanation, given the constructs found."""
        match = re.search(self.message, message)
        told = self.says.format(**match.groupdict()) if match is not None else self.says
        texts = {construct.text for construct in found}
        subject = texts.pop() if len(texts) == 1 else self.called
        return f"{subject}: {told}" if self.called else told
