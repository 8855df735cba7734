"""Trial values that reveal branches which depend on parameters.

rumoca evaluates some conditions at compile time: in ``when c then d = if q > 3 then pre(d) + 1 else 0; end
when;`` it keeps only the branch for the present values. A small change of q would not reveal this. The values
here lie on both sides of every number with which such a class compares something, and reverse the order of
any two parameters.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from fmu_build.codegen.modelica_source.constructs import ModelText

_CHOICE_IN_WHEN = re.compile(r"\b(?<!end )when\b(?:(?!\bend\s+when\b).)*?\bif\b", re.DOTALL)
_NUMBER = r"\d+(?:\.\d*)?(?:[eE][+-]?\d+)?"
_RELATION = r"(?:<=|>=|==|<>|<|>)"
_COMPARED = re.compile(rf"{_RELATION}\s*(-?\s*{_NUMBER})|(-?\s*{_NUMBER})\s*{_RELATION}")
#: Number of parameters whose values get different orders.
_ORDERS = 8


def thresholds(model: str, texts: Mapping[Path, str]) -> tuple[float, ...] | None:
    """Return the numbers that classes with branches in when-clauses compare with; None if there are none."""
    source = ModelText(model, texts, around=False)
    choosing = [text for text in source.classes() if _CHOICE_IN_WHEN.search(text)]
    if not choosing:
        return None
    found = {
        float((match[1] or match[2]).replace(" ", ""))
        for text in choosing
        for match in _COMPARED.finditer(text)
    }
    return tuple(sorted(found))


def probe_values(value: float, number: int, compared: tuple[float, ...]) -> list[float]:
    """Return trial values for one parameter: some around the thresholds, then some far from its value.

    All parameters get the same number of values. Around a whole number, the values are rounded to that number
    and the next.

    Args:
        value: present value
        number: number of the parameter
        compared: see `thresholds`
    """
    near = [one for c in compared for one in (c - 1e-3 * (abs(c) or 1.0), c + 0.501)]
    far = 10.0 * (1.0 + abs(value))
    bits = (number % _ORDERS & 1 << place for place in range(_ORDERS.bit_length() - 1))
    return near + [value + sign * far for bit in bits for sign in ((1.0, -1.0) if bit else (-1.0, 1.0))]
