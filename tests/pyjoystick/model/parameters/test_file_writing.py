"""Writing parameter files: round trips, and what is preserved of an existing file."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import pytest

from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    PAPER,
    JoystickParameters,
    read_parameter_file,
    read_parameters,
    rounded,
    rounded_error,
    write_parameters,
)
from pyjoystick.support import OutputFileError, ParameterError, SettingsError, UnknownParameterError
from tests.pyjoystick.model.parameters.conftest import change


@pytest.mark.parametrize("joystick", [NOMINAL, NOMINAL_POWER_LAW])
def test_a_new_file(tmp_path: Path, joystick: JoystickParameters) -> None:
    path = tmp_path / "folder" / "mine.toml"
    write_parameters(path, joystick)
    found = read_parameter_file(path)
    assert (found.joystick, found.title) == (joystick, "mine")
    assert found.pivot_to_top == PAPER.pivot_to_top


def test_every_parameter_comes_back(tmp_path: Path) -> None:
    names = {name: value * (1.0 + 1e-3 / 3.0) for name, value in NOMINAL_POWER_LAW.to_names().items()}
    joystick = NOMINAL_POWER_LAW.replace(names)
    write_parameters(tmp_path / "joystick.toml", joystick)
    found = read_parameters(tmp_path / "joystick.toml").to_names()
    springs = [name for name in names if "Spring." in name]
    exact = [name for name in names if name not in springs]
    assert {name: found[name] for name in exact} == {name: names[name] for name in exact}
    # Springs go through x and k: F_0 is a difference of travels 9 um apart at 3 mm, hence 1e-16*3e-3/9e-6.
    assert [found[name] for name in springs] == pytest.approx([names[name] for name in springs], rel=1e-12)


def test_an_update_changes_what_changes_and_nothing_else(file: Path) -> None:
    change(
        file,
        ("m = 0.87 ", "u_m = 0.001\nm = 0.87 "),
        ("h = 0.082 ", "u_h = 0.0005 # ruler\nh = 0.082 "),
        ("# mass (kg)", "# mass (kg), the new handle"),
    )
    before = file.read_text(encoding="utf-8").splitlines()
    write_parameters(file, dataclasses.replace(NOMINAL, m=0.9))
    after = file.read_text(encoding="utf-8").splitlines()
    gone = [line for line in before if line not in after]
    new = [line for line in after if line not in before]
    source = 'source = "Rogers et al. (2004), Table 2"'
    assert gone == ["u_m = 0.001", "m = 0.87      # mass (kg), the new handle"]
    assert new == ["m = 0.9      # mass (kg), the new handle"]
    assert before.count(source) - after.count(source) == 1
    found = read_parameter_file(file)
    assert found.uncertainties == {"body.h": 0.0005}
    assert "body" not in found.sources
    assert "geometry" in found.sources


def test_writing_what_is_there_changes_nothing(file: Path) -> None:
    before = file.read_bytes()
    write_parameters(file, NOMINAL)
    assert file.read_bytes() == before


def test_uncertainties_and_sources(file: Path) -> None:
    uncertainties = {"body.J": 2e-5, **{f"backward.k[{i}]": 10.0 * i for i in range(4)}}
    write_parameters(
        file,
        NOMINAL.replace({"J": 0.012}),
        uncertainties=uncertainties,
        sources={"body": "swing test"},
        title="Mine",
        pivot_to_top=0.3,
    )
    found = read_parameter_file(file)
    assert found.uncertainties == uncertainties
    assert found.sources["body"] == "swing test"
    assert found.sources["backward"] == PAPER.sources["backward"]
    assert "geometry" not in found.sources
    assert (found.title, found.pivot_to_top) == ("Mine", 0.3)


def test_a_law_that_the_file_lacks_is_added_and_the_other_kept(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    file.write_text(text[: text.index("[damping.power-law]")], encoding="utf-8")
    write_parameters(file, NOMINAL_POWER_LAW)
    found = read_parameter_file(file)
    assert found.joystick == NOMINAL_POWER_LAW
    assert found.with_law("constant") == NOMINAL


@pytest.mark.parametrize(
    ("uncertainties", "error"),
    [
        ({"body.M": 1.0}, UnknownParameterError),
        ({"body.m[0]": 1.0}, UnknownParameterError),
        ({"forward.x": 1.0}, UnknownParameterError),
        ({"forward.x[4]": 1.0}, UnknownParameterError),
        ({"forward.x[0]": 1.0}, UnknownParameterError),
        ({"body.m": -1.0}, ParameterError),
    ],
)
def test_uncertainties_that_are_refused(
    file: Path, uncertainties: dict[str, float], error: type[Exception]
) -> None:
    before = file.read_bytes()
    with pytest.raises(error):
        write_parameters(file, NOMINAL, uncertainties=uncertainties)
    assert file.read_bytes() == before


def test_an_unknown_table_of_a_source(file: Path) -> None:
    with pytest.raises(UnknownParameterError, match="bodies"):
        write_parameters(file, NOMINAL, sources={"bodies": "scales"})


def test_a_broken_file_stays_as_it_is(file: Path, tmp_path: Path) -> None:
    change(file, ("m = 0.87 ", "m = -1 "))
    before = file.read_bytes()
    with pytest.raises(SettingsError, match=r"joystick.toml: \[body\] m = -1"):
        write_parameters(file, NOMINAL)
    assert file.read_bytes() == before
    assert list(tmp_path.iterdir()) == [file]


def test_what_could_not_be_read_again_is_not_written(file: Path, tmp_path: Path) -> None:
    before = file.read_bytes()
    with pytest.raises(SettingsError) as refused:
        write_parameters(file, dataclasses.replace(NOMINAL, a=2.9e-3, b=0.0))
    assert str(refused.value).startswith(f"{file}: [forward] x[2]")
    assert file.read_bytes() == before
    assert list(tmp_path.iterdir()) == [file]


def test_a_folder_in_the_way(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputFileError):
        write_parameters(tmp_path / "file" / "joystick.toml", NOMINAL)


@pytest.mark.parametrize(
    ("value", "error", "expected"),
    [
        (0.044988249, 1.66e-5, 0.0449882),
        (52.78081250000001, 0.031, 52.7808),
        (1234567.0, 5600.0, 1234570.0),
        (0.1 + 0.2, 0.0, 0.1 + 0.2),
        (0.1 + 0.2, math.inf, 0.1 + 0.2),
    ],
)
def test_a_value_keeps_a_hundredth_of_its_error(value: float, error: float, expected: float) -> None:
    assert rounded(value, error) == expected


def test_an_error_has_two_digits() -> None:
    assert rounded_error(1.66e-5) == 1.7e-5
