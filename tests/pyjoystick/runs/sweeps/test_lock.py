"""One process at a time, on every system."""

from __future__ import annotations

import importlib.util
import sys
from pathlib import Path
from types import ModuleType
from typing import IO, Any

import pytest

from pyjoystick.runs.sweeps import lock


def test_the_second_has_to_wait_for_the_first(tmp_path: Path) -> None:
    with (tmp_path / "lock").open("w") as first, (tmp_path / "lock").open("w") as second:
        assert lock.locked(first)
        assert not lock.locked(second)
        first.close()
        assert lock.locked(second)


class _Msvcrt(ModuleType):
    """What Windows has in place of fcntl: a lock of bytes of a file, each for one holder."""

    LK_NBLCK = 2

    def __init__(self) -> None:
        super().__init__("msvcrt")
        self.held: set[tuple[int, int]] = set()

    def locking(self, descriptor: int, mode: int, size: int) -> None:
        assert (mode, size) == (self.LK_NBLCK, 1)
        place = Path(f"/proc/self/fd/{descriptor}").stat()
        if (place.st_dev, place.st_ino) in self.held:
            raise PermissionError(13, "Permission denied")
        self.held.add((place.st_dev, place.st_ino))


@pytest.fixture
def on_windows(monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The module as Windows loads it, where there is no fcntl."""
    monkeypatch.setitem(sys.modules, "fcntl", None)
    monkeypatch.setitem(sys.modules, "msvcrt", _Msvcrt())
    spec = importlib.util.spec_from_file_location("lock_on_windows", lock.__file__)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    with monkeypatch.context() as inner:
        inner.setattr(sys, "platform", "win32")
        spec.loader.exec_module(module)
    return module


def test_windows_has_a_lock_of_its_own(on_windows: ModuleType, tmp_path: Path) -> None:
    with (tmp_path / "lock").open("w") as first, (tmp_path / "lock").open("w") as second:
        assert on_windows.locked(first)
        assert not on_windows.locked(second)


def test_other_errors_are_not_a_lock(tmp_path: Path) -> None:
    closed: IO[Any] = (tmp_path / "lock").open("w")
    closed.close()
    with pytest.raises(ValueError, match="closed file"):
        lock.locked(closed)
