"""Command lines in the pages: parsed by the programs' own parsers, and run."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import typer

from fmu_build.__main__ import app as fmu_build_app
from fmu_build.explore.command import app as explore_app
from pyjoystick.cli import app, main
from tests.docs.pages import ROOT

_TARGETS = re.compile(r"^([\w-]+):", re.MULTILINE)


class CommandError(AssertionError):
    """A command line that its program refuses, or that ends with an exit code other than 0."""


def command_lines(text: str) -> Iterator[str]:
    """The lines of a block without comments, those that end in a backslash joined with the next."""
    for line in text.replace("\\\n", " ").splitlines():
        command = re.sub(r"(^|\s)#\s.*", "", line).strip()
        if command:
            yield command


def read(command: str) -> None:
    """Have the program read its command line without doing anything.

    Raises:
        CommandError: it does not understand it, or it is no program that pages may mention
    """
    # What it is piped into is another program's.
    program, *arguments = shlex.split(command.partition(" | ")[0])
    match program, arguments:
        case "pyjoystick", _:
            _parse(typer.main.get_command(app), arguments, command)
        case "python", ["-m", "fmu_build", "explore", *rest]:
            _parse(typer.main.get_command(explore_app), rest, command)
        case "python", ["-m", "fmu_build", *rest]:
            _parse(typer.main.get_command(fmu_build_app), rest, command)
        case "python", ["-m", module, *_]:
            known = find_spec(module) is not None
            _require(known, command, f"there is no module {module}")
        case "python", [script, *_]:
            _require((ROOT / script).is_file(), command, f"there is no {script}")
        case "make", _:
            targets = _TARGETS.findall((ROOT / "Makefile").read_text(encoding="utf-8"))
            wanted = [word for word in arguments if "=" not in word]
            _require(
                set(wanted) <= set(targets), command, f"targets of the Makefile are {', '.join(targets)}"
            )
        case (("." | "cd" | "conda" | "dask" | "docker" | "pip" | "rattler-build"), _):
            pass
        case _:
            raise CommandError(f"{command}\nis of no program that is known here")


def run(command: str, folder: Path) -> None:
    """Run a command of ``pyjoystick`` or a build of FMUs, in this process; others are read.

    Args:
        command: the line
        folder: receives FMUs that are built, in the place of ``--output``

    Raises:
        CommandError: its exit code is not 0
    """
    read(command)
    program, *arguments = shlex.split(command)
    if program == "pyjoystick":
        code = main(arguments)
    elif arguments[:3] == ["-m", "fmu_build", "explore"]:
        code = explore_app(args=arguments[3:], standalone_mode=False) or 0
    elif arguments[:2] == ["-m", "fmu_build"]:
        arguments[arguments.index("--output") + 1] = str(folder / "built")
        code = fmu_build_app(args=arguments[2:], standalone_mode=False) or 0
    else:
        return
    _require(code == 0, command, f"ends with the exit code {code}")


def _parse(command: Any, arguments: Sequence[str], line: str, parent: Any = None) -> None:
    try:
        context = command.make_context(command.name or "", list(arguments), parent=parent)
        if isinstance(command, typer.core.TyperGroup):
            rest = [*context._protected_args, *context.args]
            _, inner, rest = command.resolve_command(context, rest)
            _parse(inner, rest, line, context)
    except CommandError:
        raise
    except SystemExit as stop:
        raise CommandError(f"{line}\nis refused") from stop
    except Exception as error:
        raise CommandError(f"{line}\nis refused: {error}") from error


def _require(condition: bool, command: str, otherwise: str) -> None:
    if not condition:
        raise CommandError(f"{command}\n{otherwise}")
