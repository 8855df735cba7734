"""Parameters that are computed from others, by lmfit's expressions: fixed ratios, other coordinates."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence

import lmfit

from pyjoystick.fmu import FmuDescription
from pyjoystick.support import ParameterError, UnknownParameterError

_NAME = re.compile(r"[A-Za-z_][\w.\[\]]*")


def names_in(expressions: Iterable[str]) -> set[str]:
    """Everything in the expressions that may be a name."""
    return {name for expression in expressions for name in _NAME.findall(expression)}


class Ties:
    """Values of tied parameters from those of the free ones.

    lmfit's names are identifiers; those of the FMU, with dots, are translated.
    """

    def __init__(self, names: Sequence[str], ties: Mapping[str, str], description: FmuDescription) -> None:
        """Check the expressions.

        Args:
            names: the free parameters, in the order in which `values` takes them
            ties: expressions by the parameter that they give; each may use those before it
            description: the FMU

        Raises:
            UnknownParameterError: the FMU has no such parameter, or an expression uses one that is not free
            ParameterError: an expression cannot be understood
        """
        self._tied = [_identifier(name) for name in ties]
        self._own = [_identifier(name) for name in names]
        self._parameters = lmfit.Parameters()
        known = {name: _identifier(name) for name in (*names, *ties)}
        for name in self._own if ties else ():
            self._parameters.add(name, value=1.0)
        for name, expression in ties.items():
            if name not in description.variables:
                raise UnknownParameterError(name, description.settable_names())
            for word in sorted(names_in([expression])):
                if "." in word and word not in known:
                    raise UnknownParameterError(word, known)
            translated = _NAME.sub(lambda match: known.get(match[0], match[0]), expression)
            try:
                self._parameters.add(_identifier(name), expr=translated)
            except (NameError, SyntaxError, ValueError, TypeError):
                allowed = f"an expression in {', '.join(names)}"
                raise ParameterError(f"ties.{name}", expression, allowed) from None

    def values(self, own: Sequence[float]) -> list[float]:
        """The tied values for the values of the free parameters."""
        if not self._tied:
            return []
        for name, value in zip(self._own, own, strict=True):
            self._parameters[name].set(value=value)
        self._parameters.update_constraints()
        return [float(self._parameters[name].value) for name in self._tied]


def _identifier(name: str) -> str:
    return "p_" + re.sub(r"\W", "__", name)
