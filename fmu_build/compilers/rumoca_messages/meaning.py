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
    the source, most likely first, in which NAME stands for the group ``name``, and RECORD, CLASS,
    FLOWCONNECTOR, ENUMERATION, ARRAYTYPE, HEIR and FUNCTION for the simple name of any record, class with
    components, connector with flow variables, enumeration, type that is an array of computed size, package
    that inherits, and function of arrays. `called` is set if the explanation begins with the construct
    itself; it replaces the construct if several different ones match.
    """

    message: str
    error: type[BuildError]
    says: str
    constructs: tuple[str, ...] = ()
    called: str = ""
    only_there: bool = False
    """Whether the explanation applies only if one of the constructs occurs in the source."""
    needs: str = ""
    """A pattern that must occur in the source as well, if the explanation is to apply."""

    def applies(self, message: str, source: ModelText) -> bool:
        """Return whether this explains the message about this source."""
        if not re.search(self.message, message):
            return False
        has_construct = not self.only_there or bool(self.search(message, source))
        return has_construct and (
            not self.needs or bool(source.find([self._filled(self.needs, message, source)]))
        )

    def search(self, message: str, source: ModelText) -> list[Construct]:
        """Return the constructs in the source that may have caused the message."""
        return source.find([self._filled(one, message, source) for one in self.constructs])

    def _filled(self, pattern: str, message: str, source: ModelText) -> str:
        """Return a pattern with what its placeholders stand for."""
        match = re.search(self.message, message)
        name = match.groupdict().get("name") if match is not None else None
        stands_for = {
            "NAME": re.escape(name or ""),
            "RECORD": _any_of(source.records),
            "ENUMERATION": _any_of(source.enumerations),
            "ARRAYTYPE": _any_of(source.array_types),
            "FLOWCONNECTOR": _any_of(source.flow_connectors),
            "CLASS": _any_of(source.component_classes),
            "HEIR": _any_of(source.heirs),
            "FUNCTION": _any_of(source.functions_of_arrays),
        }
        return re.sub("|".join(stands_for), lambda found: stands_for[found[0]], pattern)

    def text(self, message: str, found: Sequence[Construct]) -> str:
        """Return the explanation, given the constructs found."""
        match = re.search(self.message, message)
        told = self.says.format(**match.groupdict()) if match is not None else self.says
        texts = {construct.text for construct in found}
        subject = texts.pop() if len(texts) == 1 else self.called
        return f"{subject}: {told}" if self.called else told
