"""The cache of generated models: what later builds reuse, and what they do not."""

from __future__ import annotations

from pathlib import Path

import pytest

import fmu_build.codegen
from fmu_build.codegen import generate
from fmu_build.compilers import generated_once
from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.cache import Store
from fmu_build.support.request import BuildRequest, SensitivityRequest

MODEL = """model M
  parameter Real k = 2;
  Real x(start = 1, fixed = true);
  output Real y = x;
equation
  der(x) = -k*x;
end M;
model N
  extends M;
end N;
"""


@pytest.fixture(autouse=True)
def stored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An empty cache."""
    monkeypatch.setattr(Store, "folder", lambda store: tmp_path / "cache" / store.name)
    return tmp_path / "cache" / "models"


@pytest.fixture
def generated(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The models that the code generator has generated, to which it adds."""
    names: list[str] = []

    def counting(source: object, sensitivity: object) -> object:
        names.append("")
        made = generate(source, sensitivity)  # type: ignore[arg-type]
        names[-1] = made.description.model_name
        return made

    monkeypatch.setattr(fmu_build.codegen, "generate", counting)
    return names


def _written(folder: Path, text: str = MODEL) -> Path:
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "M.mo").write_text(text)
    return folder / "M.mo"


def _model(file: Path, name: str = "M", sensitivity: str | None = None) -> tuple[str, str]:
    wanted = None if sensitivity is None else SensitivityRequest.parse(sensitivity)
    made, log = generate_model(BuildRequest(name, file.parent, file, sensitivity=wanted))
    return made.c_source, log


def test_the_second_build_takes_the_same_model(tmp_path: Path, generated: list[str]) -> None:
    first = _model(_written(tmp_path / "one" / "lib"))
    assert _model(_written(tmp_path / "other" / "lib")) == first
    assert generated == ["M"]


def test_the_stages_say_so(tmp_path: Path) -> None:
    stages: list[str] = []
    file = _written(tmp_path)
    for _ in range(2):
        generate_model(BuildRequest("M", tmp_path, file, on_stage=stages.append))
    assert stages == ["generating C", "taking the C code from the cache"]


def test_whatever_the_model_is_made_from_makes_another(
    tmp_path: Path, generated: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    library = tmp_path / "lib"
    first = _model(_written(library))
    assert _model(_written(library, MODEL.replace("= 2", "= 3"))) != first
    assert _model(_written(library), "N") != first
    assert _model(_written(library), sensitivity="x:k") != first
    (library / "Beside.mo").write_text("model Beside Real x = 1; end Beside;")
    _model(_written(library))
    monkeypatch.setattr(generated_once, "_generator", lambda: ("0.10.3", "digest"))
    _model(_written(library))
    assert generated == ["M", "M", "N", "M", "M", "M"]


def test_errors_are_found_again(tmp_path: Path, generated: list[str]) -> None:
    file = _written(tmp_path, MODEL.replace("-k*x", "delay(x, 0.1)"))
    messages = []
    for _ in range(2):
        with pytest.raises(Exception, match="delay") as caught:
            _model(file)
        messages.append(str(caught.value))
    assert messages[0] == messages[1]
    assert generated == ["", ""]


def test_a_damaged_file_is_generated_anew(tmp_path: Path, stored: Path, generated: list[str]) -> None:
    file = _written(tmp_path)
    first = _model(file)
    (kept,) = stored.iterdir()
    kept.write_bytes(kept.read_bytes()[:-1] + b"?")
    assert _model(file) == first
    assert generated == ["M", "M"]


def test_a_log_that_names_a_file_is_not_kept(tmp_path: Path, stored: Path) -> None:
    file = _written(tmp_path)
    made, _ = generate_model(BuildRequest("M", tmp_path, file))
    texts = {file: "another text"}
    for log in (f"{file}:1:1: a remark", "a remark"):
        found = generated_once.generated_once(texts, "M", None, lambda log=log: (made, log), print)  # type: ignore[misc]
        assert found == (made, log)
    assert len(list(stored.iterdir())) == 2
