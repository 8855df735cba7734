"""Tied parameters: computed from the free ones by expressions in their names."""

from __future__ import annotations

import ast
import io
import math
import re
from collections.abc import Iterable, Mapping, Sequence

import asteval
import numpy as np

from pyjoystick.fmu import FmuDescription
from pyjoystick.support import ParameterError, UnknownParameterError

_NAME = re.compile(r"(?<![\w.])[A-Za-z_][\w.\[\]]*")  # not the e of 1e-3


def names_in(expressions: Iterable[str]) -> set[str]:
    """All identifiers in the expressions that may be names."""
    return {name for expression in expressions for name in _NAME.findall(expression)}


class Ties:
    """Computes tied parameters from the free ones by expressions.

    Names in expressions must be identifiers, so the FMU's names with dots are translated.
    """

    def __init__(self, names: Sequence[str], ties: Mapping[str, str], description: FmuDescription) -> None:
        """Check the expressions.

        Args:
            names: the free parameters, in the order in which `values` takes them
            ties: expressions by tied parameter; each may use the ones before it
            description: description of the FMU

        Raises:
            UnknownParameterError: the FMU has no such parameter
            ParameterError: an expression cannot be parsed, or uses a parameter of the FMU that is not free
        """
        self._own = [_identifier(name) for name in names]
        self._expressions: dict[str, tuple[str, ast.expr]] = {}
        if not ties:
            return
        self._interpreter = asteval.Interpreter(err_writer=io.StringIO())
        self._interpreter.symtable.update(dict.fromkeys(self._own, 1.0))
        known = {name: _identifier(name) for name in (*names, *ties)}
        allowed = "an expression in the free parameters" + (f": {', '.join(names)}" if names else "")
        for name, expression in ties.items():
            if name not in description.variables:
                raise UnknownParameterError(name, description.settable_names())
            for word in sorted(names_in([expression])):
                if word in description.variables and word not in known:
                    raise ParameterError(f"ties.{name}", expression, allowed, f"{word} is not free")
                if "." in word and word not in known:
                    raise UnknownParameterError(word, known)
            translated = _NAME.sub(lambda match: known.get(match[0], match[0]), expression)
            try:
                self._expressions[_identifier(name)] = translated, ast.parse(translated, mode="eval").body
                self._evaluate(_identifier(name))
            except (NameError, SyntaxError, TypeError, ValueError):
                raise ParameterError(f"ties.{name}", expression, allowed) from None

    def values(self, own: Sequence[float]) -> list[float]:
        """Tied values for given values of the free parameters; NaN where an expression has no value."""
        if not self._expressions:
            return []
        self._interpreter.symtable.update(zip(self._own, map(float, own), strict=True))
        return [self._evaluate(name) for name in self._expressions]

    def _evaluate(self, name: str) -> float:
        """Evaluate a tied value, also for later ties; NaN if there is none (1/0), so that the run fails."""
        text, parsed = self._expressions[name]
        # The interpreter keeps its errors, and does nothing after the first.
        self._interpreter.code_text, self._interpreter.error = [], []
        try:
            with np.errstate(all="ignore"):
                value = float(self._interpreter.run(parsed, expr=text))
        except ArithmeticError:
            value = math.nan
        self._interpreter.symtable[name] = value
        return value


def _identifier(name: str) -> str:
    return "p_" + re.sub(r"\W", "__", name)
