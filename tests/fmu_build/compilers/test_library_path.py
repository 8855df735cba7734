"""Libraries that use other libraries: given, in the same folder, and in MODELICAPATH."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from fmu_build.compilers.library_path import find_libraries, reached_source
from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.errors import ModelicaError, ModelNotFoundError
from fmu_build.support.request import BuildRequest

_GAINS = """package Gains
  constant Real factor = {factor};
  model Unneeded
    Missing.Library.Part part;
  end Unneeded;
  package Interfaces
    partial model Base
      Real x(start = 1, fixed = true);
    end Base;
  end Interfaces;
end Gains;
"""
_USER = """package User
  extends Icons.Package;
  model Decay
    extends Gains.Interfaces.Base;
  equation
    der(x) = -Gains.factor*x;
  end Decay;
  package Icons
    partial package Package
    end Package;
  end Icons;
  annotation(uses(Gains(version = "2.0.0")));
end User;
"""


@pytest.fixture(autouse=True)
def _no_path(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("MODELICAPATH", raising=False)


def _library(folder: Path, text: str, name: str = "package") -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{name}.mo").write_text(text)
    return folder


def _gains(folder: Path, factor: int) -> Path:
    return _library(folder, _GAINS.format(factor=factor))


def _slope(*libraries: Path) -> float:
    """Return the factor in the derivative of User.Decay, in its C code."""
    request = BuildRequest("User.Decay", Path("unused"), further=libraries)
    generated: Any = generate_model(request)[0]
    numbers = [n for n in (2, 3, 5) if f"-({n}.0 * " in generated.c_source]
    assert len(numbers) == 1, generated.c_source
    return numbers[0]


def test_several_libraries_in_any_order(tmp_path: Path) -> None:
    user, gains = _library(tmp_path / "a" / "User", _USER), _gains(tmp_path / "b" / "Gains", 3)
    assert _slope(user, gains) == _slope(gains, user) == 3


def test_a_library_beside_the_given_one(tmp_path: Path) -> None:
    _gains(tmp_path / "Gains", 5)
    assert _slope(_library(tmp_path / "User", _USER)) == 5


def test_modelica_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The version that the library asks for is taken, whatever else is there, and the variable is left."""
    user = _library(tmp_path / "a" / "User", _USER)
    for version, factor in (("Gains 2.0.0", 2), ("Gains 3.0.0", 3), ("Gains", 5)):
        _gains(tmp_path / "b" / version, factor)
    value = os.pathsep.join([str(tmp_path / "missing"), str(tmp_path / "b")])
    monkeypatch.setenv("MODELICAPATH", value)
    assert _slope(user) == 2
    assert os.environ["MODELICAPATH"] == value


def test_a_model_of_a_library_in_modelica_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    _library(tmp_path / "User", _USER)
    _gains(tmp_path / "Gains", 3)
    monkeypatch.setenv("MODELICAPATH", str(tmp_path))
    assert _slope() == 3


def test_errors_in_a_used_library_have_their_place(tmp_path: Path) -> None:
    user = _library(tmp_path / "User", _USER)
    gains = _gains(tmp_path / "Gains", 3)
    file = gains / "package.mo"
    file.write_text(file.read_text().replace("Real x(start", "Real x(stert"))
    with pytest.raises(ModelicaError, match="stert") as caught:
        _slope(user)
    assert str(caught.value).startswith(f"{file}:")


@pytest.mark.parametrize(
    ("use", "line"),
    [
        ("extends Modelica.Icons.Example;", 2),
        ("import Modelica.Constants.pi;", 2),
        ('Real x = 1; /* Modelica.Constants.pi */ annotation(uses(Modelica(version = "4.0.0")));', None),
    ],
)
def test_the_standard_library_is_named_if_it_is_missing(tmp_path: Path, use: str, line: int | None) -> None:
    file = tmp_path / "M.mo"
    file.write_text(f"model M\n  {use}\nend M;\n")
    request = BuildRequest("M", Path("unused"), file)
    if line is None:
        generate_model(request)
        return
    with pytest.raises(ModelNotFoundError, match="M needs the Modelica Standard Library; name its") as caught:
        generate_model(request)
    assert str(caught.value).startswith(f"{file}:{line}:")


def test_a_model_of_the_missing_standard_library() -> None:
    with pytest.raises(ModelNotFoundError, match=r"^Modelica\.Blocks\.Examples\.PID needs the Modelica St"):
        generate_model(BuildRequest("Modelica.Blocks.Examples.PID", Path("unused")))


def test_only_what_a_model_can_reach_is_handed_on(tmp_path: Path) -> None:
    """Lines and columns of the rest stay where they are."""
    user, gains = _library(tmp_path / "User", _USER), _gains(tmp_path / "Gains", 3)
    reached = reached_source("User.Decay", find_libraries("User.Decay", [user, gains]))
    assert set(reached.classes) == {
        *("User", "User.Decay", "User.Icons", "User.Icons.Package"),
        *("Gains", "Gains.Interfaces", "Gains.Interfaces.Base"),
    }
    text = reached.texts[gains / "package.mo"]
    full = _GAINS.format(factor=3)
    assert "Missing" not in text
    assert [line for line in text.splitlines() if line.strip()] == [
        line for number, line in enumerate(full.splitlines(), start=1) if not 3 <= number <= 5
    ]
    assert len(text) == len(full)
    assert text.index("partial model Base") == full.index("partial model Base")


def test_prefixes_and_constraining_clauses_go_with_their_class(tmp_path: Path) -> None:
    text = """package P
  encapsulated partial model Unused Real a; end Unused;
  replaceable model Law = Linear constrainedby Linear "text";
  final type Size = Real(unit = "m") annotation(Icon());
  model M Real x = time; end M;
  model Linear end Linear;
end P;
"""
    file = tmp_path / "P.mo"
    file.write_text(text)
    reached = reached_source("P.M", find_libraries("P.M", [file]))
    assert reached.texts[file].split() == [
        "package",
        "P",
        *["model", "M", "Real", "x", "=", "time;", "end", "M;"],
        "end",
        "P;",
    ]
