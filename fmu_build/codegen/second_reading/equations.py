"""Compare rumoca's equations with those of the classes in the source.

An equation of a component must stand in one of its classes, and the names in it must mean variables of this
component. Each equation of its classes must be there, if it is not in a branch that does not hold.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from fmu_build.codegen.compiled import Span, expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.second_reading.captures import captured_names
from fmu_build.codegen.second_reading.givens import Scope, Text, as_written, nowhere, plain
from fmu_build.codegen.second_reading.known_variables import Variables
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.packages import NAME, is_iterator, is_one_of
from fmu_build.codegen.second_reading.residuals import Pass, Residuals, passes
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.codegen.second_reading.sections import Branches, Equation, Loop, statements
from fmu_build.codegen.second_reading.syntax import TOKEN, Section

Difference = tuple[str, Span]


def mistaken_equations(
    model: LoweredModel, instances: Variables, unknown: list[Text]
) -> Iterator[Difference]:
    """Yield what is wrong with the equations of components, and where these stand.

    The texts of equations that cannot be compared by their residuals are added to `unknown`.
    """
    for kind in ("equations", "initial_equations"):
        found = _by_component(model, kind)
        for path, part in instances.parts.items():
            for one in found.get(path, []):
                if not any(owner.contains(one.file, one.offset) for owner in part.classes):
                    yield f"{path} has an equation that is not in its class", one.equation["span"]
            for owner in part.classes:
                own = [one for one in found.get(path, []) if owner.contains(one.file, one.offset)]
                comparison = _Comparison(model, instances, Scope(path, owner), own)
                for section in owner.sections:
                    if section.is_initial == (kind == "initial_equations"):
                        yield from comparison.of(section, unknown)
        of_unknown = (one for path in found.keys() - instances.parts.keys() for one in found[path])
        unknown += _texts_around(instances.library, of_unknown)


def _texts_around(library: Library, found: Iterable[_Compiled]) -> Iterator[Text]:
    """Yield the sections of the classes in which equations of unknown components stand."""
    with suppress(UnknownError):
        classes = [library.class_at(one.file, one.offset) for one in found]
        for owner in {id(one): one for one in classes}.values():
            yield from (Text(nowhere(owner), section.tokens) for section in owner.sections)


@dataclass(frozen=True, slots=True)
class _Compiled:
    """A flat equation, the place of its text, and its residuals."""

    equation: Mapping[str, Any]
    file: int
    offset: int
    residuals: Sequence[Pass]


def _by_component(model: LoweredModel, kind: str) -> dict[str, list[_Compiled]]:
    """Return the equations of each component that stand in the source."""
    found = defaultdict(list)
    equations = model.flat[kind]
    families = model.flat[kind.replace("equations", "structured_equations")]
    for equation, residuals in zip(equations, passes(equations, families), strict=True):
        origin, span = equation["origin"], equation["span"]
        if "ComponentEquation" in origin and span["source"] in model.sources:
            one = _Compiled(equation, span["source"], model.offset(span), residuals)
            found[origin["ComponentEquation"]["component"]].append(one)
    return found


def mistaken_names(model: LoweredModel, instances: Variables, scope: Scope, tree: Any) -> Iterator[str]:
    """Yield names in an expression that rumoca takes for variables of another component."""
    for reference in expressions(tree, "VarRef"):
        if reference["name"]["instance_id"] is None or reference["span"]["source"] not in model.sources:
            continue  # an iterator, or made by rumoca
        written = plain(model.text(reference["span"]))
        with suppress(UnknownError):
            if instances.means_member(written, scope):
                prefix, found = f"{scope.path}." if scope.path else "", reference["name"]["name"]
                inner = plain(found.removeprefix(prefix))
                # It may go on with a member of a record, or be followed by one.
                is_same = f"{inner}.".startswith(f"{written}.") or f"{written}.".startswith(f"{inner}.")
                if not (found.startswith(prefix) and is_same) and not instances.is_through_outer(
                    plain(prefix + written)
                ):
                    yield f"{written} means {found} instead of {prefix}{written}"


def mistaken_numbers(model: LoweredModel, instances: Variables, scope: Scope, tree: Any) -> Iterator[str]:
    """Yield numbers that rumoca has written for names of variables and constants, if these have others."""
    for span, value in _numbers(model, tree):
        if span["source"] not in model.sources or not scope.around.contains(
            span["source"], model.offset(span)
        ):
            continue  # It stands in the declaration of a function or constant.
        written = model.text(span)
        if NAME.fullmatch(written):
            with suppress(UnknownError):
                meant = instances.value_of(tuple(TOKEN.findall(written)), scope)
                if not is_one_of(value, meant) and not is_iterator(model, scope.around, written):
                    yield f"{written} is not {value:g}"


def _numbers(model: LoweredModel, tree: Any) -> Iterator[tuple[Span, float]]:
    """Yield the numbers in an expression, and those of the literals of enumerations, with their places."""
    for literal in expressions(tree, "Literal"):
        value = next(iter(literal["value"].values()))
        if not isinstance(value, str):
            yield literal["span"], value
    ordinals = model.flat["enum_literal_ordinals"]
    for reference in expressions(tree, "VarRef"):
        if reference["name"]["name"] in ordinals:
            yield reference["span"], ordinals[reference["name"]["name"]]


class _Comparison:
    """Compares the equations of one class with those that rumoca gives to a component of it."""

    def __init__(
        self, model: LoweredModel, instances: Variables, scope: Scope, found: Sequence[_Compiled]
    ) -> None:
        self._model = model
        self._instances = instances
        self._scope = scope
        self._found = found

    def of(self, section: Section, unknown: list[Text]) -> Iterator[Difference]:
        """Yield what is wrong with the equations of a section."""
        try:
            inner = statements(section)
        except SyntaxError:
            unknown.append(Text(self._scope, section.tokens))
            if section.places:
                yield from self._by_names(section.places[0], section.places[-1])
            return
        for one in inner:
            if isinstance(one, Equation | Branches | Loop):
                yield from self._statement(section, one, unknown)

    def _statement(
        self, section: Section, one: Equation | Branches | Loop, unknown: list[Text]
    ) -> Iterator[Difference]:
        compiled = [each for found in self._between(one.start, one.end) for each in found.residuals]
        tokens = section.between(one.start, one.end)
        try:
            if not Residuals(self._model, self._instances, self._scope, compiled).differ(one):
                return
        except UnknownError as error:
            unknown.append(Text(self._scope, tokens, error.is_of_change))
            yield from self._by_names(one.start, one.end)
            return
        text = Text(self._scope, tokens)
        specific = [*self._by_names(one.start, one.end), *self._captured(text, one)]
        yield from specific
        if not specific:
            where = f" of {self._scope.path}" if self._scope.path else ""
            what = as_written(tokens).removesuffix(";")
            fate = "differs in the compiler's reading" if compiled else "is lost"
            yield f"the equation {what}{where} {fate}", self._span(one.start, one.end)

    def _captured(self, text: Text, one: Equation | Branches | Loop) -> Iterator[Difference]:
        for difference, _ in captured_names(self._instances, [text]):
            yield (
                f"{difference}, because the compiler looks it up there first",
                self._span(one.start, one.end),
            )

    def _between(self, start: int, end: int) -> list[_Compiled]:
        return [one for one in self._found if start <= one.offset < end]

    def _by_names(self, start: int, end: int) -> Iterator[Difference]:
        """Yield the names and numbers that are not what the source means."""
        for one in self._between(start, end):
            for check in (mistaken_names, mistaken_numbers):
                for difference in check(self._model, self._instances, self._scope, one.equation["residual"]):
                    yield difference, one.equation["span"]

    def _span(self, start: int, end: int) -> Span:
        return self._model.span(self._scope.around.file, start, end)
