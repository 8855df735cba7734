"""Builds with a real OpenModelica: ending sessions, odd paths, user libraries, and failures."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path

import fmpy
import psutil
import pytest

from fmu_build import build_fmu
from fmu_build.compilers.openmodelica.connection import connected
from fmu_build.compilers.openmodelica.finding import find_omc, omc_version
from fmu_build.compilers.openmodelica.process import running
from fmu_build.compilers.openmodelica.sessions import ROOT_NOTE
from fmu_build.support.errors import (
    BuildError,
    ModelicaError,
    ModelNotFoundError,
    ToolchainError,
    UnsupportedModelError,
)
from tests.omc import why_not

pytestmark = pytest.mark.skipif(bool(why_not()), reason=why_not())

ROOT = hasattr(os, "geteuid") and os.geteuid() == 0
GOOD = "model Good\n  Real x(start = 1, fixed = true);\nequation\n  der(x) = -x;\nend Good;\n"


def _build(file: Path, text: str, folder: Path, model: str = "", **settings: object) -> Path:
    file.write_text(text, encoding="utf-8")
    return build_fmu(
        model or file.stem,
        folder,
        library=file,
        compiler="openmodelica",
        **settings,  # type: ignore[arg-type]
    ).path


@pytest.fixture(autouse=True)
def no_omc_is_left() -> Iterator[None]:
    """No test leaves an omc behind that was not there before."""
    before = set(_omcs())
    yield
    assert set(_omcs()) <= before


def _omcs() -> list[int]:
    children = psutil.Process().children(recursive=True)
    return [
        child.pid for child in children if child.status() != psutil.STATUS_ZOMBIE and "omc" in child.name()
    ]


def test_what_is_told_on_the_way(tmp_path: Path) -> None:
    stages: list[str] = []
    (tmp_path / "Good.mo").write_text(GOOD)
    result = build_fmu(
        "Good", tmp_path, library=tmp_path / "Good.mo", compiler="openmodelica", on_stage=stages.append
    )
    assert stages[0] == "starting OpenModelica"
    assert stages[-2:] == ["compiling Modelica and C with OpenModelica", "checking the FMU"]
    assert (ROOT_NOTE in stages) == ROOT
    assert (ROOT_NOTE in result.log) == ROOT
    assert ("in its script form" in result.log.splitlines()[0]) == ROOT


def test_from_the_command_line(tmp_path: Path) -> None:
    (tmp_path / "Good.mo").write_text(GOOD)
    command = [sys.executable, "-m", "fmu_build", "Good", "--library", str(tmp_path / "Good.mo")]
    command += ["--output", str(tmp_path / "out"), "--compiler", "openmodelica"]
    command += ["--option", f"omc={find_omc(None)}", "--fmi-type", "me", "--verbose"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, f"{tmp_path / 'out' / 'Good.fmu'}\n"), done.stderr
    assert "OpenModelica " in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("as_package", [False, True])
def test_a_library_of_the_users_own_on_preloaded_springs(tmp_path: Path, as_package: bool) -> None:
    """It need not say where that is; the folder's name has a blank and a letter beyond ASCII."""
    folder = tmp_path / "Meine Bibliothek ä" / "Own"
    folder.mkdir(parents=True)
    text = "model Stiff\n  extends PreloadedSprings.Joystick.Joystick(J = 0.5);\nend Stiff;\n"
    if as_package:
        (folder / "package.mo").write_text("package Own\nend Own;\n")
        (folder / "Stiff.mo").write_text(f"within Own;\n{text}")
        library, model = folder, "Own.Stiff"
    else:
        library, model = folder / "Stiff.mo", "Stiff"
        library.write_text(text)
    result = build_fmu(model, tmp_path / "out", library=library, compiler="openmodelica")
    variables = fmpy.read_model_description(str(result.path)).modelVariables
    assert [variable.start for variable in variables if variable.name == "J"] == ["0.5"]


def test_a_file_that_uses_its_neighbor(tmp_path: Path) -> None:
    (tmp_path / "Good.mo").write_text(GOOD)
    path = _build(tmp_path / "User.mo", "model User\n  extends Good(x(start = 3));\nend User;\n", tmp_path)
    variables = fmpy.read_model_description(str(path)).modelVariables
    assert [variable.start for variable in variables if variable.name == "x"] == ["3.0"]


ERRORS = {
    "syntax": ("model M\n  Real x = 3 2;\nend M;\n", ModelicaError, ":2:14: "),
    "unknown variable": (
        "model M\n  Real x = missing;\nend M;\n",
        ModelicaError,
        ":2:3: .*missing not found",
    ),
    "unknown class": ("model M\n  No.Such x;\nend M;\n", ModelicaError, ":2:3: .*No.Such not found"),
    "wrong type": ('model M\n  Real x = "a";\nend M;\n', ModelicaError, ":2:3: Type mismatch"),
    "too few equations": ("model M\n  Real x;\nend M;\n", ModelicaError, "Too few equations"),
    "too many equations": (
        "model M\n  Real x;\nequation\n  x = 1;\n  x = 2;\nend M;\n",
        ModelicaError,
        "Too many equations",
    ),
    "no C function": (
        'function f\n  input Real x;\n  output Real y;\n  external "C" y = no_such_function(x);\nend f;\n'
        "model M\n  Real x = f(time);\nend M;\n",
        ToolchainError,
        "no_such_function",
    ),
}


@pytest.mark.parametrize("name", ERRORS)
def test_errors_in_the_source(tmp_path: Path, name: str) -> None:
    text, kind, message = ERRORS[name]
    folder = tmp_path / "out"
    folder.mkdir()
    (folder / "M.fmu").write_bytes(b"old")
    with pytest.raises(BuildError, match=message) as caught:
        _build(tmp_path / "M.mo", text, folder, model="M")
    assert type(caught.value) is kind
    if kind is ModelicaError:
        assert str(caught.value).startswith(str(tmp_path / "M.mo"))
    assert [(path.name, path.read_bytes()) for path in folder.iterdir()] == [("M.fmu", b"old")]


def test_a_class_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(ModelNotFoundError, match=r"no model 'Goood' in .*did you mean Good\?"):
        _build(tmp_path / "Good.mo", GOOD, tmp_path / "out", model="Goood")
    with pytest.raises(ModelNotFoundError, match=r"(?s)no model 'N' in .*\n.*M\.mo:\d+:\d+: error: "):
        _build(tmp_path / "M.mo", "model M\nend B;\nmodel N\nend N;\n", tmp_path / "out", model="N")
    assert not (tmp_path / "out").exists()


def test_no_c_compiler(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("CC", "no-such-compiler")
    with pytest.raises(ToolchainError, match="no-such-compiler"):
        _build(tmp_path / "Good.mo", GOOD, tmp_path / "out")


def test_fmi_3_where_omc_has_it(tmp_path: Path) -> None:
    """A later version makes such an FMU; an earlier one says that it cannot."""
    refusal = None
    try:
        _build(tmp_path / "Good.mo", GOOD, tmp_path / "out", fmi_version="3.0")
    except UnsupportedModelError as error:
        refusal = str(error)
    if refusal is None:
        path = tmp_path / "out" / "Good.fmu"
        assert fmpy.read_model_description(str(path)).fmiVersion == "3.0"
    else:
        assert "version 3.0" in refusal
        assert not (tmp_path / "out").exists()
    older = tuple(int(number) for number in omc_version(find_omc(None)).split(".")[:2]) < (1, 27)
    assert not (older and refusal is None)


def test_out_of_time(tmp_path: Path) -> None:
    with pytest.raises(ToolchainError, match="option timeout"):
        _build(tmp_path / "Good.mo", GOOD, tmp_path / "out", options={"timeout": "0.01"})


def test_interrupted(tmp_path: Path) -> None:
    def interrupt(stage: str) -> None:
        if stage.startswith("compiling"):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        _build(tmp_path / "Good.mo", GOOD, tmp_path / "out", on_stage=interrupt)
    assert not (tmp_path / "out").exists()


def test_omc_dies(tmp_path: Path) -> None:
    """It is noticed while its answer is waited for."""
    others = set(_omcs())

    def kill_soon(stage: str) -> None:
        if stage.startswith("compiling"):
            threading.Thread(target=_kill_the_next_omc, args=(others,)).start()

    with pytest.raises(ToolchainError, match=r"omc ended suddenly|omc ended with exit code"):
        _build(tmp_path / "Good.mo", GOOD, tmp_path / "out", on_stage=kill_soon)


def _kill_the_next_omc(others: set[int]) -> None:
    while not (found := set(_omcs()) - others):
        time.sleep(0.01)
    time.sleep(0.3)
    psutil.Process(found.pop()).kill()


@pytest.mark.parametrize("fault", [None, "syntax"])
def test_no_temporary_file_is_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, fault: str | None
) -> None:
    folder = tmp_path / "temporary"
    folder.mkdir()
    monkeypatch.setattr("tempfile.tempdir", str(folder))
    if fault is None:
        _build(tmp_path / "Good.mo", GOOD, tmp_path / "out")
    else:
        with pytest.raises(ModelicaError):
            _build(tmp_path / "M.mo", ERRORS[fault][0], tmp_path / "out")
    assert list(folder.iterdir()) == []


@pytest.fixture
def server(tmp_path: Path) -> Iterator[Path]:
    """The port file of a server that runs already, in a folder of its own."""
    if ROOT:
        pytest.skip("omc refuses to serve the root user")
    folder = tmp_path / "server"
    folder.mkdir()
    environment = {**os.environ, "TMPDIR": str(folder)}
    command = [str(find_omc(None)), "--interactive=zmq", "-z=test"]
    with running(command, folder=folder, log=folder / "log", environment=environment) as process:
        while not (files := [file for file in folder.glob("*port*") if file.stat().st_size]):
            assert process.poll() is None, (folder / "log").read_text()
        yield files[0]
        assert process.poll() is None, "the server has been ended"


def test_a_server_that_runs_already_is_left_as_it_was(tmp_path: Path, server: Path) -> None:
    address = server.read_text()
    questions = ["cd()", "getClassNames()", "getCommandLineOptions()"]
    with connected(address, 60.0) as connection:
        connection.run(['loadString("model Mine end Mine;")'])
        before = connection.run(questions)
    path = _build(tmp_path / "Good.mo", GOOD, tmp_path / "out", options={"port-file": str(server)})
    assert path.is_file()
    with connected(address, 60.0) as connection:
        after = connection.run(questions)
    assert [answer.value for answer in after] == [answer.value for answer in before]
    assert before[1].value == "{Mine}"


def test_a_server_that_cannot_enter_the_folder_builds_nothing(
    tmp_path: Path, server: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("fmu_build.compilers.openmodelica.shared.quoted", lambda text: '"/nowhere"')
    before = sorted(server.parent.iterdir())
    with pytest.raises(ToolchainError, match="the server cannot work in"):
        _build(tmp_path / "Good.mo", GOOD, tmp_path / "out", options={"port-file": str(server)})
    assert sorted(server.parent.iterdir()) == before


def test_a_class_that_the_server_has_from_elsewhere_is_not_replaced(tmp_path: Path, server: Path) -> None:
    with connected(server.read_text(), 60.0) as connection:
        connection.run(['loadString("model Good end Good;")'])
    with pytest.raises(ToolchainError, match="the server already has a class Good"):
        _build(tmp_path / "Good.mo", GOOD, tmp_path / "out", options={"port-file": str(server)})
