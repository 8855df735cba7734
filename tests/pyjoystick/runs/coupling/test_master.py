from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import solve_ivp

from fmu_build import build_fmu
from pyjoystick import NOMINAL, ParameterError
from pyjoystick.fmu import UnsupportedFmuError
from pyjoystick.model import contact_moment
from pyjoystick.model.reference.moments import gravity_moment
from pyjoystick.runs import (
    SCHEMES,
    Component,
    Connection,
    CoupledSystem,
    CouplingError,
    operator_and_joystick,
    run_coupled,
)
from pyjoystick.runs.coupling import system as module
from pyjoystick.support import UnknownVariableError

ORDERS = {"delay": 1, "hold": 1, "extrapolate": 2, "iterate": 2}

pytestmark = pytest.mark.usefixtures("fmus_by_name")


def _error(scheme: str, step: float, monolithic: Callable[..., pd.Series]) -> float:
    run = run_coupled(
        operator_and_joystick(), step=step, scheme=scheme, outputs=["joystick.theta"], tolerance=1e-10
    )
    return float(np.abs(run["joystick.theta"] - monolithic(run.index)).max())


def test_every_scheme_is_tested() -> None:
    assert set(ORDERS) == set(SCHEMES)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_the_error_falls_with_the_step_as_its_order_says(
    scheme: str, monolithic: Callable[..., pd.Series]
) -> None:
    long, short = (_error(scheme, step, monolithic) for step in (2e-3, 0.5e-3))
    assert 0.8 * ORDERS[scheme] < np.log(long / short) / np.log(4.0) < 1.3 * ORDERS[scheme]


def test_derivatives_and_states_gain_much_at_a_millisecond(monolithic: Callable[..., pd.Series]) -> None:
    errors = {scheme: _error(scheme, 1e-3, monolithic) for scheme in SCHEMES}
    assert errors["delay"] > 5.0 * errors["hold"] > 15.0 * errors["extrapolate"] > 45.0 * errors["iterate"]


def test_iteration_holds_where_extrapolation_swings_up(monolithic: Callable[..., pd.Series]) -> None:
    assert _error("extrapolate", 0.02, monolithic) > 1.0
    assert _error("iterate", 0.02, monolithic) < 2e-3


def test_the_system_as_one_model_is_the_equations() -> None:
    """Operator and joystick once more, from the equations, through SciPy's integrator."""
    run = run_coupled(operator_and_joystick(), step=2e-4, scheme="iterate", tolerance=1e-10)
    target, start, move, pause = np.radians(15.0), 0.1, 0.3, 0.2

    def wanted(t: float) -> tuple[float, float]:
        s, r = (min(max((t - begin) / move, 0.0), 1.0) for begin in (start, start + move + pause))
        angle = target * (10 * s**3 - 15 * s**4 + 6 * s**5 - (10 * r**3 - 15 * r**4 + 6 * r**5))
        return angle, target / move * (30 * s**2 * (1 - s) ** 2 - 30 * r**2 * (1 - r) ** 2)

    def torque(t: float, theta: float, omega: float) -> float:
        angle, rate = wanted(t)
        return 25.0 * (angle - theta) + 0.7 * (rate - omega)

    def motion(t: float, state: np.ndarray) -> list[float]:
        theta, omega, _ = state
        applied = torque(t, theta, omega)
        moment = applied + gravity_moment(NOMINAL, theta) - contact_moment(NOMINAL, theta)
        return [omega, float(moment - 0.045 * omega) / NOMINAL.J, applied * omega]

    # The kinks of springs and move are passed with small steps: what is left is below the coupling error.
    solved = solve_ivp(
        motion, (0.0, 1.2), [0.0, 0.0, 0.0], t_eval=run.index, rtol=1e-9, atol=1e-11, max_step=2e-4
    )
    assert np.abs(run["joystick.theta"] - solved.y[0]).max() < 1e-6
    assert np.abs(run["operator.W"] - solved.y[2]).max() < 1e-6


def test_parameters_reach_their_fmus(monolithic: Callable[..., pd.Series]) -> None:
    system = operator_and_joystick(operator={"handArm.K": 40.0}, joystick={"J": 0.02})
    run = run_coupled(system, step=5e-4, scheme="iterate", outputs=["joystick.theta"])
    theta = monolithic(run.index, **{"operator_.handArm.K": 40.0, "joystick.J": 0.02})
    assert np.abs(run["joystick.theta"] - theta).max() < 1e-5
    assert np.abs(run["joystick.theta"] - monolithic(run.index)).max() > 1e-2


def test_the_table_has_units_and_the_last_step_is_cut() -> None:
    run = run_coupled(
        operator_and_joystick(), step=0.03, duration=0.1, outputs=["operator.W", "joystick.theta"]
    )
    assert list(run.columns) == ["operator.W", "joystick.theta"]
    assert run.attrs["units"] == {"time": "s", "operator.W": "J", "joystick.theta": "rad"}
    np.testing.assert_allclose(run.index, [0.0, 0.03, 0.06, 0.09, 0.1], rtol=1e-15)
    assert run.attrs["steps"] == 8


def test_by_default_every_output_is_recorded() -> None:
    run = run_coupled(operator_and_joystick(), duration=2e-3)
    assert list(run.columns)[:2] == ["joystick.theta", "joystick.omega"]
    assert list(run.columns)[-4:] == ["operator.T", "operator.theta_ref", "operator.omega_ref", "operator.W"]


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"step": 0.0}, "step = 0.0"),
        ({"step": 1e-9}, "step = 1e-09: must be 1.2e-07 s or more"),
        ({"duration": -1.0}, "duration = -1.0"),
        ({"scheme": "jacobi"}, "scheme = jacobi: must be one of delay, hold, extrapolate, iterate"),
        ({"tolerance": 0.0}, "tolerance = 0.0"),
    ],
)
def test_wrong_settings(settings: dict[str, object], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        run_coupled(operator_and_joystick(), **settings)  # type: ignore[arg-type]


def test_an_unknown_output() -> None:
    with pytest.raises(UnknownVariableError, match=r"did you mean joystick\.theta"):
        run_coupled(operator_and_joystick(), outputs=["joystick.thet"])


@pytest.fixture(scope="module")
def gain(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An FMU whose output is at once twice its input."""
    folder = tmp_path_factory.mktemp("gain")
    (folder / "Gain.mo").write_text(
        "model Gain input Real u(start = 1); output Real y; equation y = 2*u + 1; end Gain;"
    )
    return build_fmu("Gain", folder, library=folder / "Gain.mo").path


def test_a_loop_without_a_state_is_refused(gain: Path) -> None:
    system = CoupledSystem(
        "loop",
        (Component("a", gain), Component("b", gain)),
        (Connection("a.y", "b.u"), Connection("b.y", "a.u")),
        1.0,
    )
    with pytest.raises(CouplingError, match=r"a\.y -> b\.u, b\.y -> a\.u: an algebraic loop"):
        run_coupled(system)


def test_a_chain_of_answers_settles_within_one_communication_point(gain: Path) -> None:
    system = CoupledSystem(
        "chain",
        tuple(Component(name, gain) for name in "abc"),
        (Connection("c.y", "b.u"), Connection("b.y", "a.u")),
        1.0,
    )
    run = run_coupled(system, step=0.5)
    assert (run["c.y"] == 3.0).all()
    assert (run["b.y"] == 7.0).all()
    assert (run["a.y"] == 15.0).all()


def test_one_output_may_feed_two_inputs_and_the_fmu_need_not_be_fed(gain: Path) -> None:
    system = CoupledSystem(
        "fan",
        tuple(Component(name, gain) for name in "abc"),
        (Connection("a.y", "b.u"), Connection("a.y", "c.u")),
        1.0,
    )
    run = run_coupled(system, step=0.5, scheme="iterate")
    assert (run["b.y"] == run["c.y"]).all()
    assert (run["b.y"] == 7.0).all()


@pytest.mark.parametrize(
    ("capability", "scheme", "message"),
    [
        ("interpolates_inputs", "extrapolate", "does not follow input derivatives .* 'extrapolate' needs"),
        ("interpolates_inputs", "iterate", "does not follow input derivatives .* 'iterate' needs"),
        ("saves_states", "iterate", r"cannot save and restore its state .* 'iterate' needs; delay and hold"),
    ],
)
def test_an_fmu_that_lacks_what_the_scheme_needs_is_refused(
    capability: str, scheme: str, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    read = module.read_description
    monkeypatch.setattr(module, "read_description", lambda path: replace(read(path), **{capability: False}))
    with pytest.raises(UnsupportedFmuError, match=message):
        run_coupled(operator_and_joystick(), scheme=scheme)
    run_coupled(operator_and_joystick(), scheme="hold", duration=2e-3)


def _with_fmi3(system: CoupledSystem, folder: Path, *names: str) -> CoupledSystem:
    """The system with the components of these names as FMUs of FMI 3."""
    components = [
        replace(one, fmu=folder / f"{one.fmu}.fmu") if one.name in names else one for one in system.components
    ]
    return replace(system, components=tuple(components))


@pytest.mark.parametrize("names", [("joystick", "operator"), ("operator",)], ids=["both", "one of two"])
@pytest.mark.parametrize("scheme", ["delay", "hold"])
def test_fmus_of_fmi_3_give_the_same_bits(scheme: str, names: tuple[str, ...], joystick_fmus3: Path) -> None:
    system = operator_and_joystick(operator={"handArm.K": 30.0}, joystick={"J": 0.012})
    settings: dict[str, Any] = {"scheme": scheme, "step": 2e-3, "duration": 0.5}
    old, new = (run_coupled(one, **settings) for one in (system, _with_fmi3(system, joystick_fmus3, *names)))
    pd.testing.assert_frame_equal(old, new, check_exact=True)
    assert old.attrs == new.attrs


@pytest.mark.parametrize("scheme", ["extrapolate", "iterate"])
def test_fmi_3_has_no_input_derivatives(scheme: str, joystick_fmus3: Path) -> None:
    system = _with_fmi3(operator_and_joystick(), joystick_fmus3, "operator")
    message = rf"Operator\.fmu: does not follow input derivatives .*FMI 2.0.* scheme '{scheme}' needs"
    with pytest.raises(UnsupportedFmuError, match=message):
        run_coupled(system, scheme=scheme)


def test_an_fmu_of_fmi_3_without_inputs_takes_part_in_every_scheme(gain: Path, tmp_path: Path) -> None:
    """Its state is saved and restored, and its output is followed."""
    source = tmp_path / "Source.mo"
    source.write_text(
        "model Source output Real y(start = 0, fixed = true); equation der(y) = 1 - y; end Source;"
    )
    path = build_fmu("Source", tmp_path, library=source, fmi_version="3.0").path
    system = CoupledSystem(
        "chain", (Component("a", path), Component("b", gain)), (Connection("a.y", "b.u"),), 1.0
    )
    for scheme in SCHEMES:
        run = run_coupled(system, step=0.125, scheme=scheme, tolerance=1e-10)
        np.testing.assert_allclose(run["a.y"], 1.0 - np.exp(-run.index), rtol=0.0, atol=1e-8)
        np.testing.assert_allclose(run["b.y"], 2.0 * run["a.y"] + 1.0, rtol=0.0, atol=1e-8)


def test_whole_numbers_and_booleans_are_signals_too(tmp_path: Path) -> None:
    source = tmp_path / "Whole.mo"
    source.write_text(
        "model Whole input Integer u(start = 0); input Boolean b(start = false); output Integer y; "
        "output Boolean c; equation y = u + 1; c = not b; end Whole;"
    )
    path = build_fmu("Whole", tmp_path, library=source).path
    system = CoupledSystem(
        "chain",
        (Component("a", path), Component("b", path)),
        (Connection("a.y", "b.u"), Connection("a.c", "b.b")),
        1.0,
    )
    for scheme in SCHEMES:
        run = run_coupled(system, step=0.5, scheme=scheme)
        # What is discrete answers within a step, not at the first communication point.
        assert run.to_numpy().tolist()[1:] == [[1.0, 1.0, 2.0, 0.0]] * 2
