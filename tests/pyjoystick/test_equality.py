"""Objects that hold arrays or tables are equal if they are the same object; ``==`` is never an error."""

from __future__ import annotations

import ast
import dataclasses
import re
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pyjoystick
from pyjoystick.fmu import Fmu
from tests.pyjoystick.test_public_names import ROOMS

SOURCES = Path(pyjoystick.__file__).parent
#: Annotations of what compares sample by sample.
ARRAYS = re.compile(r"Array\b|ndarray|NDArray|DataFrame|Series\b|Index\b")


def _classes(path: Path) -> list[ast.ClassDef]:
    return [one for one in ast.walk(ast.parse(path.read_text())) if isinstance(one, ast.ClassDef)]


def _fields(one: ast.ClassDef) -> list[str]:
    return [ast.unparse(line.annotation) for line in one.body if isinstance(line, ast.AnnAssign)]


def _compares_fields(one: ast.ClassDef) -> bool:
    options = [ast.unparse(decorator) for decorator in one.decorator_list]
    return any(text.startswith("dataclass") and "eq=False" not in text for text in options)


def test_dataclasses_of_arrays_compare_by_identity() -> None:
    faults = [
        f"{path.relative_to(SOURCES)}: {one.name}"
        for path in SOURCES.rglob("*.py")
        for one in _classes(path)
        if _compares_fields(one)
        and any(ARRAYS.search(text) and "Callable" not in text for text in _fields(one))
    ]
    assert faults == []


def _public_dataclasses() -> list[type[Any]]:
    found = {
        one
        for door in ROOMS
        for one in (getattr(import_module(door), name) for name in import_module(door).__all__)
        if isinstance(one, type) and dataclasses.is_dataclass(one)
    }
    return sorted(found, key=lambda one: one.__qualname__)


@pytest.mark.parametrize("kind", _public_dataclasses(), ids=lambda one: one.__qualname__)
def test_equal_results_compare_without_an_error(kind: type[Any]) -> None:
    """Two objects whose fields are what the annotations promise, arrays where they promise these."""

    def made() -> Any:
        one = kind.__new__(kind)
        for field in dataclasses.fields(kind):
            value = np.zeros(2) if ARRAYS.search(str(field.type)) else field.name
            object.__setattr__(one, field.name, value)
        return one

    first = made()
    assert (first == first) is True
    assert (first == made()) in (True, False)


def test_a_linearization_and_a_batch(joystick_fmus: Path) -> None:
    with Fmu(joystick_fmus / "Joystick.fmu") as fmu:
        one, other = (fmu.linearize(parameters={"theta_start": 0.1}) for _ in range(2))
        plan = fmu.plan([0.0, 0.1], varied="theta_start", outputs="theta")
        first, second = (plan.run_batch([[0.1]]) for _ in range(2))
    assert one != other
    assert first != second
    assert first == first
