"""The runtime and the hand-written models, compiled once per session."""

from __future__ import annotations

import ctypes
from collections.abc import Callable

import pytest

from tests.fmu_build.runtime.library import Workshop

Build = Callable[[str], ctypes.CDLL]


@pytest.fixture(scope="session")
def workshop2(tmp_path_factory: pytest.TempPathFactory) -> Workshop:
    """The runtime with FMI 2."""
    return Workshop(tmp_path_factory.mktemp("runtime"))


@pytest.fixture(scope="session")
def build(workshop2: Workshop) -> Build:
    """Name of a model in ``models/`` -> its shared library of FMI 2."""
    return workshop2.library


@pytest.fixture(scope="session")
def units(workshop2: Workshop) -> ctypes.CDLL:
    """The files that are tested without the rest of the runtime."""
    return workshop2.units()


@pytest.fixture(scope="session")
def build3(tmp_path_factory: pytest.TempPathFactory) -> Build:
    """The same of FMI 3."""
    return Workshop(tmp_path_factory.mktemp("runtime3"), "3.0").library
