"""Invalid files of fits and budgets: the reason, and what to do."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from pyjoystick.identification import read_budget, read_fit
from pyjoystick.support import InputFileError, versions

OWN = versions()["pyjoystick"]


@pytest.mark.parametrize(
    ("read", "again"),
    [(read_fit, "pyjoystick fit ... --output FOLDER"), (read_budget, "pyjoystick budget ... --json FILE")],
)
@pytest.mark.parametrize(
    ("version", "cause"),
    [
        ("0.0.3", "was written by version 0.0.3 of pyjoystick"),
        (OWN, f"was edited, or written by an earlier state of pyjoystick {OWN}"),
    ],
)
def test_a_file_of_another_version_says_so_and_how_to_make_it_anew(
    read: Callable[[str], object], again: str, version: str, cause: str, tmp_path: Path
) -> None:
    path = tmp_path / "old.json"
    path.write_text(json.dumps({"made_with": {"pyjoystick": version}}), encoding="utf-8")
    with pytest.raises(InputFileError) as caught:
        read(str(path))
    assert f"old.json: {cause} (" in str(caught.value)
    assert f"make it anew with `{again}`" in str(caught.value)


@pytest.mark.parametrize("content", ["[]", "{}", '{"made_with": 3}'])
def test_any_other_json_is_not_said_to_be_of_another_version(content: str, tmp_path: Path) -> None:
    path = tmp_path / "other.json"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(InputFileError, match=r"other\.json: is no fit\.json of pyjoystick fit: "):
        read_fit(path)
