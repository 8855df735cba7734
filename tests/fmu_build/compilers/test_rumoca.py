"""The rumoca backend: loading from files and folders, and errors with source positions."""

from __future__ import annotations

import gc
import os
import sys
import threading
from importlib import metadata
from pathlib import Path
from typing import Any

import pytest

from fmu_build.compilers import rumoca as backend
from fmu_build.compilers.rumoca import RumocaCompiler, generate_model
from fmu_build.compilers.rumoca_errors import native_stderr
from fmu_build.support.cache import Store
from fmu_build.support.errors import (
    BuildError,
    ModelicaError,
    ModelNotFoundError,
    ToolchainError,
    UnsupportedModelError,
)
from fmu_build.support.request import BuildRequest


@pytest.fixture(autouse=True)
def _nothing_is_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Store, "folder", lambda _: None)


@pytest.fixture
def library(tmp_path: Path) -> Path:
    """A package folder with a good model and a syntax error in another file."""
    folder = tmp_path / "Lib"
    folder.mkdir()
    (folder / "package.mo").write_text("package Lib\nend Lib;\n")
    (folder / "Good.mo").write_text(
        "within Lib;\n" + _model("Good", "Real x(start = 1, fixed = true);", "der(x) = -x;")
    )
    (folder / "Broken.mo").write_text("within Lib;\nmodel Broken\n  Real x = 3 2;\nend Broken;\n")
    return folder


def _model(name: str, declarations: str, equations: str) -> str:
    return f"model {name}\n  {declarations}\nequation\n  {equations}\nend {name};\n"


def _generate(model: str, library: Path | None) -> Any:
    return generate_model(BuildRequest(model, Path("unused"), library))


def _fails(tmp_path: Path, declarations: str, equations: str, error: type[BuildError], message: str) -> None:
    file = tmp_path / "M.mo"
    file.write_text(_model("M", declarations, equations))
    with pytest.raises(error, match=message) as caught:
        _generate("M", file)
    assert str(file) in str(caught.value)


def test_a_class_of_a_package_beside_a_broken_one(library: Path) -> None:
    generated, printed = _generate("Lib.Good", library)
    assert generated.description.model_name == "Lib.Good"
    assert "x" in [v.name for v in generated.description.variables]
    assert printed == ""


def test_a_class_of_a_file_that_uses_its_neighbour(library: Path) -> None:
    file = library.parent / "User.mo"
    file.write_text("model User\n  extends Other;\nend User;\n")
    (library.parent / "Other.mo").write_text(
        _model("Other", "Real x(start = 2, fixed = true);", "der(x) = 1;")
    )
    generated, _ = _generate("User", file)
    assert [v.start for v in generated.description.variables if v.name == "x"] == [2.0]


def test_copies_beside_a_file_are_not_read(tmp_path: Path) -> None:
    """An older version of the model, and one of what it uses."""
    part, user = (
        _model("Part", "Real x(start = {}, fixed = true);", "der(x) = 1;"),
        "model User\n  extends Part;\nend User;\n",
    )
    (tmp_path / "Part.mo").write_text(part.format(2))
    (tmp_path / "Part copy.mo").write_text(part.format(3))
    (tmp_path / "User_old.mo").write_text(user.replace("Part", "Part(x(start = 4))"))
    (tmp_path / "User.mo").write_text(user)
    generated, _ = _generate("User", tmp_path / "User.mo")
    assert [v.start for v in generated.description.variables if v.name == "x"] == [2.0]


@pytest.mark.parametrize("as_package", [False, True])
def test_a_library_of_the_users_own_on_preloaded_springs(tmp_path: Path, as_package: bool) -> None:
    file = tmp_path / "Stiff.mo"
    text = "model Stiff\n  extends PreloadedSprings.Joystick.Joystick(J = 0.5);\nend Stiff;\n"
    if as_package:
        (tmp_path / "package.mo").write_text("package Own\nend Own;\n")
        text = "within Own;\n" + text
    file.write_text(text)
    name, library = ("Own.Stiff", tmp_path) if as_package else ("Stiff", file)
    generated, _ = _generate(name, library)
    assert [v.start for v in generated.description.variables if v.name == "J"] == [0.5]


def test_a_syntax_error_that_hides_the_class_is_told(tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text("model A\nend B;\nmodel M\nend M;\n")
    with pytest.raises(ModelNotFoundError, match=r"(?s)no model 'M' in .*\n.*M\.mo:\d+:\d+: "):
        _generate("M", file)


def test_a_syntax_error_before_the_class(tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_text('model A "never closed\nend A;\nmodel M\nend M;\n')
    with pytest.raises(ModelicaError, match=r"^.*M\.mo:\d+:\d+: unexpected"):
        _generate("M", file)


def test_no_such_class(library: Path) -> None:
    with pytest.raises(ModelNotFoundError, match=r"no model 'Lib\.God' in .*did you mean Lib\.Good\?"):
        _generate("Lib.God", library)


@pytest.mark.parametrize("kind", ["package", "partial model", "record", "function"])
def test_a_class_that_is_no_model(tmp_path: Path, kind: str) -> None:
    file = tmp_path / "M.mo"
    file.write_text(f"{kind} M\nend M;\n")
    with pytest.raises(ModelNotFoundError, match=f"M in .* is a {kind}; only complete models"):
        _generate("M", file)


def test_syntax_error_with_place_and_line(library: Path) -> None:
    with pytest.raises(ModelicaError) as caught:
        _generate("Lib.Broken", library)
    first, *snippet = str(caught.value).splitlines()
    assert first == f"{library / 'Broken.mo'}:3:14: unexpected `2`"
    assert any("Real x = 3 2;" in line for line in snippet)
    assert str(caught.value).count("unexpected") == 2  # message and mark; what follows from it is left out


def test_unknown_name_with_place(tmp_path: Path) -> None:
    _fails(tmp_path, "Real x = missing;", "", ModelicaError, r"M\.mo:2:12: unresolved .*'missing'")


def test_a_name_that_occurs_twice_has_no_certain_place(tmp_path: Path) -> None:
    _fails(
        tmp_path, "Real x = missing; Real y = missing;", "", ModelicaError, r"M\.mo: unresolved .*'missing'"
    )


def test_type_errors_with_place(tmp_path: Path) -> None:
    declarations = "parameter Boolean b = 3.5;\n  Real x(start = true);"
    _fails(
        tmp_path, declarations, "der(x) = 1;", ModelicaError, r"(?m)^.*M\.mo:2:25: type mismatch: .*Boolean"
    )
    _fails(tmp_path, declarations, "der(x) = 1;", ModelicaError, r"(?m)^.*M\.mo:3:18: .*`start`")


def test_unbalanced_model(tmp_path: Path) -> None:
    _fails(tmp_path, "Real x;", "x = 1; x = 2;", ModelicaError, "unbalanced model: 2 equations, 1 unknown")


def test_a_panic_of_the_compiler_is_an_error(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    _fails(
        tmp_path,
        "input Real u; Real y;",
        "der(u) = y;",
        UnsupportedModelError,
        r"M\.mo:4:3: der\(u\): the derivative of an input",
    )
    assert capfd.readouterr().err == ""


def test_a_panic_without_an_explanation(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """The compiler ends at the start values of arrays in arrays of components that are given again."""
    file = tmp_path / "M.mo"
    file.write_text("""
      model B parameter Integer n = 1; Real x[n](each start = 1, each fixed = true);
      equation der(x) = zeros(n); end B;
      model C parameter Integer m = 2; B b[m](each n = 3, x(start = {{1, 2, 3}, {4, 5, 0}})); end C;
      model M C d(m = 1, b(x(start = {{1, 1, 1}}))); end M;
    """)
    with pytest.raises(UnsupportedModelError, match=r"M\.mo: the compiler ends at this model"):
        _generate("M", file)
    assert capfd.readouterr().err == ""


def test_a_file_that_is_not_text(tmp_path: Path) -> None:
    file = tmp_path / "M.mo"
    file.write_bytes(b'model M "\xff"\nend M;\n')
    with pytest.raises(ModelicaError, match=r"M\.mo: .*UTF-8"):
        _generate("M", file)
    with pytest.raises(ModelNotFoundError, match=r"(?s)no model 'N'.*M\.mo: .*UTF-8"):
        _generate("N", file)


def test_an_interruption_passes(library: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*arguments: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(backend, "_loaded", interrupted)
    with pytest.raises(KeyboardInterrupt):
        _generate("Lib.Good", library)


def test_an_error_of_the_code_generator_passes_unchanged(
    library: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    original = UnsupportedModelError("Good.mo:3: delay()")

    def refusing(*arguments: object) -> None:
        raise original

    monkeypatch.setattr(backend, "_loaded", refusing)
    with pytest.raises(UnsupportedModelError) as caught:
        _generate("Lib.Good", library)
    assert caught.value is original


def test_rumoca_is_not_installed(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def missing(name: str) -> str:
        raise metadata.PackageNotFoundError(name)

    monkeypatch.setattr(metadata, "version", missing)
    with pytest.raises(ToolchainError, match=r"pip install 'pyjoystick\[build\]'"):
        RumocaCompiler().build(BuildRequest("M", tmp_path))


def test_output_that_is_a_file_is_refused_first(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    stages: list[str] = []
    with pytest.raises(BuildError, match="file is not a folder"):
        RumocaCompiler().build(BuildRequest("M", tmp_path / "file", on_stage=stages.append))
    assert stages == []


def test_native_standard_error_is_kept_apart(capfd: pytest.CaptureFixture[str]) -> None:
    with native_stderr() as printed:
        os.write(2, b"from below\n")
    sys.stderr.write("after\n")
    sys.stderr.flush()
    assert printed() == "from below\n"
    assert capfd.readouterr().err == "after\n"


def test_an_error_that_is_kept_holds_no_session(tmp_path: Path) -> None:
    """Sessions of rumoca must be freed by their own thread; the garbage collector runs in any."""
    library = tmp_path / "M.mo"
    library.write_text("model M Real x; equation der(x) = unknown(x); end M;")
    complaints: list[str] = []

    def fail() -> None:
        with pytest.raises(BuildError) as kept:  # a cycle: the frame, what it caught, the frame
            generate_model(BuildRequest("M", tmp_path, library))
        assert "unknown" in str(kept.value)

    previous = sys.unraisablehook
    sys.unraisablehook = lambda unraisable: complaints.append(str(unraisable.exc_value))
    gc.disable()
    try:
        fail()
        collector = threading.Thread(target=gc.collect)
        collector.start()
        collector.join()
    finally:
        gc.enable()
        sys.unraisablehook = previous
    assert complaints == []
