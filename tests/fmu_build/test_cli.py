"""``python -m fmu_build``: output streams, exit codes, and never a traceback."""

from __future__ import annotations

import errno
import io
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import Any, ClassVar

import pytest
from fmpy import read_model_description
from typer.testing import CliRunner

import fmu_build
from fmu_build import UnknownCompilerError, build_fmu, compilers
from fmu_build.__main__ import _run as program, app
from fmu_build.support.errors import ModelicaError
from fmu_build.support.request import BuildRequest, BuildResult, SensitivityRequest
from fmu_build.support.standard_output import lost_output

_JOYSTICK = "PreloadedSprings.Joystick.Joystick"


class _FakeCompiler:
    """Stands in for a compiler; `error` is what its build raises."""

    name = "rumoca"
    options: ClassVar[dict[str, str]] = {"color": "of the FMU"}
    computes_sensitivities = True

    def __init__(self, error: BaseException | None = None) -> None:
        self.error = error
        self.requests: list[BuildRequest] = []

    def version(self) -> str:
        return "1"

    def build(self, request: BuildRequest) -> BuildResult:
        self.requests.append(request)
        request.on_stage("thinking [hard]")
        if self.error is not None:
            raise self.error
        return BuildResult(request.output / "M.fmu", self.name, "1", "what the [compiler] said", 0.5)


def _use(monkeypatch: pytest.MonkeyPatch, error: BaseException | None = None) -> _FakeCompiler:
    compiler = _FakeCompiler(error)
    monkeypatch.setitem(compilers._COMPILERS, "rumoca", lambda: compiler)
    return compiler


def _run(*arguments: str) -> Any:
    return CliRunner(env={"COLUMNS": "200", "TERM": "dumb"}).invoke(app, arguments)


def test_paths_on_standard_output_and_the_rest_on_standard_error(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    compiler = _use(monkeypatch)
    result = _run("A.M", "B.M", "-o", str(tmp_path), "--platform", "linux64", "--library", "L.mo")
    assert result.exit_code == 0
    assert result.stdout == f"{tmp_path / 'M.fmu'}\n" * 2
    assert "A.M: thinking [hard]" in result.stderr
    assert "B.M: done in 0.5 s" in result.stderr
    assert "what the [compiler] said" not in result.stderr
    assert [(r.model, r.platforms, r.library) for r in compiler.requests] == [
        ("A.M", ("linux64",), Path("L.mo")),
        ("B.M", ("linux64",), Path("L.mo")),
    ]


def test_sensitivities_reach_the_compiler(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    compiler = _use(monkeypatch)
    assert _run("M", "-o", str(tmp_path), "--sensitivity", "x, a[1,2].y:all").exit_code == 0
    assert compiler.requests[0].sensitivity == SensitivityRequest(("x", "a[1,2].y"), ("all",))


@pytest.mark.parametrize("text", ["theta", "theta:", ":J", "theta,:J", ""])
def test_sensitivities_need_variables_and_parameters(text: str, tmp_path: Path) -> None:
    result = _run("M", "-o", str(tmp_path), "--sensitivity", text)
    assert result.exit_code == 2
    assert "use VARIABLES:PARAMETERS" in result.stderr


def test_a_compiler_without_sensitivities_is_refused(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    compiler = _use(monkeypatch)
    monkeypatch.setattr(_FakeCompiler, "computes_sensitivities", False)
    result = _run("M", "-o", str(tmp_path), "--sensitivity", "x:k")
    assert result.exit_code == 1
    assert "the compiler rumoca computes no sensitivities" in result.stderr
    assert not compiler.requests


def test_verbose_shows_the_log(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    _use(monkeypatch)
    assert "what the [compiler] said" in _run("M", "-o", str(tmp_path), "--verbose").stderr


def test_a_build_error_is_one_message(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    compiler = _use(monkeypatch, ModelicaError("M.mo:3:14: unexpected `2`"))
    result = _run("M", "N", "-o", str(tmp_path))
    assert result.exit_code == 1
    assert result.stdout == ""
    assert result.stderr.splitlines()[-1] == "error: M.mo:3:14: unexpected `2`"
    assert [r.model for r in compiler.requests] == ["M"]


def test_characters_that_standard_output_lacks_are_escaped() -> None:
    ended = subprocess.run(
        [sys.executable, "-m", "fmu_build", "--help"],
        env=os.environ | {"PYTHONIOENCODING": "ascii"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (ended.returncode, ended.stderr) == (0, "")


@pytest.mark.parametrize("number", [errno.EIO, errno.EFBIG])
def test_a_closed_terminal_and_a_limit_of_the_size_are_lost_output(number: int) -> None:
    assert "cannot write standard output" in lost_output(OSError(number, os.strerror(number)))


@pytest.mark.parametrize("arguments", [("M", "-o", "."), ("--help",), ("explore", "--help")])
@pytest.mark.parametrize("is_closed", [True, False])
def test_a_standard_output_that_takes_nothing_is_no_success(
    is_closed: bool,
    arguments: tuple[str, ...],
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    """It is closed, or open for reading only."""
    _use(monkeypatch)
    monkeypatch.setattr(sys, "argv", ["fmu_build", *arguments])
    with Path(os.devnull).open(encoding="utf-8") as unwritable:
        output = None if is_closed else io.TextIOWrapper(io.FileIO(unwritable.fileno(), "w", closefd=False))
        monkeypatch.setattr(sys, "stdout", output)
        assert program() == 1
        if output is not None:
            output.detach()
    last = capsys.readouterr().err.splitlines()[-1]
    reason = "standard output: it is closed" if is_closed else "standard output or a temporary file: Bad file"
    assert last.startswith(f"error: cannot write {reason}")


def test_an_unforeseen_error_is_one_message_too(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    _use(monkeypatch, ZeroDivisionError("[red]"))
    result = _run("M", "-o", str(tmp_path))
    assert result.exit_code == 1
    assert result.stderr.splitlines()[-1] == (
        "error: M: internal error: ZeroDivisionError: [red] (--verbose shows where)"
    )
    assert "Traceback" not in result.stderr
    assert "Traceback" in _run("M", "-o", str(tmp_path), "-v").stderr


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("M",), "Missing option '--output'"),
        (("-o", "out"), "Missing argument 'MODEL"),
        (("M", "-o", "out", "--compiler", "nocc"), "'nocc' is not one of rumoca"),
        (("M", "-o", "out", "--platform", "vax"), "unknown platform 'vax'"),
        (("M", "-o", "out", "--nonsense"), "No such option"),
        (("M", "-o", "out", "--option", "omc"), "'omc' is not of the form NAME=VALUE"),
        (("M", "-o", "out", "--fmi-type", "se"), "'se' is not one of"),
        (("M", "-o", "out", "--fmi", "1"), "'1' is not one of 2, 3"),
    ],
)
def test_wrong_usage(arguments: tuple[str, ...], message: str) -> None:
    result = _run(*arguments)
    assert result.exit_code == 2
    assert message in result.stderr
    assert result.stdout == ""


def test_what_only_the_compiler_has(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    compiler = _use(monkeypatch)
    settings = ("--option", "color=green=blue", "--fmi-version", "3.0", "--fmi-type", "me")
    assert _run("M", "-o", str(tmp_path), *settings).exit_code == 0
    assert compiler.requests[0].options == {"color": "green=blue"}
    assert compiler.requests[0].fmi_version == "3.0"
    assert compiler.requests[0].fmi_types == ("me",)
    refused = _run("M", "-o", str(tmp_path), "--option", "size=big")
    assert refused.exit_code == 1
    assert "the compiler rumoca has no option 'size'; it has color" in refused.stderr
    assert len(compiler.requests) == 1


@pytest.mark.parametrize(("name", "version"), [("2", "2.0"), ("2.0", "2.0"), ("3", "3.0")])
def test_versions_of_fmi(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, name: str, version: str) -> None:
    compiler = _use(monkeypatch)
    assert _run("M", "-o", str(tmp_path), "--fmi", name).exit_code == 0
    assert compiler.requests[0].fmi_version == version


def test_help_has_an_example() -> None:
    result = _run("--help")
    assert not re.search(r"<(?:bool|str|list\[)", result.stdout)
    assert result.exit_code == 0
    assert f"python -m fmu_build {_JOYSTICK} --output build/fmi2" in result.stdout
    for option in ("--output", "--compiler", "--library", "--platform", "--option", "--verbose"):
        assert option in result.stdout


def test_unknown_compiler_from_python(tmp_path: Path) -> None:
    with pytest.raises(UnknownCompilerError, match="unknown compiler 'nocc'; use rumoca or openmodelica"):
        build_fmu("M", tmp_path, compiler="nocc")


def test_what_python_hands_to_the_compiler(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    compiler = _use(monkeypatch)
    result = build_fmu("M", str(tmp_path), library="L.mo", fmi_types=["cs"])
    assert result.path == tmp_path / "M.fmu"
    assert compiler.requests[0].fmi_types == ("cs",)
    assert compiler.requests[0].library == Path("L.mo")


def _python_m(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    checkout = str(Path(fmu_build.__file__).parents[1])
    program = (
        f"import sys, runpy; sys.path.insert(0, {checkout!r}); runpy.run_module('fmu_build', alter_sys=True)"
    )
    program = program.replace("alter_sys=True", "run_name='__main__', alter_sys=True")
    command = [sys.executable, "-c", program, *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_the_joystick_from_the_command_line(tmp_path: Path) -> None:
    done = _python_m(_JOYSTICK, "--output", "new/folder", folder=tmp_path)
    assert (done.returncode, done.stdout) == (0, "new/folder/Joystick.fmu\n"), done.stderr
    for stage in (
        "compiling Modelica with rumoca",
        "(generating C|taking the C code from the cache)",
        "compiling the C code",
        "packing and checking",
    ):
        assert re.search(stage, done.stderr)
    description = read_model_description(str(tmp_path / "new" / "folder" / "Joystick.fmu"))
    assert description.modelName == _JOYSTICK
    assert list((tmp_path / "new" / "folder").iterdir()) == [tmp_path / "new" / "folder" / "Joystick.fmu"]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            ("PreloadedSprings.Joystick.Joystik", "-o", "out"),
            "did you mean PreloadedSprings.Joystick.Joystick",
        ),
        (("M", "-o", "out", "--library", "nowhere.mo"), "nowhere.mo does not exist"),
        (("M", "-o", "out", "--library", "M.mo"), "M.mo:2:12: unexpected"),
        (("M", "-o", "M.mo"), "M.mo is not a folder"),
    ],
)
def test_failures_of_the_real_command(tmp_path: Path, arguments: tuple[str, ...], message: str) -> None:
    (tmp_path / "M.mo").write_text("model M\n  Real x = ;\nend M;\n")
    done = _python_m(*arguments, folder=tmp_path)
    assert (done.returncode, done.stdout) == (1, "")
    assert message in done.stderr
    assert done.stderr.count("error:") == 1
    assert "Traceback" not in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["M.mo"]


@pytest.mark.skipif(sys.platform == "win32", reason="no such signal")
def test_sigterm_leaves_no_temporary_folder(tmp_path: Path) -> None:
    place = tmp_path / "temporary"
    place.mkdir()
    command = [sys.executable, "-m", "fmu_build", _JOYSTICK, "-o", str(tmp_path / "fmus")]
    environment = os.environ | {"TMPDIR": str(place)}
    with subprocess.Popen(command, env=environment, stderr=subprocess.PIPE, text=True) as process:
        try:
            while not list(place.glob("fmu_build-*")):
                assert process.poll() is None
                time.sleep(0.02)
            process.send_signal(signal.SIGTERM)
            _, said = process.communicate(timeout=120.0)
        finally:
            process.kill()
    assert process.returncode == 143, said
    assert list(place.glob("fmu_build-*")) == []
    assert "Traceback" not in said
