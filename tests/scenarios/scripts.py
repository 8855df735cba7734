"""Scripts of the scenarios as modules."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

SCENARIOS = Path(__file__).parents[2] / "scenarios"


def load(name: str) -> ModuleType:
    """The script scenarios/`name`.py."""
    path = SCENARIOS / f"{name}.py"
    spec = importlib.util.spec_from_file_location(f"scenario_{path.stem}", path)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def cells(printed: str, first: str, table: int = 0) -> list[str]:
    """The cells after the first of a row of a printed table; `table` counts the rows that begin so."""
    rows = [line for line in printed.splitlines() if line.startswith(f"| {first} ")]
    return [cell.strip() for cell in rows[table].split("|")[2:-1]]
