"""The import graph is what docs/architecture.md says, and has no cycles."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from graphlib import TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
ARCHITECTURE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")


def _modules(package: str) -> dict[str, Path]:
    files = (ROOT / package).rglob("*.py")
    return {".".join(file.relative_to(ROOT).with_suffix("").parts): file for file in files}


MODULES = {name: path for package in ("pyjoystick", "fmu_build") for name, path in _modules(package).items()}


def _imports(path: Path) -> Iterator[str]:
    """The modules of this project that a file imports, by their full names."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (found for alias in node.names if (found := _module(alias.name)))
        elif isinstance(node, ast.ImportFrom) and node.module:
            for alias in node.names:
                found = _module(f"{node.module}.{alias.name}") or _module(node.module)
                if found:
                    yield found


def _module(name: str) -> str | None:
    return next((module for module in (name, f"{name}.__init__") if module in MODULES), None)


def _part(module: str) -> str:
    return module.split(".")[1]


def _allowed(package: str) -> dict[str, set[str]]:
    """The table of arrows of one package."""
    table = re.search(rf"\| part of `{package}` \| may import \|\n\|---\|---\|\n((?:\|.*\n)+)", ARCHITECTURE)
    assert table, f"docs/architecture.md has no table of arrows for {package}"
    rows = {}
    for row in table.group(1).splitlines():
        part, arrows = (cell.strip() for cell in row.strip("|").split("|"))
        rows[part.strip("`")] = set(re.findall(r"`(\w+)`", arrows))
    if "cli" in rows:
        rows["cli"] |= set(rows)
    return rows


@pytest.mark.parametrize("package", ["pyjoystick", "fmu_build"])
def test_imports_follow_the_architecture(package: str) -> None:
    allowed = _allowed(package)
    found = {_part(module) for module in _modules(package)}
    assert found == set(allowed), "parts without a row, or rows without a part"
    unexpected = [
        f"{module} imports {imported}"
        for module, path in _modules(package).items()
        for imported in _imports(path)
        if _target(package, imported) not in {*allowed[_part(module)], _part(module)}
    ]
    assert not unexpected


def _target(package: str, imported: str) -> str:
    """The part that is imported, or the other package as a whole."""
    return _part(imported) if imported.startswith(f"{package}.") else imported.split(".")[0]


def test_there_are_no_cycles() -> None:
    graph = {name: set(_imports(path)) - {name} for name, path in MODULES.items()}
    list(TopologicalSorter(graph).static_order())
