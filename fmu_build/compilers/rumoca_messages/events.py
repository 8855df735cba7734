"""What rumoca's messages about when-clauses, samples and discrete variables mean."""

from __future__ import annotations

from fmu_build.compilers.rumoca_messages.meaning import QUALIFIED, Meaning
from fmu_build.support.errors import ModelicaError, UnsupportedModelError

_VARIABLE = r"\s*\w+(?:\[[^\[\]]*\])?(?:\.\w+(?:\[[^\[\]]*\])?)*\s*"

EVENTS = (
    Meaning(
        r"initial algorithm target `(?:[^`']*\.)?(?P<name>\w+)` has role",
        UnsupportedModelError,
        "an initial algorithm can set discrete variables and parameters with fixed = false; write an initial "
        "equation for {name}",
        (r"(?<![\w.])NAME\s*(?=:=)",),
    ),
    Meaning(
        r"duplicate condition clock owner",
        UnsupportedModelError,
        "a when-clause with several sample() in its condition is not supported; sample at a common period "
        "and count",
        (r"\bwhen\s*\{[^{}]*\bsample\s*\([^{}]*\}",),
    ),
    Meaning(
        r"owned by clock identity",
        UnsupportedModelError,
        "a when-clause that has sample() in one branch and a different condition in another is not supported",
        (r"\belsewhen\b[^;]*?\bsample\s*\(", r"\belsewhen\b"),
        "elsewhen",
        only_there=True,
    ),
    Meaning(
        r"owned by clock identity",
        UnsupportedModelError,
        "a when-clause with sample() that reads what a clause with another sample() sets is not supported; "
        "write one clause for both",
        (r"\bwhen\b[^;]*?\bsample\s*\(",),
    ),
    Meaning(
        r"`(?:history operator|pre) expression`: (?P<name>\w+)\(\.\.\.\) must have exactly one",
        ModelicaError,
        "{name}() applies to variables, not to expressions",
        (rf"\bNAME\s*\((?!{_VARIABLE}\))",),
        "edge(...), pre(...) or change(...)",
    ),
    Meaning(
        rf"`pre expression`: pre\(`{QUALIFIED}`\) names an external input",
        UnsupportedModelError,
        "pre() of an input is not supported; declare Boolean b = {name}, or Integer, and write pre(b)",
        (r"\bpre\s*\(\s*(?:[\w.]+\.)?NAME\s*(?:\[[^\[\]]*\])?\s*\)",),
    ),
    Meaning(
        r"`(?P<name>change|edge) expression`: \w+\(\.\.\.\) must name a discrete coordinate",
        UnsupportedModelError,
        "{name}() of an input is not supported; give it to a variable, as in Boolean b = u, and write "
        "{name}(b)",
        (
            r"\binput\s+(?:Boolean|Integer)\s+(?=(?:[^;]*?,\s*)?(\w+)\b[^;]*;[\s\S]{0,4000}?"
            r"\bNAME\s*\(\s*\1\s*\))",
        ),
        only_there=True,
    ),
    Meaning(
        r"`(?P<name>change|edge) expression`: \w+\(\.\.\.\) must name a discrete coordinate",
        ModelicaError,
        "{name}() applies to discrete variables only",
        (r"\bNAME\s*\(",),
        "edge(...) or change(...)",
    ),
    Meaning(
        rf"`pre expression`: pre\(`{QUALIFIED}`",
        ModelicaError,
        "pre() of the continuous variable {name} is allowed only inside a when-clause",
        (r"\bpre\s*\(\s*(?:[\w.]+\.)?NAME\s*(?:\[[^\[\]]*\])?\s*\)",),
        "pre(...)",
    ),
    Meaning(
        rf"reinit\(\) can only be applied to state variables: {QUALIFIED}",
        UnsupportedModelError,
        "reinit() of single elements of an array is not supported; write reinit({name}, {{...}}) for the "
        "whole array or, in a for-loop, declare an array of a model with the when-clause",
        (r"\breinit\s*\((?=\s*(?:[\w.]+\.)?NAME\s*\[)",),
        only_there=True,
    ),
    Meaning(
        rf"reinit\(\) can only be applied to state variables: {QUALIFIED}",
        ModelicaError,
        "reinit() can be applied to states only: {name} is not a state",
        (r"\breinit\s*\((?=\s*(?:[\w.]+\.)?NAME\s*,)",),
        "reinit(...)",
    ),
    Meaning(
        rf"`{QUALIFIED}` has more than one semantic definition owner",
        ModelicaError,
        "the discrete variable {name} is determined more than once, as by two when-clauses; an equation that "
        "determines another variable by it has that variable on the left: x = {name}",
        (r"(?<![\w.])NAME\s*:?=(?!=)",),
    ),
    Meaning(
        r"duplicate discrete \w+ when owner",
        ModelicaError,
        "a discrete variable is assigned in two when-clauses",
    ),
    Meaning(
        rf"`{QUALIFIED}` participates in an internal current-value dependency cycle",
        UnsupportedModelError,
        "the when-clause that sets `{name}` reads the value that it sets, which is not supported; "
        "write pre({name})",
        (r"(?<![\w.])NAME\s*=(?!=)",),
    ),
    Meaning(
        r"analysis proves the exact comprehension occurrence",
        UnsupportedModelError,
        "an array comprehension, or a sum() or the like with an iterator, is not supported in a when-clause "
        "or a loop; give it to a variable outside",
        (r"[({](?=[^(){}]*\bfor\s+\w+\s+in\b)", r"\bfor\s+\w+\s+in\b"),
    ),
    Meaning(
        rf"`{QUALIFIED}` participates in a current-value dependency cycle",
        ModelicaError,
        "the discrete variable `{name}` depends on itself at the same instant",
        (r"(?<![\w.])NAME\s*(?:\[[^\[\]]*\]\s*)?:?=",),
    ),
    Meaning(
        r"a discrete-valued equation must have one unsubscripted resolved coordinate as its left-hand side",
        UnsupportedModelError,
        "an equation for an unknown that stands beside an Integer or a Boolean is taken for a discrete one; "
        "solve it for the unknown, as x = time/n",
    ),
    Meaning(
        rf"`when assignment`: `{QUALIFIED}` is not a discrete coordinate",
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
        r"unresolved clock schedule",
        UnsupportedModelError,
        "clocks are not supported; write when sample(start, period) then",
        (r"\bClock\s*\(",),
    ),
)
