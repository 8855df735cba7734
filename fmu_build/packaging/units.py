"""Convert Modelica unit expressions to exponents of the SI base units.

The syntax is that of the Modelica specification, chapter "Unit Expressions": factors joined by ".", at most
one "/" on each level, integer exponents directly after the symbol ("kg.m2/s2", "N.m.s/rad", "W/(m2.K)").
As in FMI, the radian is a base unit.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from fractions import Fraction

BASE_UNITS = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")


class UnitError(ValueError):
    """A text is not a unit, or two units have different dimensions."""


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit: `base value = factor * value + offset`, with the base value in a product of base units."""

    exponents: tuple[int, ...]
    factor: Fraction
    offset: Fraction = Fraction(0)

    def __mul__(self, other: Unit) -> Unit:
        exponents = tuple(a + b for a, b in zip(self.exponents, other.exponents, strict=True))
        return Unit(exponents, self.factor * other.factor)

    def __pow__(self, exponent: int) -> Unit:
        return Unit(tuple(a * exponent for a in self.exponents), self.factor**exponent)


def parse_unit(text: str) -> Unit:
    """Parse a Modelica unit string; raises `UnitError` if it is not one."""
    parser = _Parser(text)
    unit = parser.expression()
    if parser.rest:
        raise UnitError(f"{text!r} is not a unit: unexpected {parser.rest!r}")
    return unit


def conversion(unit: str, display_unit: str) -> tuple[float, float]:
    """Return (factor, offset) with `value in display_unit = factor * value in unit + offset`.

    Raises `UnitError` if the units have different dimensions.
    """
    source, target = parse_unit(unit), parse_unit(display_unit)
    if source.exponents != target.exponents:
        raise UnitError(f"{display_unit!r} cannot display values in {unit!r}")
    return float(source.factor / target.factor), float((source.offset - target.offset) / target.factor)


class _Parser:
    """A recursive-descent parser of the grammar; `rest` is the text not yet read."""

    _FACTOR = re.compile(r"([A-Za-z]+)([+-]?\d+)?")

    def __init__(self, text: str) -> None:
        self.text = text
        self.rest = text

    def expression(self) -> Unit:
        numerator = _ONE if self._take("1") else self._product()
        if not self._take("/"):
            return numerator
        return numerator * self._factor() ** -1

    def _product(self) -> Unit:
        product = self._factor()
        while self._take("."):
            product = product * self._factor()
        return product

    def _factor(self) -> Unit:
        if self._take("("):
            unit = self.expression()
            if not self._take(")"):
                raise UnitError(f"{self.text!r} is not a unit: a closing parenthesis is missing")
            return unit
        match = self._FACTOR.match(self.rest)
        if match is None:
            raise UnitError(f"{self.text!r} is not a unit: expected a unit symbol before {self.rest!r}")
        self.rest = self.rest[match.end() :]
        symbol = _symbol(match[1], self.text)
        return symbol if match[2] is None else symbol ** int(match[2])

    def _take(self, token: str) -> bool:
        if not self.rest.startswith(token):
            return False
        self.rest = self.rest[len(token) :]
        return True


def _symbol(name: str, text: str) -> Unit:
    if name in _SYMBOLS:
        return _SYMBOLS[name]
    for prefix, factor in _PREFIXES.items():
        unit = _SYMBOLS.get(name.removeprefix(prefix)) if name.startswith(prefix) else None
        if unit is not None and not unit.offset:
            return Unit(unit.exponents, unit.factor * factor)
    raise UnitError(f"{text!r} is not a unit: {name!r} is not a known unit symbol")


def _unit(factor: Fraction | int | str, offset: Fraction | str = "0", **exponents: int) -> Unit:
    return Unit(tuple(exponents.get(base, 0) for base in BASE_UNITS), Fraction(factor), Fraction(offset))


_ONE = _unit(1)
_PI = Fraction(math.pi)
_PREFIXES = {
    name: Fraction(10) ** power
    for name, power in {
        "y": -24, "z": -21, "a": -18, "f": -15, "p": -12, "n": -9, "u": -6, "m": -3, "c": -2, "d": -1,
        "da": 1, "h": 2, "k": 3, "M": 6, "G": 9, "T": 12, "P": 15, "E": 18, "Z": 21, "Y": 24,
    }.items()
}  # fmt: skip
_SYMBOLS = {
    "g": _unit("0.001", kg=1),
    "m": _unit(1, m=1),
    "s": _unit(1, s=1),
    "A": _unit(1, A=1),
    "K": _unit(1, K=1),
    "mol": _unit(1, mol=1),
    "cd": _unit(1, cd=1),
    "rad": _unit(1, rad=1),
    "sr": _unit(1, rad=2),
    "Hz": _unit(1, s=-1),
    "Bq": _unit(1, s=-1),
    "N": _unit(1, kg=1, m=1, s=-2),
    "Pa": _unit(1, kg=1, m=-1, s=-2),
    "J": _unit(1, kg=1, m=2, s=-2),
    "W": _unit(1, kg=1, m=2, s=-3),
    "C": _unit(1, A=1, s=1),
    "V": _unit(1, kg=1, m=2, s=-3, A=-1),
    "F": _unit(1, kg=-1, m=-2, s=4, A=2),
    "Ohm": _unit(1, kg=1, m=2, s=-3, A=-2),
    "S": _unit(1, kg=-1, m=-2, s=3, A=2),
    "Wb": _unit(1, kg=1, m=2, s=-2, A=-1),
    "T": _unit(1, kg=1, s=-2, A=-1),
    "H": _unit(1, kg=1, m=2, s=-2, A=-2),
    "lm": _unit(1, cd=1, rad=2),
    "lx": _unit(1, cd=1, rad=2, m=-2),
    "Gy": _unit(1, m=2, s=-2),
    "Sv": _unit(1, m=2, s=-2),
    "kat": _unit(1, mol=1, s=-1),
    # Units outside the SI that the Modelica standard library uses.
    "deg": _unit(_PI / 180, rad=1),
    "rev": _unit(2 * _PI, rad=1),
    "rpm": _unit(_PI / 30, rad=1, s=-1),
    "degC": _unit(1, "273.15", K=1),
    "degF": _unit(Fraction(5, 9), Fraction("459.67") * 5 / 9, K=1),
    "min": _unit(60, s=1),
    "h": _unit(3600, s=1),
    "d": _unit(86400, s=1),
    "l": _unit("0.001", m=3),
    "L": _unit("0.001", m=3),
    "t": _unit(1000, kg=1),
    "bar": _unit(100_000, kg=1, m=-1, s=-2),
    "eV": _unit("1.602176634e-19", kg=1, m=2, s=-2),
    "var": _unit(1, kg=1, m=2, s=-3),
}
