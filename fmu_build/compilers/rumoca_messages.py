"""Explain rumoca's messages in Modelica's terms, and find the source constructs that cause them."""

from __future__ import annotations

import re

from fmu_build.compilers.rumoca_connections import CONNECTIONS_AND_COUNTS
from fmu_build.compilers.rumoca_meaning import QUALIFIED, Meaning
from fmu_build.modelica_source.constructs import ModelText
from fmu_build.support.errors import ModelicaError, UnsupportedModelError

_VARIABLE = r"\s*\w+(?:\[[^\[\]]*\])?(?:\.\w+(?:\[[^\[\]]*\])?)*\s*"

MEANINGS = (
    *CONNECTIONS_AND_COUNTS,
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
        rf"reference to non-constant variable '{QUALIFIED}' from a lexically nested class",
        UnsupportedModelError,
        "`{name}` is used in a class that is declared in a model: it cannot be a variable of that model, and "
        "a model that extends a class of its own is not supported; declare the class beside the model",
        (),
    ),
    Meaning(
        r"`function return`",
        UnsupportedModelError,
        "a return inside a loop or a nested branch of a function is not supported",
        (r"\breturn\b",),
    ),
    Meaning(
        rf"`function (?:loop reduction|statement)`: `{QUALIFIED}`",
        UnsupportedModelError,
        "the function {name} has a statement that is not supported, such as a break, or a while loop whose "
        "condition depends on what it computes",
        (r"\bfunction\s+NAME\b",),
    ),
    Meaning(
        rf"sequential read of `{QUALIFIED}`",
        UnsupportedModelError,
        "an algorithm section that uses the value of `{name}` and then assigns it again, or assigns other "
        "variables too, is not supported; use a variable for the first value, and a section for each",
        (r"(?<![\w.])NAME\s*(?:\[[^\[\]]*\]\s*)?(?=:=)",),
    ),
    Meaning(
        r"unsupported model algorithm",
        UnsupportedModelError,
        "this algorithm section is not supported: outside of when-clauses one sets a single variable that is "
        "no array, without loops and in each branch, and when-clauses have no loops and no reinit(); write a "
        "section for each variable, equations, or a function",
        (r"\balgorithm\b",),
    ),
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
        r"conditional component `(?P<name>\w+)` requires parameter expression",
        UnsupportedModelError,
        "the condition of {name} is not evaluated; supported are parameters that are no arrays",
        (r"(?<![\w.])NAME\s+if\b[^;]*\[", r"(?<![\w.])NAME\s+if\b[^;]*"),
        only_there=True,
    ),
    Meaning(
        r"unresolved Flat reference `\w+`|an assertion level must name a predefined",
        UnsupportedModelError,
        "the level of an assertion cannot be a parameter; write AssertionLevel.error or .warning",
        (r"\bAssertionLevel\s+\w+",),
        only_there=True,
    ),
    Meaning(
        r"unresolved Flat reference `(?P<name>\w+)`",
        UnsupportedModelError,
        "a function of {name} inside of a sum, product, max or min over {name} is not supported; give its "
        "values to an array first",
        (r"\b(?:sum|product|max|min)\s*\((?=[^;]*\bfor\s+NAME\s+in\b)",),
        only_there=True,
    ),
    Meaning(
        r"unresolved Flat reference `(?P<name>\w+)`",
        UnsupportedModelError,
        "an equation for the whole array of records {name} is not supported; write one for each element",
        (r"(?<![\w.])NAME\s*=\s*\{", r"=\s*NAME\s*(?=;)"),
        only_there=True,
    ),
    Meaning(
        r"unresolved Flat reference `(?P<whole>(?:[^`]*\.)?(?P<name>\w+)\.\w+)`",
        UnsupportedModelError,
        "{whole}: members of a record that is a constant of a package are not supported; declare it in the "
        "model, or its members as constants",
        (r"\bconstant\s+[\w.]+\s+NAME\b",),
        only_there=True,
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
        r"`change expression`: change\(\.\.\.\) must name a discrete coordinate",
        ModelicaError,
        "change() applies to discrete variables only",
        (r"\bchange\s*\(",),
        "change(...)",
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
        rf"`{QUALIFIED}` participates in a current-value dependency cycle",
        ModelicaError,
        "the discrete variable `{name}` depends on itself at the same instant",
        (r"(?<![\w.])NAME\s*(?:\[[^\[\]]*\]\s*)?:?=",),
    ),
    Meaning(
        rf"redeclaration of `{QUALIFIED}` violates constrainedby: "
        r"`(?P<new>[^`]+)` is not a subtype of `(?P<old>[^`]+)`",
        UnsupportedModelError,
        "{new} cannot replace {old}: supported are classes that extend the one that they replace",
        (r"\bredeclare\s[^;]*?\bNAME\b",),
    ),
    Meaning(
        r"if-equation branches have mismatched equation counts",
        UnsupportedModelError,
        "a for-loop in a branch of an if-equation counts as one equation, so that the branches seem to have "
        "different numbers of them; write loops in all branches, or if-expressions",
        (r"\b(?:then|else)\s+for\b[^;]*\bloop\b",),
        only_there=True,
    ),
    Meaning(
        r"tuple lowering requires its typed semantic owner",
        UnsupportedModelError,
        "taking several results of a function is not supported in a branch; do so in an equation of its own",
        (r"\([\w\s,.]*,[\w\s,.]*\)\s*=(?!=)",),
    ),
    Meaning(
        r"selected redeclare class is absent",
        UnsupportedModelError,
        "redeclaring a type with attributes in a modifier is not supported; declare the type and name it: "
        "redeclare type T = Other",
        (r"\bredeclare\s+type\s+\w+",),
    ),
    Meaning(
        r"`(?P<name>\w+)` cannot be evaluated: type mismatch: expected Integer, got Real",
        UnsupportedModelError,
        "the value of {name} is a range of numbers that are not whole, which is not supported; write it out",
        (r"(?<![\w.])NAME\s*(?:\[[^\[\]]*\]\s*)?=[^;:]*:",),
        only_there=True,
    ),
    Meaning(
        r"unsupported function '(?P<name>[^']+)' in when-equation",
        UnsupportedModelError,
        "calling the function {name} alone in a when-clause is not supported; use its result, or write its "
        "assertions there",
    ),
    Meaning(
        r"function loop domain",
        UnsupportedModelError,
        "loops of functions run over ranges of whole numbers, as 1:n; give other values to an array first",
        (r"\bfor\s+\w+\s+in\s+(?=\{)",),
        only_there=True,
    ),
    Meaning(
        r"function loop domain",
        UnsupportedModelError,
        "a loop of a function whose bounds depend on the arguments is not supported; give it a fixed number "
        "of passes, and conditions in it",
        (r"\bfor\s+\w+\s+in\b",),
    ),
    Meaning(
        r"input slot `(?P<name>\w+)` is filled more than once",
        UnsupportedModelError,
        "calling a function whose default value of {name} was changed in a short class is not supported with "
        "another {name}; call the function itself",
        (r"\bfunction\s+\w+\s*=\s*[\w.]+\s*\([^;]*\bNAME\s*=",),
        only_there=True,
    ),
    Meaning(
        r"unresolved Flat reference `(?:[^`]*\.)?(?P<name>\w+)\.(?P<member>\w+)`",
        UnsupportedModelError,
        "{name}.{member}, a member of all elements of a matrix of components, is not supported; write the "
        "elements out",
        (r"(?<![\w.])NAME\s*\[[^\[\]]*,[^\[\]]*\]\s*(?=[;(\"])",),
        only_there=True,
    ),
    Meaning(
        r"a discrete-valued equation must have one unsubscripted resolved coordinate as its left-hand side",
        UnsupportedModelError,
        "an equation for an unknown that stands beside an Integer or a Boolean is taken for a discrete one; "
        "solve it for the unknown, as x = time/n",
    ),
    Meaning(
        r"if-equation branches have mismatched equation counts",
        ModelicaError,
        "the branches of an if-equation have different numbers of equations",
    ),
    Meaning(
        rf"`{QUALIFIED}` cannot be evaluated: division by zero",
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
        rf"`multi-output equation`: `{QUALIFIED}` returns (?P<all>\d+) values but the receiving tuple has "
        r"(?P<few>\d+)",
        UnsupportedModelError,
        "{few} of the {all} results of {name} are taken, which is not supported; assign each to a variable",
        (r"\(?[\w\s,.\[\]]*\)\s*=\s*(?:\w+\.)*NAME\s*\(",),
    ),
    Meaning(
        r"indices require an explicit range",
        UnsupportedModelError,
        "a for-loop needs a range here, as in for i in 1:n",
        (r"\bfor\s+\w+\s+(?=loop\b)",),
    ),
    Meaning(
        r"`end` is only valid inside an array subscript",
        UnsupportedModelError,
        "end is not supported in this subscript; write the size of the array, size(v, 1)",
        (r"\[[^\[\]]*\bend\b[^\[\]]*\]",),
    ),
    Meaning(
        r"unresolved clock schedule",
        UnsupportedModelError,
        "clocks are not supported; write when sample(start, period) then",
        (r"\bClock\s*\(",),
    ),
    Meaning(
        r"conflicting definitions of `(?P<name>\w+)` from `previous base`|missing structured identity",
        UnsupportedModelError,
        "this redeclaration of an inherited component is not supported as an element of a class; write it in "
        "the extends-clause: extends Base(redeclare ...)",
        (r"(?<![,(]\s)(?<![,(])\bredeclare\s+(?!model\b|package\b|function\b)[\w.]+\s+\w+",),
        only_there=True,
    ),
    Meaning(
        r"unresolved Flat reference `(?P<name>sum|product|min|max|abs|size|cross|transpose)`",
        UnsupportedModelError,
        "{name}() in the value of a constant is not supported; write the value",
        (r"\bconstant\b[^;]*=[^;]*?\bNAME\s*\(",),
        only_there=True,
    ),
    Meaning(
        r"impure function `Modelica\.Math\.Random\.\S*` is called from a pure function",
        UnsupportedModelError,
        "the impure random numbers of Modelica.Math.Random.Utilities, which its blocks of noise take for "
        "their seeds, are not supported; give the noise as an input or a table",
    ),
    Meaning(
        r"impure function `(?:[^`]*\.)?(?P<name>\w+)` is called from a pure function",
        ModelicaError,
        "a function that calls the impure function {name} must be impure itself",
        (r"(?<![\w.])NAME\s*(?=\()",),
    ),
    Meaning(
        r"multi-output event calls",
        UnsupportedModelError,
        "taking several results of a function is not supported in a when-clause; write a function for each",
        (r"\([\w\s,.\[\]]*,[\w\s,.\[\]]*\)\s*:?=(?!=)",),
    ),
    Meaning(
        r"a receiving tuple slot must receive one whole function result",
        UnsupportedModelError,
        "elements of arrays cannot take the results of a function; give these to variables first",
        (r"\([\w\s,.\[\]]*\[[^()]*\)\s*:?=(?!=)",),
    ),
    Meaning(
        r"unsupported runtime operator `(?P<name>div|mod|rem)`",
        UnsupportedModelError,
        "{name}() with a divisor that changes is not supported; express it by floor(x/y)",
        (r"(?<![\w.])NAME\s*(?=\()",),
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
        r"construction rejected an invalid operation: expected a numeric expression, found Enumeration",
        UnsupportedModelError,
        "max() and min() of enumerations are not supported; use their numbers or if-expressions",
        (r"\b(?:max|min)\s*\(",),
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
        r"expression shape mismatch",
        UnsupportedModelError,
        "sign() has a Real value here, which an Integer does not take; write integer(sign(...))",
        (r"\bInteger\s+(?=(\w+)\b[^;]*(?:;[\s\S]{0,4000}?(?<![\w.])\1\s*)?=\s*-?\s*sign\s*\()",),
        only_there=True,
    ),
    Meaning(
        r"expression shape mismatch",
        UnsupportedModelError,
        "the elements of an array of components take arrays from a literal of braces only; write "
        "(x = {{{{1, 2}}, {{3, 4}}}})",
        (r"\b\w+\s*\[[^\[\]]*\]\s*\((?=[^;{]*\w\s*=\s*(?:\[|\w+\s*[,)]))",),
        only_there=True,
    ),
    Meaning(
        r"expression shape mismatch",
        UnsupportedModelError,
        "the size of an array does not fit, or the compiler does not find it; write the array out, as "
        "{{a, b}}, and with one iterator for each pair of braces",
        (
            r"\{[^{}]*\bfor\b[^{}]*,[^{}]*\bin\b[^{}]*\}",
            r"\(\s*(?:each\s+)?\w+\s*=\s*(?!\{[^{}]*\}\s*[,)])[^,()]*[:*+({][^;]*",
        ),
    ),
    Meaning(
        r"expression type mismatch: expected Real, found Integer",
        UnsupportedModelError,
        "Integer values are not converted to Real in every place; write 1.0 for 1",
        (r"\b(?:cross|skew|outerProduct)\s*\(",),
    ),
    Meaning(
        r"an empty array needs an explicit checked element type",
        UnsupportedModelError,
        "sums, products and arrays over an empty range are not supported",
        (r"\bin\s+[\w.+*/() -]*:[\w.+*/ -]*",),
    ),
    Meaning(
        r"missing function value definition for identity",
        UnsupportedModelError,
        "a function takes the size of a local array for the value of another local variable, which is not "
        "supported",
        (r"=\s*size\s*\(",),
        only_there=True,
    ),
    Meaning(
        r"missing function value definition for identity",
        UnsupportedModelError,
        "a function gives one of its variables a value by another one that is declared after it; assign it "
        "in the algorithm",
        (r"\bfunction\b",),
    ),
    Meaning(
        r"for-equation range must be a constant range|array comprehension domain|range st(?:ep|art)",
        UnsupportedModelError,
        "ranges have whole numbers, as 1:n; iterators over arrays and enumerations are not supported",
        (r"\bin\s+(?![\w.+*/() -]*:)[\w.{]+",),
    ),
    Meaning(
        r"missing exact function-selection identity",
        UnsupportedModelError,
        "which function is called through a redeclared class is not clear here; write its full name",
        (r"\bredeclare\s+(?:replaceable\s+)?(?:package|function)\s+\w+",),
    ),
    Meaning(
        r"unresolved type reference: '(?P<whole>(?:[\w.]+\.)?(?P<name>\w+)\.\w+)'",
        UnsupportedModelError,
        "{whole}: an inherited class is found only where it is declared; write its own full name",
        (r"\b(?:model|block|package)\s+NAME\b[^;]*\bextends\b",),
        only_there=True,
    ),
    Meaning(
        r"missing source context: .* binding type compatibility",
        UnsupportedModelError,
        "a literal of an enumeration is taken for a variable of the same name; rename one of them",
        (r"\btype\s+\w+\s*=\s*enumeration\b",),
        only_there=True,
    ),
    Meaning(
        r"named argument `(?P<name>\w+)` does not match any input",
        UnsupportedModelError,
        "the base class of a function is given a value for {name}, which is no input; this is not supported",
        (r"\bextends\s+[\w.]+\s*\((?=[^;]*\bNAME\s*=)",),
        only_there=True,
    ),
)


def meaning_of(message: str, source: ModelText) -> Meaning | None:
    """Return the explanation of a message about a source, or None if there is none."""
    meanings = (meaning for meaning in MEANINGS if re.search(meaning.message, message))
    return next((m for m in meanings if not m.only_there or m.search(message, source)), None)
