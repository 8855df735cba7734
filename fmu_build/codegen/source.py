"""A compiled model together with the session that compiled it, to compile variants of it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import rumoca

_VARIANT = "FmuBuildVariant"


@dataclass(frozen=True)
class ModelSource:
    """A model by name in a session that has loaded it."""

    session: rumoca.Session
    model: rumoca.Model

    def variant(self, values: Mapping[str, str]) -> rumoca.Model:
        """The model with other parameter values, given as Modelica text by dotted name.

        Raises what rumoca raises where the variant does not compile.
        """
        text = f"model {_VARIANT} extends {self.model.name}{_modifier(values)}; end {_VARIANT};"
        return self.session.loads(text, model=_VARIANT)


def _modifier(values: Mapping[str, str]) -> str:
    """Dotted names as nested modifiers: ``a.b`` and ``a.c`` become ``(a(b = ..., c = ...))``."""
    direct = [f"{name} = {value}" for name, value in values.items() if "." not in name]
    nested: dict[str, dict[str, str]] = {}
    for name, value in values.items():
        first, dot, rest = name.partition(".")
        if dot:
            nested.setdefault(first, {})[rest] = value
    parts = [*direct, *(f"{first}{_modifier(inner)}" for first, inner in nested.items())]
    return f"({', '.join(parts)})" if parts else ""
