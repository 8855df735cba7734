"""The names that ``import pyjoystick`` provides, and that it is fast."""

from __future__ import annotations

import subprocess
import sys
from importlib import import_module
from pathlib import Path
from types import ModuleType

import pytest
from extensions.imports import rooms

import pyjoystick
from tests.test_architecture import ENTRANCES

ROOMS = ["pyjoystick", *(f"pyjoystick.{room}" for room in sorted(rooms("pyjoystick") - ENTRANCES))]


@pytest.mark.parametrize("door", ROOMS)
def test_every_name_of_a_door_is_there(door: str) -> None:
    """A module of the same name beside the door would stand in the way of what the door promises."""
    module = import_module(door)
    assert module.__all__
    assert set(dir(module)) == set(module.__all__)
    for name in module.__all__:
        assert not isinstance(getattr(module, name), ModuleType), name


def test_other_names_are_errors() -> None:
    with pytest.raises(AttributeError, match="No pyjoystick attribute Joystick"):
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
