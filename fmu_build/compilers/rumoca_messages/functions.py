"""What rumoca's messages about functions and algorithms mean."""

from __future__ import annotations

from fmu_build.compilers.rumoca_messages.meaning import QUALIFIED, Meaning
from fmu_build.support.errors import ModelicaError, UnsupportedModelError

FUNCTIONS = (
    Meaning(
        r"type mismatch: expected `[^`]+`, found `(?:[^`]*\.)?(?P<name>\w+)`",
        UnsupportedModelError,
        "the compiler counts final and constant members among the arguments of a record; name the arguments",
        (r"(?<![\w.])(?:\w+\s*\.\s*)*RECORD\s*\((?!\s*\w+\s*=)[^;]*(?<![\w.])NAME\s*\(",),
        only_there=True,
        needs=r"\brecord\b(?:(?!\bend\b)[\s\S])*?\b(?:final|constant)\b",
    ),
    Meaning(
        r"type mismatch: expected `(?P<base>[^`]+)`, found `(?:[^`]*\.)?(?P<name>\w+)`",
        UnsupportedModelError,
        "the function {name} as an argument is supported only if it extends {base}, which is partial",
        (r"\bfunction\s+NAME\s*(?=\()",),
        only_there=True,
    ),
    Meaning(
        r"'(?P<name>\w+)' is a class, not a variable; cannot be used as a value",
        UnsupportedModelError,
        "a function as an argument is supported only as function {name}()",
        (r"\bfunction\s+NAME\b",),
        only_there=True,
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
        r"tuple lowering requires its typed semantic owner",
        UnsupportedModelError,
        "taking several results of a function is not supported in a branch; do so in an equation of its own",
        (r"\([\w\s,.]*,[\w\s,.]*\)\s*=(?!=)",),
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
        "loops of functions run over ranges of whole numbers, as 1:size(v, 1) for an array v; give other "
        "values to an array first",
        (r"\bfor\s+\w+\s+in\s+(?=\{|[A-Za-z_][\w.]*\s+loop\b)",),
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
        r"missing source scope for imports",
        UnsupportedModelError,
        "omitting the first result of a function is not supported; assign it to a variable",
        (r"\((?=\s*,)",),
    ),
    Meaning(
        rf"`multi-output equation`: `{QUALIFIED}` returns (?P<all>\d+) values but the receiving tuple has "
        r"(?P<few>\d+)",
        UnsupportedModelError,
        "{few} of the {all} results of {name} are taken, which is not supported; assign each to a variable",
        (r"\(?[\w\s,.\[\]]*\)\s*=\s*(?:\w+\.)*NAME\s*\(",),
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
        r"missing function loop initial value definition",
        UnsupportedModelError,
        "a loop of a function sets a variable that has no value before the loop; give it one",
        (r"\([\w\s,.]*,[\w\s,.]*\)\s*:=", r"\bfor\s+\w+\s+in\b"),
    ),
    Meaning(
        r"discrete solved form: target identity \d+ reads discrete-value identity \d+ before",
        UnsupportedModelError,
        "an algorithm section reads the value of a discrete variable before the assignment that sets it; "
        "write pre() of it, or an equation",
        (r"\balgorithm\b",),
    ),
    Meaning(
        r"missing exact function-selection identity for `(?:[^`]*\.)?(?P<name>\w+)`",
        ModelicaError,
        "{name} is called as a function, but is a model",
        (r"(?<![\w.])(?:\w+\.)*NAME\s*(?=\()(?=[^;]*;)",),
        only_there=True,
        needs=r"\b(?:model|block)\s+NAME\b",
    ),
    Meaning(
        r"missing exact function-selection identity",
        UnsupportedModelError,
        "which function is called through a redeclared class is not clear here; write its full name",
        (r"\bredeclare\s+(?:replaceable\s+)?(?:package|function)\s+\w+",),
    ),
    Meaning(
        r"named argument `(?P<name>\w+)` does not match any input",
        UnsupportedModelError,
        "the base class of a function is given a value for {name}, which is no input; this is not supported",
        (r"\bextends\s+[\w.]+\s*\((?=[^;]*\bNAME\s*=)",),
        only_there=True,
    ),
)
