"""The library in OpenModelica: every model is checked, every example simulated with its own settings."""

from __future__ import annotations

import re

import pytest

from tests.modelica.library import ROOT, concrete_models, examples, library_classes
from tests.omc import Omc, error_texts

_BALANCE = re.compile(r"has (\d+) equation\(s\) and (\d+) variable\(s\)")


@pytest.fixture(scope="module")
def loaded(omc: Omc) -> Omc:
    """The session; the library itself loads without a message."""
    (answer,) = omc.ask(*omc.load(ROOT / "package.mo"))
    assert answer.succeeded
    assert answer.messages == ()
    return omc


def test_every_model_is_checked_without_a_message(loaded: Omc) -> None:
    models = concrete_models()
    assert len(models) >= 25
    answers = loaded.ask(*loaded.load(ROOT / "package.mo"), *(f"checkModel({name})" for name in models))
    for name, answer in zip(models, answers[1:], strict=True):
        assert answer.messages == (), name
        balance = _BALANCE.search(answer.text)
        assert balance, f"{name}: {answer.text}"
        assert balance[1] == balance[2], f"{name}: {answer.text}"


def test_partial_models_connectors_and_types_are_checked_without_an_error(loaded: Omc) -> None:
    others = [c for c in library_classes() if c.kind != "package" and c.qualified not in concrete_models()]
    assert len(others) >= 40
    answers = loaded.ask(*loaded.load(ROOT / "package.mo"), *(f"checkModel({c.qualified})" for c in others))
    for found, answer in zip(others, answers[1:], strict=True):
        assert "completed successfully" in answer.text, found.qualified
        assert error_texts([answer]) == []


def test_a_model_with_an_error_would_be_found(omc: Omc) -> None:
    """The checks above can fail."""
    source = omc.folder / "Faulty.mo"
    source.write_text(
        "model Faulty\n  PreloadedSprings.Parts.Fixed wall;\n  Real x = wall.flange.phi;\nend Faulty;\n"
    )
    answers = omc.ask(*omc.load(ROOT / "package.mo", source), "checkModel(Faulty)")
    assert "completed successfully" not in answers[-1].text
    assert any(f"{source}:3:" in text for text in error_texts(answers))


@pytest.mark.parametrize("name", examples())
def test_examples_run_with_their_own_settings(omc: Omc, name: str) -> None:
    result = omc.folder / f"{name}_res.mat"
    result.unlink(missing_ok=True)
    answers = omc.ask(*omc.load(ROOT / "package.mo"), f"simulate({name})")
    assert "The simulation finished successfully." in answers[-1].value
    assert "warning" not in answers[-1].value
    assert error_texts(answers) == []
    assert result.is_file()
