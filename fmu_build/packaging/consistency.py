"""Requirements of FMI 2.0.4 on a model description beyond the XML schema (sections 2.2.7 to 2.2.9).

A violation is either a fault of the model, reported as a `ModelicaError`, or one of the compiler backend,
reported as a `BuildError` that calls itself an internal error.
"""

from __future__ import annotations

import math
import re
from collections import Counter

from fmu_build.support.description import Initial, ModelDescription, Unknown, Variable
from fmu_build.support.errors import BuildError, ModelicaError

_EXACT: tuple[Initial, ...] = ("exact",)
_COMPUTED: tuple[Initial, ...] = ("calculated", "approx")
_ANY: tuple[Initial, ...] = ("calculated", "exact", "approx")

# The values of `initial` allowed for a causality and a variability; () if the attribute must be absent.
ALLOWED_INITIAL: dict[tuple[str, str], tuple[Initial, ...]] = {
    ("parameter", "fixed"): _EXACT,
    ("parameter", "tunable"): _EXACT,
    ("calculatedParameter", "fixed"): _COMPUTED,
    ("calculatedParameter", "tunable"): _COMPUTED,
    ("input", "discrete"): (),
    ("input", "continuous"): (),
    ("output", "constant"): _EXACT,
    ("output", "discrete"): _ANY,
    ("output", "continuous"): _ANY,
    ("local", "constant"): _EXACT,
    ("local", "fixed"): _COMPUTED,
    ("local", "tunable"): _COMPUTED,
    ("local", "discrete"): _ANY,
    ("local", "continuous"): _ANY,
    ("independent", "continuous"): (),
}
_INT32 = 2**31

_UNQUOTED = r"[A-Za-z_]\w*"
_QUOTED = r"""'(?:[\w!#$%&()*+,\-./:;<>=?@\[\]^{}|~ ]|\\['"?\\abfnrtv])+'"""
_PART = rf"(?:{_UNQUOTED}|{_QUOTED})(?:\[\d+(?:,\d+)*\])?"
_IDENTIFIER = rf"{_PART}(?:\.{_PART})*"
# Structured names (section 2.2.9). FMPy validates them with a parser that takes half a second for forty
# names; the grammar is regular, so this pattern is equivalent.
STRUCTURED_NAME = re.compile(rf"{_IDENTIFIER}|der\({_IDENTIFIER}(?:,\d+)?\)", re.ASCII)


def check_description(description: ModelDescription) -> None:
    """Raise `BuildError` or `ModelicaError`, which names the variable and the violated rule."""
    identifier = description.identifier
    if not (identifier.isascii() and identifier.isidentifier()):
        raise BuildError(
            f"{description.model_name}: the class name {identifier!r} cannot name an FMU; "
            "allowed are ASCII letters, digits and '_', not starting with a digit"
        )
    repeated = [name for name, count in Counter(v.name for v in description.variables).items() if count > 1]
    if repeated:
        raise _internal(repeated[0], "the name is used more than once")
    for variable in description.variables:
        if not STRUCTURED_NAME.fullmatch(variable.name):
            raise ModelicaError(
                f"variable {variable.name!r}: FMI does not allow this name; allowed are Modelica names, "
                "also quoted ones, of ASCII characters"
            )
        _check_combination(variable)
        _check_start(variable)
        _check_range(variable)
        _check_links(variable, description.variables)
    for unknown in (*description.outputs, *description.derivatives, *description.initial_unknowns):
        _check_unknown(unknown, description.variables)
    _check_terminals(description)
    for unknown in description.initial_unknowns:
        if not set(unknown.dependency_kinds) <= {"dependent", "constant"}:
            name = description.variables[unknown.value_reference].name
            raise _internal(name, "initial unknowns have only dependencies of kind 'dependent' or 'constant'")


def _check_terminals(description: ModelDescription) -> None:
    connectable = ("input", "output", "parameter", "calculatedParameter")
    causalities = {variable.name: variable.causality for variable in description.variables}
    for terminal in description.terminals:
        for variable, _, _ in terminal.members:
            if causalities.get(variable) not in connectable:
                raise ModelicaError(
                    f"terminal {terminal.name!r}: {variable!r} is not an input, output or parameter "
                    "of the model"
                )


def _check_combination(variable: Variable) -> None:
    key = (variable.causality, variable.variability)
    if key not in ALLOWED_INITIAL:
        raise _internal(variable.name, f"causality {key[0]!r} cannot have variability {key[1]!r}")
    allowed = ALLOWED_INITIAL[key]
    if variable.initial not in (allowed or (None,)):
        listed = ", ".join(map(repr, allowed)) or "none"
        raise _internal(variable.name, f"initial {variable.initial!r} with {key}; allowed: {listed}")
    if variable.variability == "continuous" and variable.type != "Real":
        raise _internal(variable.name, f"a variable of type {variable.type} cannot be continuous")


def _check_start(variable: Variable) -> None:
    has_start = variable.start is not None
    needs_start = variable.initial in ("exact", "approx") or variable.causality == "input"
    if has_start != needs_start:
        demand = "needs a" if needs_start else "must not have a"
        raise _internal(variable.name, f"a variable with initial {variable.initial!r} {demand} start value")
    if variable.start is None:
        return
    if not math.isfinite(variable.start):
        raise ModelicaError(f"variable {variable.name!r}: the start value {variable.start} is not finite")
    whole = variable.start == int(variable.start) and -_INT32 <= variable.start < _INT32
    if variable.type in ("Integer", "Enumeration") and not whole:
        raise ModelicaError(
            f"variable {variable.name!r}: the start value {variable.start} is not a 32-bit integer"
        )


def _check_range(variable: Variable) -> None:
    low = -math.inf if variable.minimum is None else variable.minimum
    high = math.inf if variable.maximum is None else variable.maximum
    if not low <= high:
        raise ModelicaError(f"variable {variable.name!r}: min = {low} is above max = {high}")
    default = variable.start if variable.causality in ("parameter", "input") else None
    if default is not None and not low <= default <= high:
        raise ModelicaError(
            f"variable {variable.name!r}: the default value {default} is outside [{low}, {high}]"
        )
    if variable.nominal is not None and not (variable.nominal > 0 and math.isfinite(variable.nominal)):
        raise ModelicaError(
            f"variable {variable.name!r}: nominal = {variable.nominal}, but it must be positive and finite"
        )


def _check_links(variable: Variable, variables: tuple[Variable, ...]) -> None:
    if (variable.type == "Enumeration") != (variable.enumeration is not None):
        raise _internal(variable.name, "enumeration variables, and only they, have an enumeration type")
    if variable.derivative_of is None:
        return
    if not 0 <= variable.derivative_of < len(variables):
        raise _internal(variable.name, f"derivative of unknown value reference {variable.derivative_of}")
    if not variable.type == variables[variable.derivative_of].type == "Real":
        raise _internal(variable.name, "only Real variables have derivatives")


def _check_unknown(unknown: Unknown, variables: tuple[Variable, ...]) -> None:
    references = (unknown.value_reference, *unknown.dependencies)
    if not all(0 <= reference < len(variables) for reference in references):
        raise BuildError(f"internal error: model structure refers to unknown variables in {references}")
    name = variables[unknown.value_reference].name
    if list(unknown.dependencies) != sorted(set(unknown.dependencies)):
        raise _internal(name, "dependencies must be in ascending order, each once")
    if len(unknown.dependencies) != len(unknown.dependency_kinds):
        raise _internal(name, "every dependency needs its kind")


def _internal(name: str, rule: str) -> BuildError:
    return BuildError(f"internal error: variable {name!r}: {rule}")
