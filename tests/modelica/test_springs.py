"""Springs and assemblies: force and energy over the travel, and opposing springs around a mass."""

from __future__ import annotations

import numpy as np
import pytest

from tests.modelica.library import Simulate
from tests.modelica.physics import TABLE_1, Array, table_force

SPEED = 5e-3
ACTUATORS = {
    1: "returnSpring(k_s = 2625, k_h = 427375, F_0 = 52.7808125, x_0 = 0.075e-3), "
    "balanceSpring(k_s = 2975, k_h = 1022400, F_0 = 11.2464, x_0 = 2.932e-3)",
    -1: "returnSpring(k_s = 1191, k_h = 657809, F_0 = 55.5848605, x_0 = 0.075e-3), "
    "balanceSpring(k_s = 2899, k_h = 1107910, F_0 = 9.97119, x_0 = 3.054e-3)",
}


def _pressed(simulate: Simulate, component: str, stop_time: float = 1.0) -> dict[str, Array]:
    declarations = (
        f"{component} PreloadedSprings.Parts.Press press(v = {SPEED}); PreloadedSprings.Parts.Fixed wall;"
    )
    connections = "connect(press.flange, c.flange_a); connect(c.flange_b, wall.flange);"
    return simulate(declarations, stop_time, equations=connections)


def test_restrained_preloaded_spring_follows_equations_6_to_8(simulate: Simulate) -> None:
    k_s, k_h, preload, x_0 = 2000.0, 1e5, 50.0, 1e-3
    result = _pressed(
        simulate,
        f"PreloadedSprings.Springs.RestrainedPreloadedSpring "
        f"c(k_s = {k_s}, k_h = {k_h}, F_0 = {preload}, x_0 = {x_0});",
    )
    delta = result["c.x"] - x_0
    tension = np.maximum(preload - k_h * np.maximum(delta, 0.0), 0.0)
    spring = preload + k_s * np.maximum(delta, 0.0)  # k_s*(x_so + delta), x_so = F_0/k_s
    assert delta[0] < 0.0 < preload / k_h < delta[-1]
    late = (k_s + k_h) * SPEED * simulate.event_error
    np.testing.assert_allclose(result["c.f"], spring - tension, atol=1e-11 + late)  # eq. (6)
    work = np.concatenate([[0.0], np.cumsum(_trapezoids(result["c.x"], result["c.f"]))])
    np.testing.assert_allclose(result["c.E"], work, atol=1e-6)


def test_spring_without_preload_is_a_linear_spring(simulate: Simulate) -> None:
    result = _pressed(
        simulate, "PreloadedSprings.Springs.RestrainedPreloadedSpring c(k_s = 2000, k_h = 1e5, F_0 = 0);"
    )
    np.testing.assert_allclose(result["c.f"], 2000.0 * result["c.x"], rtol=1e-14)


@pytest.mark.parametrize("side", [1, -1])
def test_assembly_of_springs_and_of_a_table_are_table_1(simulate: Simulate, side: int) -> None:
    x_i, k_i = TABLE_1[side]
    table = f"x_i = {{{', '.join(map(repr, x_i))}}}, k_i = {{{', '.join(map(repr, k_i))}}}"
    springs = _pressed(simulate, f"PreloadedSprings.Springs.ActuatorAssembly c({ACTUATORS[side]});")
    segments = _pressed(simulate, f"PreloadedSprings.Springs.TableAssembly c({table});")
    np.testing.assert_array_equal(springs["c.x"][::50], segments["c.x"][::50])
    late = max(k_i) * SPEED * simulate.event_error
    for result in (springs, segments):
        # In the steep segments, rounding of the travel alone makes k_i*x*epsilon = 7e-13 N.
        np.testing.assert_allclose(
            result["c.f"], table_force(result["c.x"], x_i, k_i), rtol=1e-12, atol=1e-12 + late
        )
    assert segments["c.f"][-1] > 60.0


@pytest.mark.parametrize("side", ["forward", "backward"])
def test_assembly_of_springs_and_of_a_table_have_equal_force_and_energy(
    simulate: Simulate, side: str
) -> None:
    result = simulate("extends PreloadedSprings.Examples.ComponentAgainstTable;", 1.5)
    force, energy = result[f"{side}.f"], result[f"{side}.E"]
    speed = np.ptp(result["press.s"]) / np.ptp(result["time"])
    late = speed * simulate.event_error
    steepest = max(TABLE_1[1 if side == "forward" else -1][1])
    np.testing.assert_allclose(result[f"{side}Table.f"], force, rtol=1e-12, atol=1e-12 + steepest * late)
    np.testing.assert_allclose(
        result[f"{side}Table.E"], energy, rtol=1e-12, atol=1e-15 + np.max(force) * late
    )
    work = np.concatenate([[0.0], np.cumsum(_trapezoids(result["press.s"], force))])
    # The force is straight between samples, and every kink is one: the trapezoids are exact.
    np.testing.assert_allclose(energy, work, atol=1e-12)


@pytest.mark.parametrize("segments", [1, 2, 7])
def test_table_takes_any_number_of_segments(simulate: Simulate, segments: int) -> None:
    x_i = [1e-3 + 0.5e-3 * i for i in range(segments)]
    k_i = [1000.0 * (1 + i % 3) for i in range(segments)]
    table = f"x_i = {{{', '.join(map(repr, x_i))}}}, k_i = {{{', '.join(map(repr, k_i))}}}"
    result = _pressed(simulate, f"PreloadedSprings.Springs.TableAssembly c({table});")
    late = max(k_i) * SPEED * simulate.event_error
    np.testing.assert_allclose(
        result["c.f"], table_force(result["c.x"], x_i, k_i), rtol=1e-12, atol=1e-14 + late
    )


@pytest.mark.parametrize("example", ["OpposingSprings", "OpposingSpringsWithoutClearance"])
def test_mass_between_opposing_springs(simulate: Simulate, example: str) -> None:
    """Period and energy fall (the paper's first finding); damping is the only loss."""
    result = simulate(f"extends PreloadedSprings.Examples.{example};", 1.0, 1e-4)
    rising = (result["mass.s"][:-1] < 0.0) & (result["mass.s"][1:] >= 0.0)
    periods = np.diff(result["time"][1:][rising])[:6]
    assert len(periods) == 6
    assert np.all(np.diff(periods) < 0.0)
    assert np.max(np.diff(result["E"])) < 1e-12
    loss = np.sum(_trapezoids(result["time"], 3.0 * result["mass.v"] ** 2))
    assert result["E"][0] - result["E"][-1] == pytest.approx(loss, rel=1e-4)


def test_undamped_mass_keeps_its_energy_and_mirrors_its_motion(simulate: Simulate) -> None:
    result = simulate("extends PreloadedSprings.Examples.OpposingSprings(damper(d = 0));", 0.2, 1e-4)
    np.testing.assert_allclose(result["E"], result["E"][0], rtol=1e-6)
    assert np.min(result["mass.s"]) == pytest.approx(-4e-3, abs=1e-8)


def _trapezoids(x: Array, y: Array) -> Array:
    return np.asarray(np.diff(x) * (y[1:] + y[:-1]) / 2.0)
