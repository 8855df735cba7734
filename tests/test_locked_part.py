"""The packages that ``make run`` installs: the part of the lock needed for running and building FMUs."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT))

from locked_part import locked_part  # noqa: E402

PROJECT = """
[build-system]
requires = ["builder"]
[project]
dependencies = ["Base_Package>=1"]
[project.optional-dependencies]
fast = ["quick[more]>=2"]
test = ["heavy"]
"""
HASH = "    --hash=sha256:00"


def _block(pin: str, *users: str) -> str:
    via = [f"    # via {users[0]}"] if len(users) == 1 else ["    # via", *(f"    #   {u}" for u in users)]
    return "\n".join([f"{pin} \\", HASH, *via, ""])


LOCK = "# made by a tool\n" + "".join(
    (
        _block("base-package==1.2", "name (pyproject.toml)"),
        _block("builder==3", "name (pyproject.toml)"),
        _block("cmake==4", "base-package"),
        _block("deep==1 ; python_full_version < '3.12'", "of-base"),
        _block("deep==2 ; python_full_version >= '3.12'", "of-base"),
        _block("heavy==1", "name (pyproject.toml)"),
        _block("of-base==1", "base-package", "heavy"),
        _block("of-heavy==1", "heavy"),
        _block("quick==2", "name (pyproject.toml)", "heavy"),
    )
)


def _pins(part: str) -> list[str]:
    return re.findall(r"^(\S+)==", part, re.MULTILINE)


def test_a_part_holds_what_its_packages_need_and_no_more() -> None:
    assert _pins(locked_part(PROJECT, LOCK, [])) == ["base-package", "builder", "deep", "deep", "of-base"]
    assert _pins(locked_part(PROJECT, LOCK, ["fast"]))[-1] == "quick"
    whole = locked_part(PROJECT, LOCK, ["fast", "test"])
    assert whole == LOCK.removeprefix("# made by a tool\n").replace(_block("cmake==4", "base-package"), "")


def test_a_lock_that_lacks_a_dependency_is_told() -> None:
    with pytest.raises(SystemExit, match="lacks base-package"):
        locked_part(PROJECT, LOCK.replace("base-package==", "other=="), [])


def test_running_needs_no_tool_of_the_tests() -> None:
    command = [sys.executable, str(ROOT / "locked_part.py"), "build", "openmodelica"]
    pins = _pins(subprocess.run(command, check=True, capture_output=True, text=True).stdout)
    assert {"fmpy", "hatchling", "matplotlib", "ompython", "rumoca", "scipy", "ziglang"} <= set(pins)
    assert not {"casadi", "cmake", "llvmlite", "mypy", "pyarrow", "pytest", "sphinx"} & set(pins)
