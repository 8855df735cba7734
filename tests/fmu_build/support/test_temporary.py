"""Temporary folders of builds."""

from __future__ import annotations

import os
import tempfile
import time
from pathlib import Path

import pytest

from fmu_build.support import temporary


@pytest.fixture
def place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder of temporary files."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    temporary._remove_old.cache_clear()
    return tmp_path


def test_a_folder_is_there_and_gone(place: Path) -> None:
    with temporary.temporary_folder() as folder:
        assert list(place.iterdir()) == [folder]
        (folder / "file").write_text("")
    assert list(place.iterdir()) == []


def test_what_killed_builds_left_goes_a_day_later(
    place: Path, tmp_path_factory: pytest.TempPathFactory
) -> None:
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    (elsewhere / "kept").write_text("")
    (place / "fmu_build-link").symlink_to(elsewhere)
    ages = {"fmu_build-old": 25, "fmu_build-new": 23, "other-old": 25}
    for name, hours in ages.items():
        (place / name).mkdir()
        (place / name / "model.c").write_text("")
        os.utime(place / name, 2 * (time.time() - hours * 3600,))
    os.utime(elsewhere, (0, 0))
    with temporary.temporary_folder():
        assert not (place / "fmu_build-old").exists()
    assert sorted(path.name for path in place.iterdir()) == ["fmu_build-link", "fmu_build-new", "other-old"]
    assert (elsewhere / "kept").exists()
