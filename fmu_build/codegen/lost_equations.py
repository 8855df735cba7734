"""Reject equations that rumoca leaves out.

It drops when-clauses and assertions from branches of if-equations that have as many equations as the other
ones, if a parameter that is not final decides between these; assertions in branches that can change during
the run; and equations that only call a function, or ``terminate()`` outside of a when-clause.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from fmu_build.codegen.compiled import CompiledModel, Span, expressions, is_fixed
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.modelica_source.equations import Call, IfEquation, equations
from fmu_build.codegen.modelica_source.text import declarations

#: What looks like a call of a function and is none.
_KEPT = {"annotation", "assert", "connect", "reinit"}
#: Messages, as that of LimPID on a wrong y_start, change no number.
_HARMLESS = re.compile(r"^Connections\.|(?:^|\.)Streams\.(?:error|print)$")
_CHANGING = {"time", "initial", "terminal"}
_CLAUSE = re.compile(r"(?<![\w.])(?:when|assert|terminate)(?![\w])")
_NAME = re.compile(r"(?<![\w.])[A-Za-z_]\w*(?:\[[^\[\]]*\])?(?:\.\w+(?:\[[^\[\]]*\])?)*")


@dataclass(frozen=True, slots=True)
class _Kept:
    """A clause in rumoca's flat model: its place in the source, and names of the instance that has it."""

    span: Span
    names: frozenset[str]

    def belongs_to(self, prefix: str) -> bool:
        """Return whether the instance with this prefix may have it; without names, any may."""
        return not prefix or not self.names or any(name.startswith(prefix) for name in self.names)


def reject_lost_equations(model: LoweredModel) -> None:
    """Raise `UnsupportedModelError` for the first call or if-equation of which something has been lost."""
    kept = list(_kept(model))
    for number, (path, text) in model.sources.items():
        source = _Source(model, number, text, model.classes.plain(Path(path)))
        for one in equations(source.plain):
            if isinstance(one, Call):
                _reject_call(source, one)
            elif _CLAUSE.search(source.plain, one.start, one.end):
                _require_clauses(source, one, kept)


def _reject_call(source: _Source, call: Call) -> None:
    """Raise `UnsupportedModelError` for a call in a class that the model uses."""
    is_lost = call.name not in _KEPT and not _HARMLESS.search(call.name)
    if not is_lost or not source.instances(call.start, [source.plain[call.start : call.end]]):
        return
    if call.name == "terminate":
        what = (
            "terminate() outside of a when-clause is not supported, because the compiler would leave it out"
        )
    else:
        what = (
            f"calling {call.name}() as an equation is not supported, because the compiler would leave it "
            "out; write what it asserts in the model"
        )
    raise source.model.unsupported(what, source.span(call))


def _require_clauses(source: _Source, one: IfEquation, kept: Sequence[_Kept]) -> None:
    """Raise `UnsupportedModelError` if an instance of the class has lost a clause of an if-equation."""
    for prefix in source.instances(one.start, [branch.condition for branch in one.branches]):
        lost = source.lost(one, prefix, [clause for clause in kept if clause.belongs_to(prefix)])
        if lost is not None:
            raise source.model.unsupported(
                "a when-clause or an assertion in this if-equation is not supported, because the compiler "
                "would leave it out; write the condition into the clause, as in when b and x > 1 then or "
                "assert(not b or x > 1, ...)",
                source.span(lost),
            )


def _kept(model: CompiledModel) -> Iterator[_Kept]:
    """Yield the clauses of the flat model."""
    for chain in model.flat["when_chains"]:
        for branch in (chain["first"], *chain["else_when"]):
            assigned = {one["target"] for one in expressions(branch, "Assign")}
            read = {one["name"]["name"] for one in expressions(branch, "VarRef")} - {"time"}
            yield _Kept(branch["span"], frozenset(assigned | read))
    for one in (*model.flat["assert_equations"], *model.flat["initial_assert_equations"]):
        component = next(expressions(one["origin"], "ComponentEquation"), {}).get("component", "")
        yield _Kept(one["span"], frozenset({f"{component}." if component else ""}))


@dataclass(frozen=True, slots=True)
class _Source:
    """One source file of a model."""

    model: LoweredModel
    number: int
    text: str
    plain: str

    def span(self, one: IfEquation | Call) -> Span:
        """Return the bytes of an equation."""
        return self.model.span(self.number, one.start, one.end)

    def instances(self, place: int, read: Sequence[str]) -> set[str]:
        """Return the prefixes of the variables of the instances of the class around, such as ``motor.``.

        The empty prefix is the model's. It stands for all instances of a class without variables of its own,
        if names in the texts that it reads fit any variables.
        """
        classes = [it for it in declarations(self.text) if not it.in_modifier]
        around = [it for it in classes if it.start <= place < it.end]
        own = max(around, key=lambda it: it.start)
        if own.name == self.model.name:
            return {""}
        inner = [it for it in classes if own.start < it.start and it.end <= own.end]
        spans = [self._bytes(it.start, it.end) for it in (own, *inner)]
        found, simple = set(), set()
        for name, variable in self.model.flat["variables"].items():
            own_name = name.rpartition(".")[2]
            simple.add(own_name)
            span = variable["source_span"]
            if span is not None and span["source"] == self.number:
                places = [first <= span["start"] < last for first, last in spans]
                if places[0] and not any(places[1:]):
                    found.add(name.removesuffix(own_name))
        names = {name for one in read for name in _NAME.findall(one)}
        return found or ({""} if names & simple else set())

    def lost(self, one: IfEquation, prefix: str, kept: Sequence[_Kept]) -> IfEquation | None:
        """Return the if-equation, this one or one inside of it, that has lost a clause in one instance."""
        clauses = [bool(_CLAUSE.search(self.plain, it.start, it.end)) for it in one.branches]
        present = [self._has(it.start, it.end, kept) for it in one.branches]
        if not any(present):
            must = one.has_else and all(clauses)
            if must or (any(clauses) and self._can_change(one, prefix)):
                return one
        # Of the branches, one is active.
        active = [it for it, is_present in zip(one.branches, present, strict=True) if is_present]
        inner = (it for branch in active or one.branches for it in branch.inner)
        return next(filter(None, (self.lost(it, prefix, kept) for it in inner)), None)

    def _bytes(self, start: int, end: int) -> tuple[int, int]:
        return len(self.text[:start].encode()), len(self.text[:end].encode())

    def _has(self, start: int, end: int, kept: Sequence[_Kept]) -> bool:
        """Return whether a clause between these offsets is kept."""
        first, last = self._bytes(start, end)
        return any(it.span["source"] == self.number and first <= it.span["start"] < last for it in kept)

    def _can_change(self, one: IfEquation, prefix: str) -> bool:
        """Return whether one of the conditions depends on time or on a variable that is no parameter."""
        variables = self.model.flat["variables"]
        for branch in one.branches:
            for name in _NAME.findall(branch.condition):
                variable: Any = variables.get(f"{prefix}{name}") or variables.get(name)
                if name in _CHANGING or (variable is not None and not is_fixed(variable)):
                    return True
        return False
