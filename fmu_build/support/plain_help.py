"""Command-line help that shows no Python types, and output that fits a width of terminals."""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import Any, Final

from typer.core import TyperArgument, TyperCommand, TyperGroup

#: Terminals are not narrower; rich prints nothing, or parts of it, into a width of a few letters.
_NARROWEST: Final = 20


def ignore_impossible_width() -> None:
    """Forget a width of the terminal in the environment, COLUMNS, that no terminal has."""
    width = os.environ.get("COLUMNS", "")
    if width.isdigit() and int(width) < _NARROWEST:
        del os.environ["COLUMNS"]


class PlainCommand(TyperCommand):
    """A command whose help omits types such as <list[Path]> after flags and arguments."""

    def get_params(self, ctx: Any) -> Any:
        """Return the parameters, including --help."""
        return _without_types(super().get_params(ctx))


class PlainGroup(TyperGroup):
    """The same for command groups."""

    def get_params(self, ctx: Any) -> Any:
        """Return the parameters, including --help."""
        return _without_types(super().get_params(ctx))


def _without_types(parameters: Iterable[Any]) -> list[Any]:
    """Remove uninformative types: flags take no value, and the names of arguments say enough."""
    found = list(parameters)
    for one in found:
        if isinstance(one, TyperArgument) or one.is_flag or one.count:
            one.display_type_rich = _no_type
    return found


def _no_type(ctx: object) -> None:
    del ctx
