"""Parameters and outputs that an FMU rejects."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Fmu, FmuRunError, Variable, checked_value, read_description
from pyjoystick.fmu.values import allowed_values
from pyjoystick.support import ParameterError, UnknownParameterError, UnknownVariableError
from tests.pyjoystick.fmu.doctored import doctored

TIME = (0.0, 0.1)


def variable(type_: str, minimum: float | None = None, maximum: float | None = None) -> Variable:
    return Variable("p", type_, "parameter", "fixed", "exact", 1, "", "m", None, "1", minimum, maximum)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("m", 0, r"m = 0: must be a finite number above 0 kg \(at least 1e-60\)"),
        ("h", -0.1, "h = -0.1: must be a finite number, 0 m or more"),
        ("m", math.nan, r"m = nan: must be a finite number above 0 kg \(at least 1e-60\)"),
        ("m", math.inf, r"m = inf: must be a finite number above 0 kg \(at least 1e-60\)"),
        ("m", -0.1, r"m = -0.1: must be a finite number above 0 kg \(at least 1e-60\)"),
        ("m", "heavy", r"m = heavy: must be a finite number above 0 kg \(at least 1e-60\)"),
        ("m", True, r"m = True: must be a finite number above 0 kg \(at least 1e-60\)"),
        ("m", None, r"m = None: must be a finite number above 0 kg \(at least 1e-60\)"),
        ("m", [0.87], r"m = \[0.87\]: must be a finite number above 0 kg \(at least 1e-60\)"),
        ("omega_start", math.nan, "omega_start = nan: must be a finite number in rad/s"),
        (
            "theta",
            0.1,
            r"theta = 0.1: must be left out of the parameters \(it is a variable of kind output\)",
        ),
        ("T", 0.1, r"T = 0.1: must be left out of the parameters \(give it as an input\)"),
        ("time", 0.1, r"time = 0.1: must be left out of the parameters \(it is .* independent\)"),
    ],
)
def test_values_that_are_refused(joystick: Fmu, name: str, value: object, message: str) -> None:
    with pytest.raises(ParameterError, match=f"^{message}$"):
        joystick.run(TIME, parameters={name: value})  # type: ignore[dict-item]


def second_names(text: str) -> str:
    """A model description with another name, k, of the parameter p_... and one, w, of the input u_..."""
    for name, alias in (("p", "k"), ("u", "w")):
        text = re.sub(rf'(<Int32 name="{name}_Int32"[^>]*)/>', rf'\1><Alias name="{alias}"/></Int32>', text)
        fmi2 = rf'(<ScalarVariable name="){name}_Integer(".*?</ScalarVariable>)'
        text = re.sub(fmi2, rf"\g<0>\1{alias}\2", text)
    return text


@pytest.fixture(params=[2, 3], ids=["FMI 2", "FMI 3"])
def with_aliases(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Fmu]:
    echo = request.getfixturevalue(f"echo{request.param}_path")
    with Fmu(doctored(echo, tmp_path / "aliases.fmu", description=second_names)) as fmu:
        yield fmu


def test_two_names_of_one_variable_are_refused(with_aliases: Fmu) -> None:
    kind = "Integer" if with_aliases.description.fmi_version == "2.0" else "Int32"
    p, u = f"p_{kind}", f"u_{kind}"
    both = f"= {p} and k: must be given by one name .they name one variable"
    for value in (5, 6):
        with pytest.raises(ParameterError, match=f"parameters {both}"):
            with_aliases.run(TIME, parameters={p: 5, "k": value})
    with pytest.raises(ParameterError, match=f"varied {both}"):
        with_aliases.plan(TIME, varied=(p, "k"))
    with pytest.raises(ParameterError, match=f"varied {both}"):
        with_aliases.plan(TIME, varied="k", parameters={p: 5})
    inputs = {u: 1, "w": 1}
    for series in (inputs, pd.DataFrame(inputs, index=[0.0])):
        with pytest.raises(ParameterError, match=f"inputs = {u} and w: must be given by one name"):
            with_aliases.run(TIME, inputs=series)
    with with_aliases.start(inputs={u: 1}) as live:
        live.step(0.1, {"w": 2})
        with pytest.raises(ParameterError, match=f"inputs = w and {u}: must be given by one name"):
            live.step(0.1, {u: 1})


def test_the_joystick_takes_the_least_values_that_it_declares(joystick: Fmu) -> None:
    """Which bounds are refused for reasons that a minimum cannot express is said by the FMU itself."""
    bounded = {
        name: joystick.description.variables[name].minimum
        for name in joystick.description.settable_names()
        if joystick.description.variables[name].minimum is not None
    }
    assert len(bounded) > 20
    refused = {}
    for name, value in bounded.items():
        try:
            joystick.run(TIME, parameters={name: value})
        except FmuRunError as error:
            refused[name] = str(error)
    assert set(refused) == {"theta_start", "forward.balanceSpring.x_0", "backward.balanceSpring.x_0"}
    assert "theta_start must be between -pi/2 and pi/2" in refused.pop("theta_start")
    assert all("must not be less than returnSpring.x_0" in said for said in refused.values())


def test_names_of_outputs_are_texts(joystick: Fmu) -> None:
    with pytest.raises(ParameterError, match="outputs = an object of type int: must be names of variables"):
        joystick.run(TIME, outputs=["theta", 1])  # type: ignore[list-item]


def test_an_unknown_parameter_gets_the_nearest_ones(joystick: Fmu) -> None:
    with pytest.raises(UnknownParameterError, match=r"no parameter 'dampingC'; did you mean damping\.C"):
        joystick.run(TIME, parameters={"dampingC": 0.05})


def test_an_unknown_output_gets_the_nearest_ones(joystick: Fmu) -> None:
    with pytest.raises(UnknownVariableError, match=r"no variable 'tehta'; did you mean theta"):
        joystick.run(TIME, outputs=["tehta"])
    with pytest.raises(UnknownVariableError, match="no variable 'time'"):
        joystick.run(TIME, outputs=["time"])


@pytest.mark.parametrize(
    ("kind", "value", "expected"),
    [
        ("Real", 2, 2.0),
        ("Real", np.float32(0.5), 0.5),
        ("Integer", 2, 2),
        ("Integer", np.int64(2), 2),
        ("Enumeration", 2, 2),
        ("Boolean", np.True_, True),
        ("String", "text", "text"),
    ],
)
def test_values_come_in_the_type_of_the_variable(kind: str, value: object, expected: object) -> None:
    checked = checked_value(variable(kind), value)
    assert checked == expected
    assert type(checked) is type(expected)


@pytest.mark.parametrize(
    ("kind", "value", "message"),
    [
        ("Integer", 2.0, "an integer"),
        ("Integer", True, "an integer"),
        ("Enumeration", "first", "an integer"),
        ("Boolean", 1, "True or False"),
        ("String", 1, "text"),
        ("Real", 1j, "a finite number"),
        ("Real", 10**400, "a finite number"),
    ],
)
def test_values_of_another_type_are_refused(kind: str, value: object, message: str) -> None:
    with pytest.raises(ParameterError, match=f"must be {message}"):
        checked_value(variable(kind), value)


@pytest.mark.parametrize(
    ("low", "high", "inside", "outside", "words"),
    [
        (0.0, 1.0, (0.0, 1.0), (-1e-9, 1.0 + 1e-9), "a finite number from 0 to 1 m"),
        (0.0, None, (0.0, 1e300), (-1e-300,), "a finite number, 0 m or more"),
        (None, 1.0, (1.0, -1e300), (1.1,), "a finite number, 1 m or less"),
        (None, None, (-1e300,), (math.nan,), "a finite number in m"),
    ],
)
def test_the_ends_of_a_range_belong_to_it(
    low: float | None, high: float | None, inside: tuple[float, ...], outside: tuple[float, ...], words: str
) -> None:
    ranged = variable("Real", low, high)
    assert allowed_values(ranged) == words
    assert [checked_value(ranged, value) for value in inside] == list(inside)
    for value in outside:
        with pytest.raises(ParameterError, match=words):
            checked_value(ranged, value)


def test_values_of_an_enumeration_are_its_items(joystick_path: Path, tmp_path: Path) -> None:
    def with_items(description: str) -> str:
        items = '<Item name="slow" value="3"/><Item name="fast" value="7"/>'
        gears = f'<SimpleType name="Gear"><Enumeration>{items}</Enumeration></SimpleType>'
        gear = (
            '<ScalarVariable name="gear" valueReference="99" causality="parameter" variability="fixed" '
            'initial="exact"><Enumeration declaredType="Gear" start="3"/></ScalarVariable>'
        )
        description = description.replace("<ModelVariables>", f"<ModelVariables>{gear}", 1)
        units, end, rest = description.partition("</UnitDefinitions>")
        return f"{units}{end}<TypeDefinitions>{gears}</TypeDefinitions>{rest}"

    path = doctored(joystick_path, tmp_path / "gears.fmu", description=with_items)
    gear = read_description(path).variables["gear"]
    assert (gear.items, gear.minimum, gear.maximum) == ((3, 7), 3, 7)
    assert checked_value(gear, 7) == 7
    for value, message in ((0, "must be an integer from 3 to 7"), (5, "must be one of 3, 7")):
        with pytest.raises(ParameterError, match=message):
            checked_value(gear, value)
