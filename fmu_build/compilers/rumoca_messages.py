"""Explain rumoca's messages in Modelica's terms, and find the source constructs that cause them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from fmu_build.modelica_source.constructs import Construct, ModelText
from fmu_build.support.errors import BuildError, ModelicaError, UnsupportedModelError

_NAME = r"(?:[^`']*\.)?(?P<name>\w+)(?:\[[^`'.]*\])?"
"""The last part of a qualified name, as written in the source."""

_VARIABLE = r"\s*\w+(?:\[[^\[\]]*\])?(?:\.\w+(?:\[[^\[\]]*\])?)*\s*"


@dataclass(frozen=True, slots=True)
class Meaning:
    """The explanation of a message.

    `message` is a pattern; `says` may use its named groups. `constructs` are patterns of possible causes in
    the source, most likely first, in which NAME stands for the group ``name``. `called` is set if the
    explanation begins with the construct itself; it replaces the construct if several different ones match.
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
        return source.find([pattern.replace("NAME", name) for pattern in self.constructs])

    def text(self, message: str, found: Sequence[Construct]) -> str:
        """Return the explanation, given the constructs found."""
        match = re.search(self.message, message)
        told = self.says.format(**match.groupdict()) if match is not None else self.says
        texts = {construct.text for construct in found}
        subject = texts.pop() if len(texts) == 1 else self.called
        return f"{subject}: {told}" if self.called else told


MEANINGS = (
    Meaning(
        r"`derivative expression`",
        UnsupportedModelError,
        "der() is supported for variables, not for expressions or members of the elements of an array; "
        "differentiate a variable that is equal to it",
        (rf"\bder\s*\((?!{_VARIABLE}\))", r"\bder\s*\((?=[\w\s.]*\[[^\[\]]*\]\s*\.)"),
        "der(...)",
    ),
    Meaning(
        r'feature: "derivative target"',
        UnsupportedModelError,
        "the derivative of an input, or of another variable that cannot become a state, is not supported",
        (),
        "der(...)",
    ),
    Meaning(
        r"unresolved Flat reference `(?P<name>spatialDistribution)`",
        UnsupportedModelError,
        "{name}() is not supported",
        (r"\bNAME\s*(?=\()",),
    ),
    Meaning(
        r"`function return`",
        UnsupportedModelError,
        "a return inside a loop or a nested branch of a function is not supported",
        (r"\breturn\b",),
    ),
    Meaning(
        rf"`function (?:loop reduction|statement)`: `{_NAME}`",
        UnsupportedModelError,
        "the function {name} has a statement that is not supported, such as a break, or a while loop whose "
        "condition depends on what it computes",
        (r"\bfunction\s+NAME\b",),
    ),
    Meaning(
        rf"sequential read of `{_NAME}`",
        UnsupportedModelError,
        "an algorithm section that uses the value of `{name}` and then assigns it again is not supported; "
        "use a separate variable for the first value",
        (r"(?<![\w.])NAME\s*(?:\[[^\[\]]*\]\s*)?(?=:=)",),
    ),
    Meaning(
        r"unsupported model algorithm",
        UnsupportedModelError,
        "this algorithm section is not supported; assign every variable once, or write a function",
        (r"\balgorithm\b",),
    ),
    Meaning(
        r"owned by clock identity",
        UnsupportedModelError,
        "a when-clause that has sample() in one branch and a different condition in another is not supported",
        (r"\belsewhen\b[^;]*?\bsample\s*\(", r"\belsewhen\b"),
        "elsewhen",
    ),
    Meaning(
        r"`(?:history operator|pre) expression`: (?P<name>\w+)\(\.\.\.\) must have exactly one",
        ModelicaError,
        "{name}() applies to variables, not to expressions",
        (rf"\bNAME\s*\((?!{_VARIABLE}\))",),
        "edge(...), pre(...) or change(...)",
    ),
    Meaning(
        r"`change expression`: change\(\.\.\.\) must name a discrete coordinate",
        ModelicaError,
        "change() applies to discrete variables only",
        (r"\bchange\s*\(",),
        "change(...)",
    ),
    Meaning(
        rf"`pre expression`: pre\(`{_NAME}`",
        ModelicaError,
        "pre() of the continuous variable {name} is allowed only inside a when-clause",
        (r"\bpre\s*\(\s*(?:[\w.]+\.)?NAME\s*(?:\[[^\[\]]*\])?\s*\)",),
        "pre(...)",
    ),
    Meaning(
        rf"reinit\(\) can only be applied to state variables: {_NAME}",
        ModelicaError,
        "reinit() can be applied to states only: {name} is not a state",
        (r"\breinit\s*\((?=\s*(?:[\w.]+\.)?NAME\s*[,\[])",),
        "reinit(...)",
    ),
    Meaning(
        r"duplicate discrete \w+ when owner",
        ModelicaError,
        "a discrete variable is assigned in two when-clauses",
    ),
    Meaning(
        rf"`{_NAME}` participates in an internal current-value dependency cycle",
        UnsupportedModelError,
        "the when-clause that sets `{name}` reads the value that it sets, which is not supported; "
        "write pre({name})",
        (r"(?<![\w.])NAME\s*=(?!=)",),
    ),
    Meaning(
        rf"`{_NAME}` participates in a current-value dependency cycle",
        ModelicaError,
        "the discrete variable `{name}` depends on itself at the same instant",
        (r"(?<![\w.])NAME\s*(?:\[[^\[\]]*\]\s*)?:?=",),
    ),
    Meaning(
        rf"redeclaration of `{_NAME}` violates constrainedby: "
        r"`(?P<new>[^`]+)` is not a subtype of `(?P<old>[^`]+)`",
        UnsupportedModelError,
        "{new} cannot replace {old}: supported are classes that extend the one that they replace",
        (r"\bredeclare\s[^;]*?\bNAME\b",),
    ),
    Meaning(
        r"if-equation branches have mismatched equation counts",
        ModelicaError,
        "the branches of an if-equation have different numbers of equations",
    ),
    Meaning(
        rf"`{_NAME}` cannot be evaluated: division by zero",
        ModelicaError,
        "the value of {name} is divided by zero",
        (r"(?<![\w.])NAME\s*(?=[=(])",),
    ),
    Meaning(
        r"missing source scope for imports",
        UnsupportedModelError,
        "omitting the first result of a function is not supported; assign it to a variable",
        (r"\((?=\s*,)",),
    ),
    Meaning(
        rf"`when assignment`: `{_NAME}` is not a discrete coordinate",
        UnsupportedModelError,
        "a when-clause that sets single elements of the array {name} is not supported; set the whole array, "
        "or declare an array of a model with the clause",
        (r"(?<![\w.])NAME\s*\[[^\[\]]*\]\s*=(?!=)",),
        only_there=True,
    ),
    Meaning(
        r"`history operator certificate`",
        UnsupportedModelError,
        "edge(), change() and pre() of what depends on the variable of a for-loop are not supported here; "
        "declare an array of a model with the when-clause",
        (r"\b(?:edge|change|pre)\s*\((?=[^()]*\[)",),
        "edge(...), change(...) or pre(...)",
    ),
    Meaning(
        r"duplicate reinitialization owner",
        ModelicaError,
        "two when-clauses reinitialize one variable; the branches of one clause may, with elsewhen",
        (r"\breinit\s*\(",),
        "reinit(...)",
    ),
    Meaning(
        rf"`multi-output equation`: `{_NAME}` returns (?P<all>\d+) values but the receiving tuple has "
        r"(?P<few>\d+)",
        UnsupportedModelError,
        "{few} of the {all} results of {name} are taken, which is not supported; assign each to a variable",
        (r"\(?[\w\s,.\[\]]*\)\s*=\s*(?:\w+\.)*NAME\s*\(",),
    ),
    Meaning(
        r"unsupported runtime operator `(?P<name>\w+)`",
        UnsupportedModelError,
        "{name}() is not supported",
        (r"(?<![\w.])NAME\s*(?=\()",),
    ),
    Meaning(
        r"construction rejected an invalid operation: expected a numeric expression, found Enumeration",
        UnsupportedModelError,
        "Integer() of an enumeration that is not a parameter is not supported; compare it, or use it as an "
        "index",
        (r"\bInteger\s*\(",),
        "Integer(...)",
        only_there=True,
    ),
    Meaning(
        r"construction rejected an invalid operation: expected a numeric expression, found (?P<kind>\w+)",
        UnsupportedModelError,
        "an equation for a value of type {kind} is not supported here; replace an initial equation "
        "pre(v) = ... by v(start = ..., fixed = true)",
        (r"\bpre\s*\([^()]*\)\s*=(?!=)",),
    ),
    Meaning(
        r"unbalanced model",
        UnsupportedModelError,
        "operator records are not supported",
        (r"\boperator\s+record\b",),
        only_there=True,
    ),
    Meaning(r"(?P<all>unbalanced model: \d+ equations, \d+ unknowns)", ModelicaError, "{all}"),
    Meaning(
        rf"(?P<all>connector '{_NAME}' is unbalanced: .*)",
        ModelicaError,
        "{all}",
        (r"\bconnector\s+NAME\b",),
    ),
)


def meaning_of(message: str, source: ModelText) -> Meaning | None:
    """Return the explanation of a message about a source, or None if there is none."""
    meanings = (meaning for meaning in MEANINGS if re.search(meaning.message, message))
    return next((m for m in meanings if not m.only_there or m.search(message, source)), None)
