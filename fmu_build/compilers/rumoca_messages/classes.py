"""What rumoca's messages about connectors, imports, conditional components and types mean."""

from __future__ import annotations

from fmu_build.compilers.rumoca_messages.meaning import QUALIFIED, Meaning
from fmu_build.support.errors import ModelicaError, UnsupportedModelError

_UNBALANCED = rf"connector '{QUALIFIED}' is unbalanced: (?P<count>[^\[\n]*?) *(?:\(MLS|\[|\n|$)"

_INHERITED = (
    "a class that the package {name} inherits: the compiler does not find its elements under this name; "
    "write that of the package that declares it"
)

_CONDITION = r"conditional component `(?P<name>\w+)` requires parameter expression"
_CONDITIONAL = r"(?<![\w.])NAME\s*(?:\([^;]*\)\s*)?\bif\b"
_NOT_EVALUATED = (
    "the condition of {name} is not evaluated; supported are parameters of the model and of its components, "
    "but not arrays, sizes, functions, constants of packages, or the order or numbers of enumerations"
)

CLASSES = (
    Meaning(
        r"component '\w+' instantiates partial model '(?:\w+\.)*(?P<name>\w+)'",
        UnsupportedModelError,
        "the short class {name} is taken for partial, because the class for which it stands is; write "
        "model {name} extends ...",
        (r"\b(?:model|block|class)\s+NAME\s*=",),
        only_there=True,
    ),
    Meaning(
        _UNBALANCED,
        UnsupportedModelError,
        "the connector {name} is taken for unbalanced, {count}: the compiler counts an array as one, leaves "
        "out inherited variables, and counts parameters, constants and inputs as potentials; declare flow "
        "variables and potentials in the connector itself and in pairs, and the others outside of it",
        (
            r"\bconnector\s+NAME\b(?=(?:(?!\bend\s+NAME\b)[\s\S])*?(?:\[|"
            r"\b(?:extends|parameter|constant|input|output|RECORD\s+\w|ARRAYTYPE\s+\w)))",
        ),
        only_there=True,
    ),
    Meaning(
        rf"(?P<all>connector '{QUALIFIED}' is unbalanced: .*)",
        ModelicaError,
        "{all}",
        (r"\bconnector\s+NAME\b",),
    ),
    Meaning(
        r"unresolved import: '(?P<package>(?:\w+\.)*(?P<name>\w+))\.\*'",
        UnsupportedModelError,
        "import {package}.* is not supported where the model uses no name of {package}, or only inherited "
        "ones; remove it, and write full names or import single ones",
        (r"\bimport\s+(?:\w+\s*\.\s*)*NAME\s*\.\s*\*",),
        needs=r"\bpackage\s+NAME\b",
    ),
    Meaning(
        r"unresolved import: '(?P<whole>(?:\w+\.)*(?P<name>\w+)\.\w+)'",
        UnsupportedModelError,
        "the import of {whole}, a name that the package inherits, is not supported; write the full name",
        (r"\bpackage\s+NAME\b(?=\s*=|(?:(?!\bend\s+NAME\b)[\s\S])*?\bextends\b)",),
        only_there=True,
    ),
    Meaning(
        _CONDITION,
        ModelicaError,
        "the condition of {name} must consist of constants and parameters",
        (rf"{_CONDITIONAL}[^;]*",),
        needs=rf"(?<!parameter )(?<!constant )\b(?:Real|Integer|Boolean)\s+"
        rf"(?=(\w+)\b[\s\S]{{0,4000}}?{_CONDITIONAL}[^;]*(?<![\w.])\1\b)",
    ),
    Meaning(_CONDITION, UnsupportedModelError, _NOT_EVALUATED, (rf"{_CONDITIONAL}[^;]*",)),
    Meaning(
        r"base class not found: `(?P<whole>(?:\w+\.)*(?P<name>\w+)\.\w+)`",
        UnsupportedModelError,
        f"{{whole}} is {_INHERITED}",
        (r"\bextends\s+(?:\w+\s*\.\s*)*(?=NAME\b)HEIR\s*\.\s*\w+",),
        only_there=True,
    ),
    Meaning(
        r"unresolved type reference: '(?P<whole>(?:\w+\.)*(?P<name>\w+)\.\w+)'",
        UnsupportedModelError,
        f"{{whole}} is {_INHERITED}",
        (r"(?<![\w.])(?:\w+\s*\.\s*)*(?=NAME\b)HEIR\s*\.\s*\w+\s+\w+",),
        only_there=True,
        needs=r"\bpackage\s+NAME\s*=",
    ),
    Meaning(
        r"must be a connector, but has builtin type '(?P<whole>(?:\w+\.)*(?P<name>\w+)\.\w+)'",
        UnsupportedModelError,
        f"{{whole}} is {_INHERITED}",
        (r"(?<![\w.])(?:\w+\s*\.\s*)*(?=NAME\b)HEIR\s*\.\s*\w+\s+\w+",),
        only_there=True,
    ),
    Meaning(
        r"unresolved component reference: '(?P<whole>(?P<name>\w+)\.[\w.]+)'",
        UnsupportedModelError,
        "{whole}: the package that names the class of {name} inherits this class, and the compiler does not "
        "find its elements; write the name of the package that declares it",
        (r"(?<![\w.])(?:\w+\s*\.\s*)*HEIR\s*\.\s*\w+\s+(?:\w+\s*,\s*)*(?=NAME\b)",),
        only_there=True,
    ),
    Meaning(
        r"redeclaration error for `(?P<name>\w+)`: selected redeclare class has no such member",
        UnsupportedModelError,
        "{name} is looked up in the class before its redeclaration; redeclare in an extends clause, and use "
        "it in the class with that",
        (r"\bredeclare\b[^;]*",),
        only_there=True,
    ),
    Meaning(
        r"unresolved component reference: '(?P<all>\w+\.(?P<name>\w+)\.\w+)'",
        UnsupportedModelError,
        "{all}, a constant of a package that is redeclared in another package, is not supported; write the "
        "name of the package itself",
        (r"\bredeclare\s+(?:final\s+)?package\s+NAME\b",),
        only_there=True,
    ),
    Meaning(
        r"`(?P<name>\w+)` has 0 dimension\(s\) but is subscripted",
        UnsupportedModelError,
        "{name} has a type that is an array, whose size the compiler does not find, because it is no number; "
        "write the number in the type, or declare the array without the type",
        (r"(?<![\w.])(?:\w+\.)*ARRAYTYPE\s+(?:\w+\s*,\s*)*(?=NAME\b)",),
        only_there=True,
    ),
    Meaning(
        r"size\(\) dimension index \d+ is out of range 1\.\.0|array dimension mismatch: expected `scalar`",
        UnsupportedModelError,
        "the compiler does not find the size of a type that is an array, because it is no number; write the "
        "number in the type, or declare the array without the type",
        (r"(?<![\w.])(?:\w+\.)*ARRAYTYPE\s+\w+",),
        only_there=True,
    ),
)
