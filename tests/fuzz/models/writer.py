"""A random model under construction."""

from __future__ import annotations

from random import Random

from tests.fuzz.models.meaning import Meaning
from tests.fuzz.models.terms import N, Scope, Term, Terms


class Writer:
    """Collects the parts of a model and how its variables follow from each other."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.scope = Scope()
        self.package: list[str] = []
        self.declarations: list[str] = []
        self.equations: list[str] = []
        self.observed: list[str] = []
        self.meaning = Meaning()

    def add(self, name: str, value: Term, size: str = "") -> None:
        """An algebraic variable."""
        self.declarations.append(f"Real {name}{size};")
        self.equations.append(f"{name} = {value.text};")
        self.meaning.steps.append((name, value.value))
        self.observed += [f"{name}[{i}]" for i in range(1, N + 1)] if size else [name]

    def terms(self, scope: Scope | None = None) -> Terms:
        """Makes expressions from a scope, else from that of the model."""
        return Terms(self.random, scope or self.scope)

    def parameter(self, name: str, kind: str, value: Term) -> None:
        """A parameter with its value."""
        self.declarations.append(f"parameter {kind} {name} = {value.text};")
        self.meaning.fixed.append((name, value.value))
