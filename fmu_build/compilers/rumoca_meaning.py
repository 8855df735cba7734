"""Translations of rumoca's messages to Modelica's terms."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from fmu_build.modelica_source.constructs import Construct, ModelText
from fmu_build.support.errors import BuildError


@dataclass(frozen=True, slots=True)
class Meaning:
    """The explanation of a message.

    `message` is a pattern; `says` may use its named groups. `constructs` are patterns of possible causes in
    the source, most likely first, in which NAME stands for the group ``name`` and RECORD for the simple name
    of any record. `called` is set if the explanation begins with the construct itself; it replaces the
    construct if several different ones match.
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
        record = f"(?:{'|'.join(map(re.escape, source.records)) or '(?!)'})"
        return source.find(
            [pattern.replace("NAME", name).replace("RECORD", record) for pattern in self.constructs]
        )

    def text(self, message: str, found: Sequence[Construct]) -> str:
        """Return the explanation, given the constructs found."""
        match = re.search(self.message, message)
        told = self.says.format(**match.groupdict()) if match is not None else self.says
        texts = {construct.text for construct in found}
        subject = texts.pop() if len(texts) == 1 else self.called
        return f"{subject}: {told}" if self.called else told
