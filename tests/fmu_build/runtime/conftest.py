"""The runtime and the hand-written models, compiled once per session."""

from __future__ import annotations

import ctypes
from collections.abc import Callable

import pytest

from tests.fmu_build.runtime.library import Workshop

Build = Callable[[str], ctypes.CDLL]


@pytest.fixture(scope="session")
def build(tmp_path_factory: pytest.TempPathFactory) -> Build:
    """Name of a model in ``models/`` -> its shared library of FMI 2."""
    return Workshop(tmp_path_factory.mktemp("runtime")).library


@pytest.fixture(scope="session")
def build3(tmp_path_factory: pytest.TempPathFactory) -> Build:
    """The same of FMI 3."""
    return Workshop(tmp_path_factory.mktemp("runtime3"), "3.0").library
