"""Parameter files for tests to modify."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.model import PAPER


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """A copy of the shipped file."""
    path = tmp_path / "joystick.toml"
    path.write_text(PAPER.path.read_text(encoding="utf-8"), encoding="utf-8")
    return path


def change(path: Path, *pairs: tuple[str, str]) -> None:
    """Replace text that occurs once."""
    text = path.read_text(encoding="utf-8")
    for old, new in pairs:
        assert text.count(old) == 1, old
        text = text.replace(old, new)
    path.write_text(text, encoding="utf-8")
