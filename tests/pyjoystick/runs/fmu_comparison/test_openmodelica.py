"""Comparison of the two compilers' FMUs, if OpenModelica is installed."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import build_fmu
from pyjoystick.fmu import read_description
from pyjoystick.runs import Experiment, compare_fmus, experiments_for
from tests.omc import JOYSTICKS, why_not

pytestmark = pytest.mark.skipif(bool(why_not()), reason=why_not())


@pytest.fixture(scope="module")
def others(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder with OpenModelica's FMUs."""
    folder = tmp_path_factory.mktemp("openmodelica")
    for model in JOYSTICKS.values():
        build_fmu(model, folder, compiler="openmodelica")
    return folder


@pytest.mark.parametrize("name", ["Joystick", "JoystickPowerLaw"])
def test_by_model_exchange_they_are_the_same_joystick(name: str, others: Path, joystick_fmus: Path) -> None:
    comparison = compare_fmus(joystick_fmus / f"{name}.fmu", others / f"{name}.fmu")
    assert comparison.within_limits
    exchange = [run for run in comparison.runs if run.interface == "ModelExchange"]
    assert [run.experiment for run in exchange] == ["-20 deg", "-10 deg", "5 deg", "15 deg", "T of 2 N.m"]
    for run in exchange:
        assert len(run.judged) == 10
        assert not run.failures


def test_they_declare_the_same_interface(others: Path, joystick_fmus: Path) -> None:
    for name in JOYSTICKS:
        comparison = compare_fmus(joystick_fmus / f"{name}.fmu", others / f"{name}.fmu", experiments=[])
        declarations = comparison.declarations
        assert (declarations.only_first, declarations.only_second) == ((), ())
        assert declarations.differences == ()


def test_the_inverse_at_rest_in_one_position(others: Path, joystick_fmus: Path) -> None:
    """A motion is another matter: OpenModelica 1.14 is late to see events that no state depends on."""
    paths = joystick_fmus / "JoystickInverse.fmu", others / "JoystickInverse.fmu"
    moving = experiments_for(*map(read_description, paths))
    held = [
        Experiment("held", one.time[:11], {}, dict(one.inputs.iloc[0]))  # type: ignore[union-attr]
        for one in moving
    ]
    comparison = compare_fmus(*paths, experiments=held)
    assert comparison.within_limits
    for run in comparison.runs:
        assert max(one.relative for one in run.differences) < 1e-12
