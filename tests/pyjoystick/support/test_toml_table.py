"""Mistakes in TOML files are reported with their position."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.support import (
    InputFileError,
    ParameterError,
    SettingsError,
    Table,
    UnknownVariableError,
    read_toml,
)

TEXT = """
number = 1.5
words = ["a", "b"]

[outer."inner one"]
value = 3
flag = true

[[rows]]
n = 1

[[rows]]
n = 2
"""


@pytest.fixture
def root(tmp_path: Path) -> Table:
    path = tmp_path / "file.toml"
    path.write_text(TEXT)
    return read_toml(path)


def test_what_is_asked_for_is_known_and_the_rest_is_refused(root: Table) -> None:
    assert root.number("number") == 1.5
    assert root.words("words") == ["a", "b"]
    (name, inner), *others = root.table("outer").subtables()
    assert (name, others) == ("inner one", [])
    assert [row.integer("n", 1) for row in root.tables("rows")] == [1, 2]
    assert inner.flag("flag")
    with pytest.raises(
        SettingsError, match=r'\[outer."inner one"\] value: is not a known key \(known are flag\)'
    ):
        root.finish()
    assert "value" in root.table("outer").table("inner one")
    root.finish()


def test_rows_are_finished_too(root: Table) -> None:
    for key in ("number", "words", "outer"):
        assert key in root
    root.tables("rows")[0].integer("n", 1)
    with pytest.raises(SettingsError, match=r"\[rows 2\] n: is not a known key"):
        root.finish()


@pytest.mark.parametrize(
    ("key", "field", "place"),
    [
        ("", "number", "number = 1.5: must be even"),
        ("", "fit.number", "number = 1.5: must be even"),
        ("", "absent", "absent = 3: must be even"),
        ("", "words[1]", r"words\[1\] = 3: must be even"),
        ("", "elsewhere", "file.toml: must be even"),
        ("words", "number", r'words = \["a", "b"\]: must be even'),
    ],
)
def test_a_value_is_refused_at_its_key(root: Table, key: str, field: str, place: str) -> None:
    for known in ("number", "absent", "words"):
        root.optional(known)
    with pytest.raises(SettingsError, match=place), root.at(key):
        raise ParameterError(field, 3, "even")


def test_names_and_other_errors(root: Table) -> None:
    with pytest.raises(SettingsError, match="words: there is no variable 'z'; known are x"), root.at("words"):
        raise UnknownVariableError("z", ["x"])
    with pytest.raises(InputFileError, match="gone"), root.at("words"):
        raise InputFileError(Path("a"), "gone")


def test_wrong_types(root: Table) -> None:
    with pytest.raises(SettingsError, match="must be true or false"):
        root.flag("number")
    with pytest.raises(SettingsError, match="must be a list"):
        root.words("number")
    assert not root.flag("absent")


@pytest.mark.parametrize("text", ["[" * 100_000, "9" * 10_000])
def test_what_is_beyond_measure_is_no_internal_error(text: str, tmp_path: Path) -> None:
    path = tmp_path / "deep.toml"
    path.write_text(f"a = {text}")
    with pytest.raises(SettingsError, match="is not TOML: "):
        read_toml(path)


@pytest.mark.parametrize("text", ["{}", "[1.0, {}]", "[[1.0], [{}]]"])
@pytest.mark.parametrize("number", ["1" + "0" * 400, str(2**64), str(-(2**63) - 1)])
def test_a_whole_number_beyond_64_bits_is_refused_at_its_place(
    text: str, number: str, tmp_path: Path
) -> None:
    path = tmp_path / "large.toml"
    path.write_text(f"[one.two]\na = {text.format(number)}")
    with pytest.raises(SettingsError, match=r"\[one.two\] a = \[*.*: a whole number must fit in 64 bits"):
        read_toml(path)


def test_the_largest_and_the_smallest_whole_number_are_read(tmp_path: Path) -> None:
    path = tmp_path / "large.toml"
    path.write_text(f"a = [{2**64 - 1}, {-(2**63)}]")
    assert read_toml(path).entries("a") == [2**64 - 1, -(2**63)]


def test_a_byte_order_mark_is_no_content(tmp_path: Path) -> None:
    path = tmp_path / "marked.toml"
    path.write_text("a = [1]", encoding="utf-8-sig")
    assert read_toml(path).entries("a") == [1]


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="there is no /dev/zero")
def test_a_file_without_an_end_is_refused() -> None:
    with pytest.raises(InputFileError, match="/dev/zero: is larger than 50 MB, which no settings are"):
        read_toml(Path("/dev/zero"))
