"""Finding constructs only in the source of classes that a model may use."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import pytest

from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.places import Place
from fmu_build.compilers.library import read_text, readable_files


def _texts(files: Iterable[Path]) -> dict[Path, str]:
    return {file: read_text(file) for file in files}


_PACKAGE = """within;
package Lib "Größe: der(no)"
  constant Real c = f(1);
  model A
    extends Base;
    replaceable model Law = Hooke;
    Law law(redeclare model Unused = Real, k = der(k));
  end A;
  model B // der(b)
    Real y = der(b);
  end B;
  model C
    Real text(unit="der(no)") = der(c*(1 +
      size(k, 1)));
  end C;
  model Short = B(y=1);
  function f
    external "C";
  end f;
end Lib;
"""
_BASE = 'within Lib;\r\nmodel Base "µ"\r\n  Real x; /* µ */ Real y = der( a );\r\nend Base;\r\n'
_HOOKE = "within Lib;\nmodel Hooke\n  Real y = der(h);\nend Hooke;\n"
_DER = (r"\bder\s*\(",)


@pytest.fixture
def library(tmp_path: Path) -> Path:
    for name, text in {"package": _PACKAGE, "Base": _BASE, "Hooke": _HOOKE}.items():
        (tmp_path / f"{name}.mo").write_bytes(text.encode())
    return tmp_path


def _found(library: Path, model: str, *patterns: str) -> dict[str, str]:
    found = ModelText(model, _texts(readable_files(library))).find(patterns or _DER)
    return {construct.text: str(construct.place).removeprefix(f"{library}/") for construct in found}


@pytest.mark.parametrize("argument", ["function f(a = 2)", "function f ( )", "function Lib.'f 1'.g(a = 2)"])
def test_a_function_as_an_argument_declares_no_class(argument: str, tmp_path: Path) -> None:
    text = f"model M\n  Real y = integral({argument}, time);\n  Real z = der(y);\nend M;\n"
    found = ModelText("M", {tmp_path / "M.mo": text}).find(_DER)
    assert [(one.text, one.place.line) for one in found] == [("der(y)", 3)]


def test_base_classes_and_replaceable_classes_belong_to_a_model(library: Path) -> None:
    assert _found(library, "Lib.A") == {
        "der(k)": "package.mo:7:48",
        "der( a )": "Base.mo:3:28",
        "der(h)": "Hooke.mo:3:12",
    }


def test_the_other_classes_of_a_file_do_not(library: Path) -> None:
    assert _found(library, "Lib.B") == {"der(b)": "package.mo:10:14"}


def test_what_a_short_class_stands_for_does(library: Path) -> None:
    assert _found(library, "Lib.Short") == {"der(b)": "package.mo:10:14"}


def test_what_the_package_around_a_model_uses_does(library: Path) -> None:
    assert _found(library, "Lib.B", r"\bexternal\b") == {"external": "package.mo:18:5"}


def test_a_construct_over_two_lines_up_to_its_parenthesis(library: Path) -> None:
    assert _found(library, "Lib.C") == {"der(c*(1 + size(k, 1)))": "package.mo:13:33"}


def test_the_first_pattern_with_a_match_counts(library: Path) -> None:
    assert _found(library, "Lib.C", r"\bnothing\b", r"\bReal\b", r"\bder\b") == {"Real": "package.mo:13:5"}
    assert _found(library, "Lib.C", r"\bnothing\b") == {}


def test_bytes_of_an_unknown_file(library: Path) -> None:
    start = _BASE.encode().index(b"der(")
    text = ModelText("Lib.A", _texts(readable_files(library)))
    place = Place(str(library / "Base.mo"), 3, 28)
    assert text.at_bytes(start, start + len("der( a )"), r"der\(.*\)") == [Construct("der( a )", place)]
    assert text.at_bytes(start + 1, start + len("der( a )"), r"der\(.*\)") == []


def test_files_beside_a_single_file_are_read_too(library: Path) -> None:
    (library / "User.mo").write_text("model User\n  extends Lib.B;\nend User;\n")
    files = ModelText("User", _texts(readable_files(library / "User.mo"))).find(_DER)
    assert [construct.place.line for construct in files] == [10]


def test_a_class_of_the_same_name_in_a_package_that_is_not_mentioned_does_not_belong(tmp_path: Path) -> None:
    (tmp_path / "Mine.mo").write_text(
        "package Mine\n  import Imported;\n  model A Part p; Deep.Part q; end A;\n"
        "  model Part Real x = der(mine); end Part;\nend Mine;\n"
    )
    for name in ("Imported", "Deep", "Other"):
        text = f"package {name}\n  model Part Real x = der({name}); end Part;\nend {name};\n"
        (tmp_path / f"{name}.mo").write_text(text)
    assert set(_found(tmp_path, "Mine.A")) == {"der(mine)", "der(Imported)", "der(Deep)"}


def test_nor_do_classes_in_such_a_class(tmp_path: Path) -> None:
    """Other.Part.Inner, though a name in this model is Part.Inner."""
    for name in ("Mine", "Other"):
        text = (
            f"model {name}\n  model Part model Inner Real x = der({name}); end Inner; end Part;\n"
            f"  Part.Inner p;\nend {name};\n"
        )
        (tmp_path / f"{name}.mo").write_text(text)
    assert set(_found(tmp_path, "Mine")) == {"der(Mine)"}
