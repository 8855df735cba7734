"""An FMU with a module built by the compiler, and a function that puts hostile modules into FMUs."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.fmu import read_description
from tests.pyjoystick.fmu.sandbox.hostile import Smuggle, with_module
from tests.shared_fmus import SharedFmus


@pytest.fixture(scope="session")
def visitor(shared_fmus: SharedFmus) -> Path:
    """An FMU with variables of all types, and its own module."""
    library = Path(__file__).with_name("Visitor.mo")
    return shared_fmus.fmu("Visitor", library, platforms=("wasm32",))


@pytest.fixture
def smuggle(visitor: Path, tmp_path: Path) -> Smuggle:
    """Puts a module in place of that of the FMU."""
    identifier = read_description(visitor).interfaces["CoSimulation"]
    return lambda module: with_module(visitor, tmp_path / "hostile.fmu", identifier, module)
