"""What ``import pyjoystick`` gives, and that it gives it quickly."""

from __future__ import annotations

import ast
import subprocess
import sys
from pathlib import Path

import pytest

import pyjoystick
from pyjoystick import comparison, experiments, fmu, fmu_comparison, peaks

HOMES = {
    "Fmu": fmu.Fmu,
    "FmuRunError": fmu.FmuRunError,
    "compare": comparison.compare,
    "compare_fmus": fmu_comparison.compare_fmus,
    "find_peaks": peaks.find_peaks,
    "free_oscillation": experiments.free_oscillation,
    "reference_free_oscillation": experiments.reference_free_oscillation,
}


@pytest.mark.parametrize("name", pyjoystick.__all__)
def test_every_public_name_is_there(name: str) -> None:
    value = getattr(pyjoystick, name)
    assert value is HOMES.get(name, value)
    assert name in dir(pyjoystick)


def test_the_type_checker_sees_the_same_names() -> None:
    tree = ast.parse(Path(str(pyjoystick.__file__)).read_text(encoding="utf-8"))
    (checked,) = (node for node in tree.body if isinstance(node, ast.If))
    imported = {
        alias.name for node in checked.body if isinstance(node, ast.ImportFrom) for alias in node.names
    }
    assert imported == set(pyjoystick._HOMES) == set(pyjoystick.__all__)


def test_other_names_are_errors() -> None:
    with pytest.raises(AttributeError, match="module 'pyjoystick' has no attribute 'Joystick'"):
        _ = pyjoystick.Joystick  # type: ignore[attr-defined]


def test_the_import_loads_nothing_heavy() -> None:
    program = """
import sys, pyjoystick
heavy = {"numpy", "pandas", "scipy", "fmpy", "matplotlib", "numba", "typer"} & set(sys.modules)
assert not heavy, heavy
pyjoystick.find_peaks
assert "pandas" in sys.modules
"""
    done = subprocess.run(
        [sys.executable, "-c", program],
        cwd=Path(__file__).parents[2],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
