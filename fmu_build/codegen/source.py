"""A compiled model with the session that compiled it, so that variants can be compiled."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

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

    def variant(self, settings: Sequence[Setting]) -> rumoca.Model:
        """Compile the model with other parameter values.

        Each value becomes a parameter of the variant: rumoca folds literals in modifiers into the equations,
        which would turn free parameters into constants. Errors of rumoca propagate.
        """
        names = {setting.name: f"{SETTING_PREFIX}{number}" for number, setting in enumerate(settings)}
        declarations = " ".join(
            f"parameter {s.type} {names[s.name]}{_subscripts(s.dimensions)} = {s.value};" for s in settings
        )
        bindings = {
            setting.name: ("each " if setting.each else "", names[setting.name]) for setting in settings
        }
        extension = f"extends {self.model.name}{_modifier(bindings)};"
        return self.session.loads(
            f"model {_VARIANT} {declarations} {extension} end {_VARIANT};", model=_VARIANT
        )


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
