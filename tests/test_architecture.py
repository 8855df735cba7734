"""The import graph is what docs/architecture.md says, leads through the doors of rooms, and has no cycles."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from functools import cache
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
ARCHITECTURE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
PACKAGES = ("pyjoystick", "fmu_build")
#: What may use every room: the command line and the package's own face.
ENTRANCES = {"__init__", "__main__", "cli"}


def rooms(package: str) -> set[str]:
    """The folders of a package that hold Python code."""
    return {path.parent.name for path in (ROOT / package).glob("*/__init__.py")}


def _modules() -> dict[str, Path]:
    files = [file for package in PACKAGES for file in (ROOT / package).rglob("*.py")]
    return {".".join(file.relative_to(ROOT).with_suffix("").parts): file for file in files}


MODULES = _modules()


def _imports(path: Path) -> Iterator[tuple[str, str]]:
    """What a file imports of this project: the module that it names, and the module that defines the name."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from ((alias.name, alias.name) for alias in node.names if _module(alias.name))
        elif isinstance(node, ast.ImportFrom) and node.module and _module(node.module):
            for alias in node.names:
                inner = f"{node.module}.{alias.name}"
                home = inner if _module(inner) else _door(node.module).get(alias.name, node.module)
                yield (inner if _module(inner) else node.module), home


def _module(name: str) -> str | None:
    return next((module for module in (f"{name}.__init__", name) if module in MODULES), None)


@cache
def _door(package: str) -> dict[str, str]:
    """The modules behind the names that a package's stub lists."""
    stub = ROOT.joinpath(*package.split("."), "__init__.pyi")
    if not stub.is_file():
        return {}
    nodes = ast.walk(ast.parse(stub.read_text(encoding="utf-8")))
    lists = [node for node in nodes if isinstance(node, ast.ImportFrom)]
    return {alias.name: f"{package}.{node.module}" for node in lists for alias in node.names}


def _room(module: str) -> str:
    return module.split(".")[1] if "." in module else "__init__"


def _table() -> dict[tuple[str, str], set[str]]:
    """The table of arrows: by package and room, the rooms that it may import."""
    rows = re.findall(r"^\| `(\w+)/(\w+)` \|[^|]*\|([^|]*)\|$", ARCHITECTURE, re.MULTILINE)
    return {(package, room): set(re.findall(r"`(\w+)`", arrows)) for package, room, arrows in rows}


def test_the_table_is_short_and_names_every_room() -> None:
    found = {(package, room) for package in PACKAGES for room in rooms(package)}
    assert set(_table()) == found
    assert len(found) <= 15
    assert len([path for path in (ROOT / "pyjoystick").iterdir() if path.name != "__pycache__"]) <= 14


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_follow_the_table(package: str) -> None:
    table = _table()
    unexpected = []
    for module, path in MODULES.items():
        if not module.startswith(f"{package}.") or _room(module) in ENTRANCES:
            continue
        allowed = {_room(module), *table[package, _room(module)]}
        for named, _ in _imports(path):
            target = _room(named) if named.startswith(package) else named.split(".")[0]
            if target not in allowed:
                unexpected.append(f"{module} imports {named}")
    assert not unexpected


def test_rooms_stand_above_what_they_lean_on() -> None:
    for package in PACKAGES:
        order = [room for owner, room in _table() if owner == package]
        for (owner, room), arrows in _table().items():
            if owner == package and room not in ENTRANCES:
                assert arrows <= set(order[: order.index(room)]), f"{room} leans on what stands above it"


def test_rooms_are_entered_by_their_doors() -> None:
    inside = [
        f"{module} imports {named}"
        for module, path in MODULES.items()
        for named, _ in _imports(path)
        if module.startswith("pyjoystick.")
        and named.startswith("pyjoystick.")
        and _room(module) != _room(named)
        and named.count(".") > 1
    ]
    assert not inside


def test_there_are_no_cycles() -> None:
    graph = {
        name: {_module(home) or home for _, home in _imports(path)} - {name} for name, path in MODULES.items()
    }
    list(TopologicalSorter(graph).static_order())
