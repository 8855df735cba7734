"""What rumoca's messages about ranges, and about sizes and members of arrays of components, mean."""

from __future__ import annotations

from fmu_build.compilers.rumoca_messages.meaning import Meaning
from fmu_build.support.errors import ModelicaError, UnsupportedModelError

_NO_RANGE = (
    "the range {all} of a loop over connections is not evaluated; use numbers, or a parameter or constant of "
    "the class that is a number"
)

_NO_SIZE = (
    "the size of this array of components is not evaluated; supported are numbers, and parameters and "
    "constants of the class that are numbers"
)
_SIZE_BY_EXPRESSION = (
    r"(?<![\w.])(?:\w+\s*\.\s*)*CLASS\s+\w+\s*\["
    r"(?=[^\[\]]*(?:\w\s*\.\s*[A-Za-z]|\bsize\s*\()|\s*(?:\w+\s*\.\s*)*ENUMERATION\s*\])[^\[\]]*\]"
)
# A constant may be one of a package around the class; a parameter may get its value from another class.
_SIZE_BY_NAME = (
    r"\b(?:constant\s+Integer\s+|parameter\s+Integer\s+(?=\w+\s*=\s*(?!\d+\b)))"
    r"(?=(\w+)\s*=[\s\S]{0,4000}?(?<![\w.])CLASS\s+\w+\s*\[[^\[\]]*\b\1\b)\w+"
)

SIZES = (
    Meaning(
        r"cannot evaluate connection for-equation range `(?P<all>[^`]*[.(\[][^`]*)`",
        UnsupportedModelError,
        _NO_RANGE,
        (r"\bfor\s+\w+\s+in\s+[^;]*?(?=\s+loop\b)(?=[^;]*\bconnect\s*\()",),
    ),
    Meaning(
        r"cannot evaluate connection for-equation range `(?P<all>[^`]*?(?P<name>[A-Za-z]\w*)[^`]*)`",
        UnsupportedModelError,
        _NO_RANGE,
        (r"\bin\s+(?=[^;]*\bNAME\b[^;]*\bloop\s+connect\b)",),
        needs=r"\b(?:parameter|constant)\s+[\w.]+\s+[^;]*?\bNAME\b",
    ),
    Meaning(
        r"cannot evaluate connection for-equation range `(?P<all>[^`]*)`",
        ModelicaError,
        "the range {all} of a loop over connections must consist of numbers, parameters and constants",
        (r"\bfor\s+\w+\s+in\s+[^;]*?(?=\s+loop\s+connect\b)",),
    ),
    Meaning(
        r"`(?P<name>\w+)`: cannot prove redeclared dimensions",
        UnsupportedModelError,
        "the size of the array {name} is not evaluated in a redeclaration; write a number, or a parameter of "
        "the class",
        (r"\bredeclare\s+[\w.]+\s+NAME\b",),
    ),
    Meaning(
        r"record-field `(?P<name>\w+)` declaration \d+ requires",
        UnsupportedModelError,
        "{name} of components in an array of components that is in an array itself is not supported in a "
        "loop or a slice; give it to a variable of the outer components, and use that",
        (
            r"\w\s*\[[^\[\]]*\]\s*\.\s*\w+\s*\[[^\[\]]*\]\s*\.\s*NAME\b",
            r"\w\s*\[[^\[\]]*\]\s*\.\s*\w+\s*\.\s*NAME\b",
        ),
        only_there=True,
    ),
    Meaning(
        r"record-field `\w+` declaration \d+ requires|expression shape mismatch",
        UnsupportedModelError,
        _NO_SIZE,
        (_SIZE_BY_EXPRESSION, _SIZE_BY_NAME),
        only_there=True,
    ),
    Meaning(
        r"expression shape mismatch",
        UnsupportedModelError,
        "the size of a type that is an array is not evaluated here, because it is no number; write the "
        "number in the type, or declare the array without the type",
        (r"(?<![\w.])(?:\w+\.)*ARRAYTYPE\s+\w+",),
        only_there=True,
    ),
    Meaning(
        r"unresolved Flat reference `(?P<name>\w+)`",
        UnsupportedModelError,
        "size() of the array of components {name} is not supported; use the number or "
        "parameter that is its size",
        (r"\bsize\s*\(\s*NAME\b[^()]*\)",),
        only_there=True,
        needs=r"(?<![\w.])(?:\w+\.)*CLASS\s+(?:[^;]*,\s*)?NAME\b",
    ),
    Meaning(
        r"unresolved Flat reference `(?P<name>\w+)`",
        UnsupportedModelError,
        "end is not supported as a subscript of the array of components {name}; write its size",
        (r"(?<![\w.])NAME\s*\[[^\[\]]*\bend\b[^\[\]]*\]",),
        only_there=True,
    ),
    Meaning(
        r"unresolved Flat reference `(?P<whole>(?P<name>\w+)\.\w+\.\w+)`",
        UnsupportedModelError,
        "{whole}, a member of an array of components that is in an array of components itself, is not "
        "supported without subscripts; write the elements out",
        (r"(?<![\w.])NAME\s*\[[^\[\]]*\]\s*(?=[;(,\"])",),
        only_there=True,
    ),
    Meaning(
        r"missing structured identity: (?P<name>\w+)",
        UnsupportedModelError,
        "the constant {name} of a replaceable package is not supported in the size of an array of "
        "components; declare the array with a number",
        (r"(?<![\w.])(?:\w+\.)*CLASS\s+\w+\s*\[[^\[\]]*\.\s*NAME\b[^\[\]]*\]",),
        only_there=True,
    ),
)
