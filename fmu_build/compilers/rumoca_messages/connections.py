"""What rumoca's messages about connections, and about its count of equations and unknowns, mean."""

from __future__ import annotations

from fmu_build.compilers.rumoca_messages.meaning import Meaning
from fmu_build.support.errors import ModelicaError, UnsupportedModelError

_UNBALANCED = r"unbalanced model: \d+ equations, \d+ unknowns"

_SUBSCRIPT_IN_CONNECT = (
    "this subscript in connect() is not supported; write numbers, a range of numbers, or one connect() for "
    "each element"
)

CONNECTIONS_AND_COUNTS = (
    Meaning(
        r"incompatible connector types in connection: .*\(dims: ",
        UnsupportedModelError,
        _SUBSCRIPT_IN_CONNECT,
        (r"\bconnect\s*\([^;]*\[[^\];]*[\[(][^;]*(?=;)",),
        only_there=True,
    ),
    Meaning(
        r"structural parameter `connection (?:range|subscript)`|"
        r"cannot evaluate connection (?:range )?subscript",
        UnsupportedModelError,
        _SUBSCRIPT_IN_CONNECT,
        (r"\bconnect\s*\([^;]*\[[^;]*(?=;)",),
    ),
    Meaning(
        r"element assignments must cover a discrete coordinate exactly once",
        UnsupportedModelError,
        "the compiler does not find an order for all connections of the elements of a Boolean or Integer "
        "array; write equations for them instead of connect(), as and1.u[2] = source.y",
        (r"\bconnect\s*\([^;]*\[\s*\d+\s*\][^;]*(?=;)",),
    ),
    Meaning(
        r"expandable connector .* requires unsupported member augmentation",
        UnsupportedModelError,
        "connections give this expandable connector members that it does not declare, which is not supported "
        "here; declare them in a connector that extends it",
        (r"\bexpandable\s+connector\s+\w+",),
    ),
    Meaning(
        r"unbalanced model",
        UnsupportedModelError,
        "outer variables that are neither parameters nor components are not supported; connect them, or "
        "declare them in a component that is inner",
        (r"\bouter\s+(?:(?:input|output)\s+)?(?:Real|(?:[\w.]+\.)?SI\.\w+)\s+\w+",),
        only_there=True,
    ),
    Meaning(
        r"unbalanced model",
        UnsupportedModelError,
        "operator records are not supported",
        (r"\boperator\s+record\b",),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts if-expressions and if-equations of records such as "
        "this one: write them for each member",
        (
            r"(?<![\w.])(?:\w+\.)*RECORD\s+(?=(?:\w+\s*,\s*)*(\w+)\b[^;]*;[\s\S]{0,4000}?"
            r"(?:(?<![\w.])\1\s*=\s*if\b|\b(?:then|else)\s+\1\s*=(?!=)))",
        ),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts modifiers of names with points: write "
        "a(x(start = 1)) instead of a(x.start = 1)",
        (r"(?<=[(,])\s*\w+(?:\s*\.\s*\w+)+\s*=(?!=)",),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts equations with a constructor on their left: write "
        "it on the right",
        (r"(?:;|\bequation\b)\s*(?:\w+\s*\.\s*)*RECORD\s*\((?=[^;()]*(?:\([^()]*\)[^;()]*)*\)\s*=(?!=))",),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts equations of slices of arrays of components, and "
        "modifiers of the form each a(k = {{...}}): write the elements one by one",
        (r"\w\s*\[[^\[\]]*:[^\[\]]*\]\s*\.\s*\w+", r"\beach\s+\w+\s*\([^()]*=\s*\{"),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts equations for matrices of variables such as this "
        "one: write one for each variable",
        (r"(?:;|\bequation)\s*\[[^\[\]]*\]\s*=(?!=)",),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts connections with such subscripts: write numbers, a "
        "rising range of numbers, or one connect() for each element",
        (r"\bconnect\s*\([^;]*\[[^\];]*(?:\[|:\s*-\s*\d)[^;]*(?=;)",),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts some parameters that a function of an array gives, "
        "such as this one: write its value without the function",
        (
            r"\bparameter\s+\w+\s+\w+\s*(?:\([^;()]*\)\s*)?=\s*(?:\w+\.)*FUNCTION\s*\([^;]*(?=;)",
            r"(?<=[(,])\s*\w+\s*=\s*(?:\w+\.)*FUNCTION\s*\(",
        ),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts some variables that are declared with a function "
        "of an array, such as this one: write it as an equation",
        (r"(?<=[;\n])\s*(?:\w+\.)*\w+\s+\w+\s*(?:\([^;()]*\)\s*)?=\s*(?:\w+\.)*FUNCTION\s*\([^;]*(?=;)",),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts equations with such a function of an array on the "
        "left: write it on the right, as in 0 = y + f(v) - 1",
        (r"(?<![\w.])(?:\w+\.)*FUNCTION\s*\((?=[^;=]*=(?!=))",),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts equations of slices with a list, a step or end as "
        "subscript: write them for each element, or for each i of a for-loop",
        (r"(?<![\w.])(?:\w+\.)*\w+\s*\[(?=[^\[\]]*(?:\{|:[^\[\]:]*:|:\s*end\b)[^\[\]]*\]\s*=(?!=))",),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts connections of a slice with a member of an array "
        "of components without a subscript; give both a subscript, as in connect(s.y[2:3], g[1:2].u)",
        (r"\bconnect\s*\((?=[^;]*\[[^\];]*:[^\];]*\])[^;]*(?=;)",),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts a matrix of components whose modifier has "
        "iterators: write the values out, as {{{{1, 1}}, {{2, 2}}}}",
        (r"\w\s*\[[^\[\];]*,[^\[\];]*\]\s*\((?=[^;]*\{\s*\{[^;]*\bfor\b)",),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it miscounts equations for an array that is a member of an "
        "array of components: write one for each element",
        (
            r"\b[\w.]+\s+(?=(\w+)\s*\[[^\[\]]*\][^;]*;[\s\S]{0,4000}?"
            r"(?<![\w.])\1\s*\.\s*\w+\s*=\s*(?:\{\s*\{|\[|\w+\s*\.|fill\s*\())",
        ),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "{all}, as the compiler counts them; it counts one too many for a protected connector: connect a "
        "component instead",
        (
            r"\bprotected\b(?:(?!\b(?:public|equation|algorithm|model|block|end)\b)[\s\S])*?"
            r"(?<![\w.])(?:\w+\.)*FLOWCONNECTOR\s+\w+",
        ),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>{_UNBALANCED})",
        UnsupportedModelError,
        "operator records are not supported ({all}, as the compiler counts them)",
        (r"\boperator\s+record\b",),
        only_there=True,
    ),
    Meaning(rf"(?P<all>{_UNBALANCED})", ModelicaError, "{all}"),
)
