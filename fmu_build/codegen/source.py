"""A compiled model together with the session that compiled it, for compiling variants."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import rumoca

_VARIANT = "FmuBuildVariant"
SETTING_PREFIX = "fmuBuildSetting"
"""Prefix of the parameters that a variant adds to its model."""


@dataclass(frozen=True, slots=True)
class Setting:
    """A parameter's dotted name, Modelica type, array dimensions and value as Modelica text.

    With `each`, the value applies to the parameter in every element of an array of components.
    """

    name: str
    type: str
    dimensions: tuple[int, ...]
    value: str
    each: bool = False


@dataclass(frozen=True)
class ModelSource:
    """A compiled model and the session that has loaded its source."""

    session: rumoca.Session
    model: rumoca.Model
    kept: tuple[Setting, ...] = ()
    """Settings that apply to every variant."""

    def keeping(self, settings: Sequence[Setting]) -> ModelSource:
        """Return the source with these settings added to every variant."""
        return replace(self, kept=(*self.kept, *settings))

    def names(self, settings: Sequence[Setting]) -> dict[str, str]:
        """Return the names of the parameters that a variant adds, keyed by the parameters that they set."""
        return {name: f"{SETTING_PREFIX}{number}" for number, name in enumerate(self._all(settings))}

    def variant(self, settings: Sequence[Setting]) -> rumoca.Model:
        """Compile the model with other parameter values.

        Each value becomes a parameter of the variant: rumoca folds literals in modifiers into the equations,
        which would turn free parameters into constants. Errors of rumoca propagate.
        """
        names = self.names(settings)
        all_settings = self._all(settings).values()
        declarations = " ".join(
            f"parameter {s.type} {names[s.name]}{_subscripts(s.dimensions)} = {s.value};"
            for s in all_settings
        )
        bindings = {s.name: ("each " if s.each else "", names[s.name]) for s in all_settings}
        extension = f"extends {self.model.name}{_modifier(bindings)};"
        return self.session.loads(
            f"model {_VARIANT} {declarations} {extension} end {_VARIANT};", model=_VARIANT
        )

    def _all(self, settings: Sequence[Setting]) -> dict[str, Setting]:
        return {setting.name: setting for setting in (*self.kept, *settings)}


def _subscripts(dimensions: tuple[int, ...]) -> str:
    return f"[{', '.join(map(str, dimensions))}]" if dimensions else ""


def _modifier(bindings: Mapping[str, tuple[str, str]]) -> str:
    """Write dotted names as nested modifiers: ``a.b`` and ``a.c`` become ``(a(b = ..., c = ...))``."""
    direct = [f"{prefix}{name} = {value}" for name, (prefix, value) in bindings.items() if "." not in name]
    nested: dict[str, dict[str, tuple[str, str]]] = {}
    for name, binding in bindings.items():
        first, dot, rest = name.partition(".")
        if dot:
            nested.setdefault(first, {})[rest] = binding
    parts = [*direct, *(f"{first}{_modifier(inner)}" for first, inner in nested.items())]
    return f"({', '.join(parts)})" if parts else ""
