"""The directive ``command-line``: the commands of ``pyjoystick`` with their options, as in ``--help``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Literal, get_args, get_origin

import typer
from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective
from sphinx.util.typing import ExtensionMetadata

from pyjoystick.cli import app


class CommandLine(SphinxDirective):
    """A section for each command."""

    def run(self) -> list[nodes.Node]:
        """The sections, from Markdown."""
        program = typer.main.get_command(app)
        text = "\n\n".join(command_text(name, command) for name, command in commands("pyjoystick", program))
        return list(self.parse_text_to_nodes(text, allow_section_headings=True))


def commands(name: str, command: Any) -> Iterator[tuple[str, Any]]:
    """The commands that do something, with the words that call them."""
    if not hasattr(command, "commands"):
        yield name, command.load()
        return
    for word in command.list_commands(None):  # in the order of --help
        yield from commands(f"{name} {word}", command.commands[word])


def command_text(name: str, command: Any) -> str:
    """A command as Markdown: what it does, its arguments and options, its examples."""
    shown = [one for one in command.params if not one.hidden]
    rows = [f"| {_spelling(one)} | {_cell(one.help or '')}{_default(one)} |" for one in shown]
    table = "\n".join(["| | |", "|---|---|", *rows])
    return "\n\n".join([f"## {name}", command.help or "", table, (command.epilog or "").strip()])


def _spelling(parameter: Any) -> str:
    if parameter.opts == [parameter.name]:
        return f"`{parameter.metavar or parameter.name.upper()}`"
    words = ", ".join(f"`{word}`" for word in [*parameter.opts, *parameter.secondary_opts])
    value = "" if parameter.is_flag else f" `{parameter.metavar or _values(parameter)}`"
    return _cell(words + value)


def _values(parameter: Any) -> str:
    """The kind of value, if the command does not name it: for a choice, the values themselves."""
    kind = parameter.type_descriptor.annotation
    if get_origin(kind) is Literal:
        return ", ".join(get_args(kind))
    return {float: "NUMBER", int: "INTEGER"}.get(kind, "TEXT")


def _default(parameter: Any) -> str:
    value = parameter.default
    if parameter.required or not parameter.show_default or value in (None, False, (), [], ""):
        return ""
    return f" [{_cell(str(value))}]"


def _cell(text: str) -> str:
    return " ".join(text.split()).replace("|", "\\|")


def setup(app: Sphinx) -> ExtensionMetadata:
    """Make the directive known."""
    app.add_directive("command-line", CommandLine)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
