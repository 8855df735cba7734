"""Finding libraries and the classes in them."""

from __future__ import annotations

from importlib import resources
from pathlib import Path

import pytest

from fmu_build.compilers.library import (
    default_library,
    entry_file,
    mentions,
    needed_files,
    not_found,
    read_classes,
)
from fmu_build.support.errors import ModelicaError, ModelNotFoundError

_ONE_FILE = """
within Lib.Sub;
/* model Commented end Commented; */
encapsulated package P "package Described"
  type Kind = enumeration(A, B);
  // model Hidden
  model M "end M;"
    replaceable model Law = Constant;
    record R Real x; end R;
    function f input Real u; output Real y; algorithm y := if u > 0 then 1 else 2; end f;
  equation
    when time > 1 then reinit(x, 0); end when;
  end M;
  block 'quoted name' end 'quoted name';
  partial model Base end Base;
  model extends Inherited(k = 2) end Inherited;
  operator record Complex end Complex;
  expandable connector Bus end Bus;
  model Last end Last;
end P;
"""


def _names(path: Path) -> dict[str, str]:
    return {c.name: c.kind for c in read_classes(path).values()}


def test_classes_of_one_file(tmp_path: Path) -> None:
    (tmp_path / "P.mo").write_text(_ONE_FILE)
    assert _names(tmp_path / "P.mo") == {
        "Lib.Sub.P": "package",
        "Lib.Sub.P.Kind": "type",
        "Lib.Sub.P.M": "model",
        "Lib.Sub.P.M.Law": "model",
        "Lib.Sub.P.M.R": "record",
        "Lib.Sub.P.M.f": "function",
        "Lib.Sub.P.'quoted name'": "block",
        "Lib.Sub.P.Base": "partial model",
        "Lib.Sub.P.Inherited": "model",
        "Lib.Sub.P.Complex": "record",
        "Lib.Sub.P.Bus": "connector",
        "Lib.Sub.P.Last": "model",
    }


@pytest.mark.parametrize(
    "text", ["", "model", "model A", "within", "end A;", "model A extends", '"', "model model A;"]
)
def test_incomplete_files_do_not_stop_the_reader(tmp_path: Path, text: str) -> None:
    (tmp_path / "A.mo").write_text(text)
    assert set(_names(tmp_path / "A.mo")) <= {"A"}


def test_a_file_that_cannot_be_read(tmp_path: Path) -> None:
    (tmp_path / "A.mo").symlink_to(tmp_path / "missing.mo")
    with pytest.raises(ModelicaError, match=r"cannot read .*A\.mo: No such file"):
        read_classes(tmp_path)


def test_classes_of_a_package_folder(tmp_path: Path) -> None:
    (tmp_path / "Sub").mkdir()
    (tmp_path / "package.mo").write_text("package L end L;")
    (tmp_path / "A.mo").write_text("within L; model A end A;")
    (tmp_path / "Sub" / "package.mo").write_text("within L; package Sub end Sub;")
    (tmp_path / "Sub" / "B.mo").write_text("within L.Sub; block B end B;")
    classes = read_classes(tmp_path)
    assert set(classes) == {"L", "L.A", "L.Sub", "L.Sub.B"}
    assert classes["L.Sub.B"].file == tmp_path / "Sub" / "B.mo"


def test_default_library_has_the_joystick() -> None:
    assert _names(default_library())["PreloadedSprings.Joystick.Joystick"] == "model"


def test_default_library_in_an_installation(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    installed = tmp_path / "fmu_build"
    monkeypatch.setattr(resources, "files", lambda package: tmp_path / package)
    with pytest.raises(ModelNotFoundError, match="PreloadedSprings is missing"):
        default_library()
    for folder in (tmp_path, installed):  # the checkout's place, then the installation's, which comes first
        library = folder / "modelica" / "PreloadedSprings"
        library.mkdir(parents=True)
        (library / "package.mo").write_text("")
        assert default_library() == library


def test_entry_file(tmp_path: Path) -> None:
    (tmp_path / "A.mo").write_text("")
    assert entry_file(tmp_path / "A.mo") == tmp_path / "A.mo"
    (tmp_path / "package.mo").write_text("")
    assert entry_file(tmp_path) == tmp_path / "package.mo"


@pytest.mark.parametrize(
    ("name", "message"),
    [("missing", "missing does not exist"), ("folder", "no package.mo"), ("A.txt", r"must end in \.mo")],
)
def test_no_library(tmp_path: Path, name: str, message: str) -> None:
    (tmp_path / "folder").mkdir()
    (tmp_path / "A.txt").write_text("")
    with pytest.raises(ModelNotFoundError, match=message):
        entry_file(tmp_path / name)


@pytest.mark.parametrize(
    ("asked", "hint"),
    [
        ("PreloadedSprings.Joystick.Joystik", "did you mean PreloadedSprings.Joystick.Joystick"),
        ("joystick", "PreloadedSprings.Joystick.Joystick"),
        ("PreloadedSprings.Joystick", "is a package; only complete models and blocks can become FMUs"),
    ],
)
def test_suggestions(asked: str, hint: str) -> None:
    library = default_library()
    assert hint in str(not_found(asked, library, read_classes(library)))


def test_no_suggestion_for_what_resembles_nothing() -> None:
    library = default_library()
    assert str(not_found("Zzz", library, read_classes(library))) == f"there is no model 'Zzz' in {library}"


def test_mentions_whole_words(tmp_path: Path) -> None:
    (tmp_path / "A.mo").write_text("model A extends Lib.B; end A;")
    assert mentions(tmp_path / "A.mo", "Lib")
    assert not mentions(tmp_path / "A.mo", "Li")


def test_what_has_to_be_loaded_for_a_file(tmp_path: Path) -> None:
    """Neighbors that it mentions, what these mention, and this project's library, each before its users."""
    for name, text in {
        "Top": "model Top extends Middle; end Top;",
        "Middle": "model Middle Low low; end Middle;",
        "Low": "model Low PreloadedSprings.Parts.Fixed wall; end Low;",
        "Other": "model Other extends Top; end Other;",
    }.items():
        (tmp_path / f"{name}.mo").write_text(text)
    own = default_library() / "package.mo"
    assert needed_files(tmp_path / "Top.mo") == [
        own,
        tmp_path / "Low.mo",
        tmp_path / "Middle.mo",
        tmp_path / "Top.mo",
    ]
    assert needed_files(tmp_path / "Low.mo") == [own, tmp_path / "Low.mo"]


def test_what_has_to_be_loaded_for_a_package(tmp_path: Path) -> None:
    folder = tmp_path / "Lib"
    folder.mkdir()
    (folder / "package.mo").write_text("package Lib end Lib;")
    (tmp_path / "Neighbor.mo").write_text("model Neighbor end Neighbor;")
    (folder / "M.mo").write_text("within Lib; model M extends Neighbor; end M;")
    assert needed_files(folder) == [folder / "package.mo"]
    (folder / "N.mo").write_text("within Lib; model N extends PreloadedSprings.Joystick.Joystick; end N;")
    assert needed_files(folder) == [default_library() / "package.mo", folder / "package.mo"]
    assert needed_files(default_library()) == [default_library() / "package.mo"]
