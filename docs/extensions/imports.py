"""The rooms of the packages, their doors and their imports, as the source files have them.

The drawing in docs/architecture.md is made from this, and `tests/test_architecture.py` checks it.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).parents[2]
PACKAGES: Final = ("pyjoystick", "fmu_build")


def rooms(package: str) -> set[str]:
    """The folders of a package that hold Python code."""
    return {path.parent.name for path in (ROOT / package).glob("*/__init__.py")}


def room_of(module: str) -> str:
    """The room of a module; ``__init__`` for the package itself."""
    return module.split(".")[1] if "." in module else "__init__"


@cache
def modules() -> dict[str, Path]:
    """Every module of the packages with its file, a package as ``package.__init__``."""
    files = [file for package in PACKAGES for file in (ROOT / package).rglob("*.py")]
    return {".".join(file.relative_to(ROOT).with_suffix("").parts): file for file in files}


def module_of(name: str) -> str | None:
    """The key in `modules` of an imported name; None unless it is a module."""
    return next((module for module in (f"{name}.__init__", name) if module in modules()), None)


@cache
def door(package: str) -> dict[str, str]:
    """What the stub of a package lists: by name, the module that defines it. Empty without a stub."""
    stub = ROOT.joinpath(*package.split("."), "__init__.pyi")
    if not stub.is_file():
        return {}
    nodes = ast.walk(ast.parse(stub.read_text(encoding="utf-8")))
    lists = [node for node in nodes if isinstance(node, ast.ImportFrom)]
    return {alias.name: f"{package}.{node.module}" for node in lists for alias in node.names}


def imports(file: Path) -> Iterator[tuple[str, str]]:
    """What a file imports from the packages: the module that it names, and the one that defines the name."""
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, alias.name) for alias in node.names if module_of(alias.name))
        elif isinstance(node, ast.ImportFrom) and node.module and module_of(node.module):
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                home = inner if module_of(inner) else door(node.module).get(alias.name, node.module)
                yield (inner if module_of(inner) else node.module), home


def arrows(package: str) -> dict[str, set[str]]:
    """By room, the other rooms of the package that it imports from; another package counts as one room."""
    found: dict[str, set[str]] = {room: set() for room in rooms(package)}
    for module, file in modules().items():
        room = room_of(module)
        if module.startswith(f"{package}.") and room in found:
            targets = (named for named, _ in imports(file))
            found[room] |= {
                room_of(name) if name.split(".")[0] == package else name.split(".")[0] for name in targets
            } - {room}
    return found
