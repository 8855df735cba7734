"""The joysticks' variable names that other tools rely on."""

from __future__ import annotations

import pytest

from tests.modelica.library import compiled, flat_variables

CONSTANT = "PreloadedSprings.Joystick.Joystick"
POWER_LAW = "PreloadedSprings.Joystick.JoystickPowerLaw"
FRICTION = "PreloadedSprings.Joystick.JoystickFriction"
FRICTION_POWER_LAW = "PreloadedSprings.Joystick.JoystickFrictionPowerLaw"
HELD = "PreloadedSprings.Operator.HeldJoystick"
HELD_POWER_LAW = "PreloadedSprings.Operator.HeldJoystickPowerLaw"
MOUNTED = "PreloadedSprings.Operator.MountedJoystick"
MOUNTED_POWER_LAW = "PreloadedSprings.Operator.MountedJoystickPowerLaw"
INVERSE = "PreloadedSprings.Joystick.JoystickInverse"
INVERSE_POWER_LAW = "PreloadedSprings.Joystick.JoystickInversePowerLaw"

BODY = {"J": "kg.m2", "m": "kg", "h": "m", "g": "m/s2", "a": "m", "b": "m"}
START = {"theta_start": "rad", "omega_start": "rad/s"}
SPRINGS = {
    f"{side}.{spring}Spring.{name}": unit
    for side in ("forward", "backward")
    for spring in ("return", "balance")
    for name, unit in {"k_s": "N/m", "k_h": "N/m", "F_0": "N", "x_0": "m"}.items()
}
CONSTANT_LAW = {"damping.C": "N.m.s/rad"}
POWER_LAWS = {
    "damping.alpha": "1",
    "damping.A_pos": "N.m.s/rad",
    "damping.n_pos": "1",
    "damping.A_neg": "N.m.s/rad",
    "damping.n_neg": "1",
    "damping.B": "N.m.s/rad",
    "damping.m": "1",
    "damping.eps_theta": "rad",
    "damping.eps_omega": "rad/s",
}
DRY_FRICTION = {
    "friction.T_c": "N.m", "friction.F_c": "N", "friction.T_s": "N.m", "friction.omega_s": "rad/s",
}  # fmt: skip
MOTION = {
    "theta": "rad", "omega": "rad/s", "alpha": "rad/s2", "x": "m", "f_x": "N",
    "M_s": "N.m", "M_d": "N.m", "M_g": "N.m", "C": "N.m.s/rad", "E": "J",
}  # fmt: skip
HAND = {"hand.K": "N.m/rad", "hand.D": "N.m.s/rad"}
HELD_INPUTS = {"T": "N.m", "theta_ref": "rad", "omega_ref": "rad/s", "grip": "1"}
HELD_OUTPUTS = {"T_hand": "N.m"}
STOPS = {"stops.theta_stop": "rad", "stops.K": "N.m/rad", "stops.D": "N.m.s/rad"}
MOUNTED_INPUTS = HELD_INPUTS | {"a_base": "m/s2", "a_base_z": "m/s2", "alpha_base": "rad/s2"}
MOUNTED_OUTPUTS = HELD_OUTPUTS | {"M_base": "N.m", "M_stop": "N.m"}
FRICTION_OUTPUTS = {"M_f": "N.m", "isStuck": None}
PRESCRIBED = {"theta": "rad", "omega": "rad/s", "alpha": "rad/s2"}
TORQUES = {
    "T": "N.m", "T_inertia": "N.m", "T_damping": "N.m", "T_stiffness": "N.m", "T_friction": "N.m",
    "T_band": "N.m",
}  # fmt: skip

PRESET = {
    "J": 0.01135, "m": 0.87, "h": 0.082, "g": 9.80665, "a": 0.02398, "b": 0.005,
    "theta_start": 0.0, "omega_start": 0.0, "damping.C": 0.045,
    "damping.alpha": 0.9, "damping.A_pos": 0.086, "damping.n_pos": 0.084, "damping.A_neg": 0.032,
    "damping.n_neg": -0.23, "damping.B": 0.051, "damping.m": -0.26,
    "damping.eps_theta": 1e-4, "damping.eps_omega": 1e-3,
    "friction.T_c": 0.0, "friction.F_c": 0.0, "friction.T_s": 0.0, "friction.omega_s": 0.0,
    "stops.theta_stop": 0.0,
}  # fmt: skip
TABLE_1 = {
    "forward": ((0.075e-3, 0.1985e-3, 2.932e-3, 2.943e-3), (430e3, 2625.0, 1028e3, 5600.0)),
    "backward": ((0.075e-3, 0.1595e-3, 3.054e-3, 3.063e-3), (659e3, 1191.0, 1112e3, 4090.0)),
}


@pytest.mark.parametrize(
    ("name", "parameters"),
    [
        (CONSTANT, BODY | START | SPRINGS | CONSTANT_LAW),
        (POWER_LAW, BODY | START | SPRINGS | POWER_LAWS),
        (FRICTION, BODY | START | SPRINGS | CONSTANT_LAW | DRY_FRICTION),
        (FRICTION_POWER_LAW, BODY | START | SPRINGS | POWER_LAWS | DRY_FRICTION),
        (HELD, BODY | START | SPRINGS | CONSTANT_LAW | DRY_FRICTION | HAND),
        (HELD_POWER_LAW, BODY | START | SPRINGS | POWER_LAWS | DRY_FRICTION | HAND),
        (MOUNTED, BODY | START | SPRINGS | CONSTANT_LAW | DRY_FRICTION | HAND | STOPS),
        (MOUNTED_POWER_LAW, BODY | START | SPRINGS | POWER_LAWS | DRY_FRICTION | HAND | STOPS),
        (INVERSE, BODY | SPRINGS | CONSTANT_LAW | DRY_FRICTION),
        (INVERSE_POWER_LAW, BODY | SPRINGS | POWER_LAWS | DRY_FRICTION),
    ],
)
def test_parameters_that_can_be_set(name: str, parameters: dict[str, str]) -> None:
    assert _settable(name) == parameters


@pytest.mark.parametrize(
    ("name", "inputs", "outputs"),
    [
        (CONSTANT, {"T": "N.m"}, MOTION),
        (POWER_LAW, {"T": "N.m"}, MOTION),
        (FRICTION, {"T": "N.m"}, MOTION | FRICTION_OUTPUTS),
        (FRICTION_POWER_LAW, {"T": "N.m"}, MOTION | FRICTION_OUTPUTS),
        (HELD, HELD_INPUTS, MOTION | FRICTION_OUTPUTS | HELD_OUTPUTS),
        (HELD_POWER_LAW, HELD_INPUTS, MOTION | FRICTION_OUTPUTS | HELD_OUTPUTS),
        (MOUNTED, MOUNTED_INPUTS, MOTION | FRICTION_OUTPUTS | MOUNTED_OUTPUTS),
        (MOUNTED_POWER_LAW, MOUNTED_INPUTS, MOTION | FRICTION_OUTPUTS | MOUNTED_OUTPUTS),
        (INVERSE, PRESCRIBED, TORQUES),
        (INVERSE_POWER_LAW, PRESCRIBED, TORQUES),
    ],
)
def test_inputs_and_outputs(name: str, inputs: dict[str, str], outputs: dict[str, str | None]) -> None:
    assert _top_level(name, "Input") == inputs
    assert _top_level(name, "Output") == outputs


@pytest.mark.parametrize("name", [POWER_LAW, INVERSE_POWER_LAW])
def test_the_other_weight_cannot_be_set(name: str) -> None:
    assert "damping.beta" in flat_variables(name)
    assert "damping.beta" not in _settable(name)


@pytest.mark.parametrize(
    ("name", "states"),
    [
        (CONSTANT, 2),
        (POWER_LAW, 2),
        (FRICTION, 2),
        (HELD, 2),
        (MOUNTED, 2),
        (INVERSE, 0),
        (INVERSE_POWER_LAW, 0),
    ],
)
def test_states(name: str, states: int) -> None:
    assert [state.name for state in compiled(name).states] == ["theta", "omega"][:states]


@pytest.mark.parametrize("name", [CONSTANT, POWER_LAW, FRICTION, MOUNTED, INVERSE, INVERSE_POWER_LAW])
def test_preset_values_are_the_papers(name: str) -> None:
    parameters = compiled(name).parameters
    settable = _settable(name)
    for parameter, value in PRESET.items():
        if parameter in settable:
            assert parameters[parameter].value == value, parameter
    for side, (x, k) in TABLE_1.items():
        spring = {n: parameters[f"{side}.{n}"].value for n in _spring_names()}
        assert spring["returnSpring.x_0"] == x[0]
        assert spring["returnSpring.k_s"] == k[1]
        assert spring["returnSpring.k_h"] == k[0] - k[1]
        assert spring["returnSpring.F_0"] == pytest.approx((k[0] - k[1]) * (x[1] - x[0]), rel=1e-14)
        assert spring["balanceSpring.x_0"] == x[2]
        assert spring["balanceSpring.k_s"] == k[3] - k[1]
        assert spring["balanceSpring.k_h"] == k[2] - k[3]
        assert spring["balanceSpring.F_0"] == pytest.approx((k[2] - k[3]) * (x[3] - x[2]), rel=1e-12)


def _spring_names() -> list[str]:
    return [f"{spring}Spring.{n}" for spring in ("return", "balance") for n in ("k_s", "k_h", "F_0", "x_0")]


def _settable(name: str) -> dict[str, str]:
    """Units of the parameters that nothing binds finally, neither a declaration nor a modification."""
    final = compiled(name).to_dict("flat")["variable_final_flags"]
    variables = flat_variables(name)
    return {n: v["unit"] for n, v in variables.items() if "Parameter" in v["variability"] and n not in final}


def _top_level(name: str, causality: str) -> dict[str, str | None]:
    variables = flat_variables(name)
    return {n: v["unit"] for n, v in variables.items() if "." not in n and causality in v["causality"]}
