"""What rumoca's messages about declarations, arrays and expressions mean."""

from __future__ import annotations

from fmu_build.compilers.rumoca_messages.meaning import QUALIFIED, Meaning
from fmu_build.support.errors import ModelicaError, UnsupportedModelError

_VARIABLE = r"\s*\w+(?:\[[^\[\]]*\])?(?:\.\w+(?:\[[^\[\]]*\])?)*\s*"

DECLARATIONS = (
    Meaning(
        r"unknown modifier `(?P<modifier>\w+)` for component `(?P<name>\w+)`",
        UnsupportedModelError,
        "the redeclared {name} gets the modifier {modifier} of the declaration, although this has a "
        "constraining clause; leave it out, and give a value where {name} is used",
        (r"\breplaceable\b[^;]*\bNAME\s*\((?=[^;]*\bconstrainedby\b)",),
        only_there=True,
    ),
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
        r"selected redeclare class is absent",
        UnsupportedModelError,
        "redeclaring a type with attributes in a modifier is not supported; declare the type and name it: "
        "redeclare type T = Other",
        (r"\bredeclare\s+type\s+\w+",),
    ),
    Meaning(
        r"`(?P<name>\w+)` cannot be evaluated: type mismatch: expected numeric or array, got Array",
        UnsupportedModelError,
        "the value of the parameter {name} is not supported: a function with several results within an "
        "expression, or a sum of an array and a number; give the result to a parameter of its own first",
        (r"\bparameter\s+\w+\s+(?=NAME\b)",),
    ),
    Meaning(
        r"`(?P<name>\w+)` cannot be evaluated: type mismatch: expected Integer, got Real",
        UnsupportedModelError,
        "the value of {name} is a range of numbers that are not whole, which is not supported; write it out",
        (r"(?<![\w.])NAME\s*(?:\[[^\[\]]*\]\s*)?=[^;:]*:",),
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
        (
            r"\bInteger\s+(?=(\w+)\b[^;]*(?:;[\s\S]{0,4000}?(?<![\w.])\1\s*)?=(?!=)[^;<>]*?(?<![\w.])sign\s*\()",
        ),
        only_there=True,
    ),
    Meaning(
        r"duplicate initial parameter value definition",
        UnsupportedModelError,
        "pre(...) of a parameter with fixed = false, as an initial equation, is not supported; give the "
        "variable the value that the parameter gets",
        (r"\bpre\s*\(\s*[\w.]+\s*\)\s*=(?!=)",),
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
        "{{a, b}}, and with one iterator for each pair of braces; an Integer cannot equal a Real expression",
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
        r"range start`?: the canonical compact range requires an integer literal",
        UnsupportedModelError,
        "a loop that sets elements of an array starts at a number; write for i in 1:n, with an if inside",
        (r"\bfor\s+\w+\s+in\s+(?!\d+\s*:)[^:;]*:", r"\bfor\s+\w+\s+in\s+\w+\s*:[^:;]*:"),
    ),
    Meaning(
        r"for-equation range must be a constant range|array comprehension domain|range st(?:ep|art)",
        UnsupportedModelError,
        "ranges have whole numbers, as 1:n; iterators over arrays and enumerations are not supported",
        (r"\bin\s+(?![\w.+*/() -]*:)[\w.{]+",),
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
        r"missing source context: .* for component binding type compatibility",
        UnsupportedModelError,
        "the compiler takes a value for one of another type than its parameter; if it is of the same type, a "
        "name in it is also that of an element of the component that it is given to: rename one of them",
    ),
)
