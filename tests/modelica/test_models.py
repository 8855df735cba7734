"""What every model of the library has to be: balanced, explicit, with a unit on every quantity."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import rumoca

from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.request import BuildRequest
from tests.modelica.library import (
    MODELICA_PATH,
    compiled,
    concrete_models,
    examples,
    flat_variables,
    library_classes,
)

JOYSTICKS = [
    f"PreloadedSprings.Joystick.Joystick{kind}"
    for kind in ("", "PowerLaw", "Friction", "FrictionPowerLaw", "Inverse", "InversePowerLaw")
]


def test_all_models_are_found() -> None:
    assert set(JOYSTICKS) < set(concrete_models())
    assert len(concrete_models()) >= 25
    assert len(examples()) >= 7


@pytest.mark.parametrize("name", concrete_models())
def test_every_model_alone_has_as_many_equations_as_unknowns(name: str) -> None:
    """Modelica 3.4, section 4.7: with its flanges unconnected and its inputs known; rumoca refuses others."""
    structure = compiled(name).structure()
    assert structure.n_equations == structure.n_unknowns > 0


def test_unbalanced_models_would_be_found() -> None:
    """The check above can fail: a flange whose angle and torque are both imposed."""
    source = """model Both
      PreloadedSprings.Interfaces.RotationalFlange flange;
    equation
      flange.phi = 0;
      flange.tau = 0;
    end Both;"""
    with pytest.raises(rumoca.CompileError, match="unbalanced"):
        rumoca.Session(roots=[str(MODELICA_PATH)]).loads(source, model="Both")


@pytest.mark.parametrize("name", JOYSTICKS + examples())
def test_models_need_no_system_of_equations(name: str) -> None:
    structure = compiled(name).structure()
    assert structure.is_matched
    assert structure.n_algebraic_loops == 0


@pytest.mark.parametrize("name", concrete_models())
def test_every_quantity_has_a_type_with_unit_and_display_unit(name: str) -> None:
    types = {c.name.removeprefix("Units."): c.text for c in library_classes() if c.kind == "type"}
    quantities = {re.search(r'quantity = "(\w+)"', text)[1] for n, text in types.items() if n != "Ratio"}  # type: ignore[index]
    reals = {n: v for n, v in flat_variables(name).items() if not v["is_discrete_type"]}
    assert reals
    for variable, attributes in reals.items():
        assert attributes["unit"], variable
        if attributes["unit"] != "1":
            assert attributes["quantity"] in quantities, variable
            assert attributes["display_unit"], variable


@pytest.mark.parametrize("name", concrete_models())
def test_every_flat_variable_has_a_description(name: str) -> None:
    assert [n for n, v in flat_variables(name).items() if not v["description"]] == []


def test_display_units_are_those_of_the_trade() -> None:
    shown = {n: v["display_unit"] for n, v in flat_variables(JOYSTICKS[0]).items()}
    assert shown["theta_start"] == "deg"
    assert shown["omega"] == "deg/s"
    assert shown["x"] == shown["a"] == shown["forward.returnSpring.x_0"] == "mm"


@pytest.mark.parametrize(
    ("name", "relations"),
    [
        # Four on either side, and the sign of the angle. Friction adds the signs of the velocity, pushes to
        # both sides, and four comparisons of its mode, which change at events only.
        *((joystick, 17 if "Friction" in joystick else 9) for joystick in JOYSTICKS),
        # Stops: met, and pushing.
        *((f"PreloadedSprings.Operator.MountedJoystick{law}", 19) for law in ("", "PowerLaw")),
        ("PreloadedSprings.Examples.OpposingSprings", 4),
        ("PreloadedSprings.Examples.ComponentAgainstTable", 16),
        ("PreloadedSprings.Examples.SwingTest", 1),
    ],
)
def test_each_kink_is_one_relation(name: str, relations: int, tmp_path: Path) -> None:
    model, _ = generate_model(BuildRequest(name, tmp_path))
    assert len(model.description.event_indicators) == relations
