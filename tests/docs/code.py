"""How code blocks of each language are checked."""

from __future__ import annotations

import json
import re
import tomllib
from pathlib import Path
from typing import Any

import rumoca

from fmu_build.explore import read_settings as read_page_settings
from pyjoystick.identification import read_fit_settings
from pyjoystick.model import NOMINAL, read_parameter_file, write_parameters
from pyjoystick.reports import read_laboratory
from pyjoystick.runs import Sweep, read_settings
from tests.docs import commands
from tests.docs.pages import ROOT, Block

#: Languages of tools that are not here; their blocks have to be marked as not run.
FOREIGN = frozenset({"dockerfile", "julia", "matlab", "powershell", "shell"})


class PageRun:
    """A page that is worked through from top to bottom, in one folder and with one set of Python names."""

    def __init__(self, page: Path, folder: Path) -> None:
        self.page, self.folder = page, folder
        self.names: dict[str, Any] = {}

    def do(self, block: Block) -> None:
        """Run a block, or only read it where it is marked so; whatever goes wrong is raised."""
        match block.language:
            case "":
                for command in commands.command_lines(block.text):
                    commands.read(command) if block.not_run else commands.run(command, self.folder)
            case "python":
                # With the line numbers of the page, for messages.
                program = compile("\n" * block.line + block.text, self.page.name, "exec")
                if not block.not_run:
                    exec(program, self.names)
            case "toml":
                accept_toml(block.text, self.folder)
            case "modelica":
                accept_modelica(block.text)
            case "json":
                json.loads(block.text)
            case "text":
                pass
            case language if language in FOREIGN and block.not_run:
                pass
            case _:
                raise ValueError(f"line {block.line}: nothing checks the language {block.language}")


def accept_toml(text: str, folder: Path) -> None:
    """Have the program that a settings file is for read it: a sweep, a fit or a joystick's parameters."""
    tables = set(tomllib.loads(text))
    # Beside it lies what the pages call the reader's parameter file.
    file = folder / "settings" / "documented.toml"
    file.parent.mkdir(exist_ok=True)
    file.write_text(text, encoding="utf-8")
    write_parameters(file.with_name("joystick.toml"), NOMINAL)
    if "vary" in tables:
        Sweep(read_settings(file))
    elif "free" in tables:
        read_fit_settings(file)
    elif "load_curve" in tables:
        read_laboratory(file)
    elif "explore" in tables:
        read_page_settings(file)
    elif "body" in tables:
        read_parameter_file(file)
    else:
        raise ValueError(f"no program reads a file with the tables {', '.join(sorted(tables))}")


def accept_modelica(text: str) -> None:
    """Compile the last class of a piece of Modelica that stands by itself, with the library."""
    name = re.findall(r"^end (\w+);", text, re.MULTILINE)[-1]
    rumoca.Session(roots=[str(ROOT / "modelica")]).loads(text, model=name)
