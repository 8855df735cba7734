"""What holds for every script: few imports, results in the checkout, a test that runs it."""

from __future__ import annotations

import ast
from pathlib import Path

import pytest

from tests.scenarios.scripts import SCENARIOS, load

SCRIPTS = sorted(path.stem for path in SCENARIOS.glob("*.py"))
SOURCES = [*SCENARIOS.glob("*.py"), *SCENARIOS.glob("data/*.py")]


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.stem)
def test_a_scenario_imports_from_pyjoystick_and_at_most_two_rooms(path: Path) -> None:
    nodes = list(ast.walk(ast.parse(path.read_text(encoding="utf-8"))))
    modules = {node.module or "" for node in nodes if isinstance(node, ast.ImportFrom)}
    modules |= {alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names}
    rooms = {module for module in modules if module.startswith("pyjoystick.")}
    assert len(rooms) <= 2
    assert all(room.count(".") == 1 for room in rooms), "past the door of a room"


@pytest.mark.parametrize("name", SCRIPTS)
def test_results_go_into_the_checkout(name: str) -> None:
    assert SCENARIOS.parent / "results" / name == load(name).RESULTS


def test_every_script_has_a_test() -> None:
    tests = [path for path in Path(__file__).parent.glob("test_*.py") if path != Path(__file__)]
    text = "\n".join(path.read_text(encoding="utf-8") for path in tests)
    assert [name for name in SCRIPTS if f'"{name}"' not in text] == []
