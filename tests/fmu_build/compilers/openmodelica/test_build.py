"""The statements of a build, and requests refused before a build."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build.compilers.openmodelica import OpenModelicaCompiler
from fmu_build.compilers.openmodelica.build import read_attempt, statements
from fmu_build.compilers.openmodelica.messages import Answer, read_messages
from fmu_build.support.errors import BuildError, ModelNotFoundError, ToolchainError
from fmu_build.support.request import BuildRequest, FmiType
from tests.fmu_build.compilers.openmodelica import recorded

JOYSTICK = "PreloadedSprings.Joystick.Joystick"


def _request(*types: FmiType, version: str = "2.0") -> BuildRequest:
    return BuildRequest(JOYSTICK, Path("out"), fmi_types=types, fmi_version=version)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("types", "fmu_type"),
    [(("me",), "me"), (("cs",), "cs"), (("me", "cs"), "me_cs"), (("cs", "me"), "me_cs")],
)
def test_the_call(types: tuple[FmiType, ...], fmu_type: str) -> None:
    asked = statements(_request(*types), [Path("/lib/package.mo")], Path("/build"), "cvode")
    assert list(asked.values()) == [
        "getVersion()",
        'cd("/build")',
        *(['setCommandLineOptions("--fmiFlags=s:cvode")'] if "cs" in types else []),
        'loadFile("/lib/package.mo")',
        f'buildModelFMU({JOYSTICK}, version="2.0", fmuType="{fmu_type}", fileNamePrefix="Joystick", '
        'platforms={"static"})',
    ]


def test_names_that_need_care() -> None:
    files = [Path('/a "b"/Ü.mo'), Path("/c")]
    request = BuildRequest("P.'a b'", Path("out"), fmi_version="3.0")
    asked = list(statements(request, files, Path("/build dir"), "euler").values())
    assert asked[1:5] == [
        'cd("/build dir")',
        'setCommandLineOptions("--fmiFlags=s:euler")',
        'loadFile("/a \\"b\\"/Ü.mo")',
        'loadFile("/c")',
    ]
    assert "buildModelFMU(P.'a b', version=\"3.0\"" in asked[5]
    assert 'fileNamePrefix="_a_b_"' in asked[5]


def test_a_solver_that_is_not_offered_is_no_failure() -> None:
    answers = {
        "version": Answer('"OMCompiler v1.14.2"', ()),
        "solver": Answer("false", read_messages(recorded.UNKNOWN_OPTION)),
        "load x": Answer("true", ()),
        "build": Answer('"/build/Joystick.fmu"', read_messages(recorded.WARNINGS)),
    }
    attempt = read_attempt(answers)
    assert (attempt.version, attempt.solver_offered) == ("1.14.2", False)
    assert attempt.load_errors == ()
    assert [message.level for message in attempt.messages] == ["warning", "warning"]


def test_answers_that_are_missing() -> None:
    attempt = read_attempt({"version": Answer("", read_messages(recorded.ROOT_REFUSAL))})
    assert attempt.version == ""
    assert "root user" in attempt.messages[0].text


@pytest.mark.parametrize(
    ("request_", "message"),
    [
        (BuildRequest("M", Path("o"), fmi_version="1.0"), "unknown FMI version '1.0'; use '2.0' or '3.0'"),  # type: ignore[arg-type]
        (BuildRequest("M", Path("o"), fmi_types=()), r"FMI types \[\]: use 'me', 'cs' or both"),
        (
            BuildRequest("M", Path("o"), platforms=("win64",)),
            "for this machine .*, not for x86_64-windows",
        ),
        (BuildRequest("M", Path(__file__)), "is not a folder"),
    ],
)
def test_refused_at_once(request_: BuildRequest, message: str) -> None:
    with pytest.raises(BuildError, match=message):
        OpenModelicaCompiler().build(request_)


@pytest.mark.parametrize("model", ["", "A.", "1A", 'A); system("true"', "A B", "A.'x", "Ä"])
def test_what_is_no_class_name_never_reaches_omc(model: str, tmp_path: Path) -> None:
    with pytest.raises(ModelNotFoundError, match="there is no model"):
        OpenModelicaCompiler().build(BuildRequest(model, tmp_path))


def test_a_library_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(ModelNotFoundError, match="does not exist"):
        OpenModelicaCompiler().build(BuildRequest("M", tmp_path, library=tmp_path / "L.mo"))


def test_no_omc(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.delenv("OPENMODELICAHOME", raising=False)
    monkeypatch.setenv("PATH", str(tmp_path))
    stages: list[str] = []
    with pytest.raises(ToolchainError, match=r"openmodelica\.org"):
        OpenModelicaCompiler().build(BuildRequest(JOYSTICK, tmp_path / "out", on_stage=stages.append))
    with pytest.raises(ToolchainError, match="not found"):
        OpenModelicaCompiler().version()
    assert stages == ["starting OpenModelica"]
    assert not (tmp_path / "out").exists()
