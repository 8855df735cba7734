"""What rumoca's messages about ranges, and about sizes and members of arrays of components, mean."""

from __future__ import annotations

from fmu_build.compilers.rumoca_messages.meaning import Meaning
from fmu_build.support.errors import ModelicaError, UnsupportedModelError

_NO_RANGE = (
    "the range {all} of a loop over connections is not evaluated; use numbers, or a parameter or constant of "
    "the class that is a number"
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
)
