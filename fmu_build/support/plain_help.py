"""Help of commands in which no names of Python types stand."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from typer.core import TyperArgument, TyperCommand, TyperGroup


class PlainCommand(TyperCommand):
    """A command whose help shows no types, such as <list[Path]>, behind flags and arguments."""

    def get_params(self, ctx: Any) -> Any:
        """The parameters, with --help."""
        return _without_types(super().get_params(ctx))


class PlainGroup(TyperGroup):
    """The same for a group of commands."""

    def get_params(self, ctx: Any) -> Any:
        """The parameters, with --help."""
        return _without_types(super().get_params(ctx))


def _without_types(parameters: Iterable[Any]) -> list[Any]:
    """Take the types away where they say nothing: flags take no value, and arguments have names that tell."""
    found = list(parameters)
    for one in found:
        if isinstance(one, TyperArgument) or one.is_flag or one.count:
            one.display_type_rich = _no_type
    return found


def _no_type(ctx: object) -> None:
    del ctx
