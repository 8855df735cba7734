from __future__ import annotations

from dataclasses import replace

import pytest

from pyjoystick import ParameterError, UnknownParameterError
from pyjoystick.fmu import FmuNotFoundError
from pyjoystick.runs import Component, Connection, CouplingError, operator_and_joystick

pytestmark = pytest.mark.usefixtures("fmus_by_name")


def test_the_joystick_system_is_sound() -> None:
    assert list(operator_and_joystick().describe()) == ["joystick", "operator"]


@pytest.mark.parametrize(
    ("source", "target", "message"),
    [
        ("stick.theta", "operator.theta", "no component 'stick'; known are joystick, operator"),
        ("joystick.theta", "operator.angle", "no input of operator 'angle'; .*theta"),
        ("joystick.T", "operator.theta", "no output of joystick 'T'"),
        (
            "joystick.theta",
            "operator.omega",
            "output's unit is rad, the input's rad/s; they must",
        ),
    ],
)
def test_wrong_connections(source: str, target: str, message: str) -> None:
    system = replace(operator_and_joystick(), connections=(Connection(source, target),))
    with pytest.raises(CouplingError, match=message):
        system.describe()


def test_an_input_has_one_source() -> None:
    system = operator_and_joystick()
    twice = replace(system, connections=(*system.connections, system.connections[0]))
    with pytest.raises(CouplingError, match=r"operator\.theta: is fed by 2 outputs; one is allowed"):
        twice.describe()


@pytest.mark.parametrize("name", ["joystick", "a.b", ""])
def test_names_of_components(name: str) -> None:
    system = operator_and_joystick()
    other = replace(system, components=(*system.components, Component(name, "Joystick")))
    with pytest.raises(CouplingError, match="must be unique and contain no dot"):
        other.describe()


def test_parameters_are_checked() -> None:
    with pytest.raises(UnknownParameterError, match=r"handArm\.K"):
        operator_and_joystick(operator={"handArm.k": 1.0}).describe()
    with pytest.raises(ParameterError, match=r"handArm\.K = -1"):
        operator_and_joystick(operator={"handArm.K": -1.0}).describe()


def test_a_missing_fmu() -> None:
    system = replace(operator_and_joystick(), components=(Component("joystick", "nowhere.fmu"),))
    with pytest.raises(FmuNotFoundError, match=r"nowhere\.fmu"):
        system.describe()
