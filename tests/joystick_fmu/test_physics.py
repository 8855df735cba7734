"""Laws that the FMUs' results obey for all parameters: energy, moments, the inverse."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray

from pyjoystick.forced_motion import inverse_fmu
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from tests.joystick_fmu.driver import Columns, fmu_parameters, fmu_path, slave
from tests.pyjoystick.random_parameters import RandomCase, both_laws

CASES = [RandomCase("paper, constant", NOMINAL, np.deg2rad(-20.0))]
CASES += [RandomCase("paper, power law", NOMINAL_POWER_LAW, np.deg2rad(-20.0))]
CASES += both_laws(2)
NAMES = ("theta", "omega", "alpha", "x", "f_x", "M_s", "M_d", "M_g", "C", "E")

every_case = pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])


def _run(case: RandomCase, folder: Path, times: NDArray[np.float64]) -> Columns:
    with slave(fmu_path(folder, case.parameters)) as run:
        run.start(fmu_parameters(case.parameters, case.theta_start), tolerance=1e-10)
        return run.run(times, NAMES)


@every_case
def test_energy_never_rises(case: RandomCase, fmus: Path) -> None:
    energy = _run(case, fmus, np.linspace(0.0, 1.5, 15001))["E"]
    assert np.diff(energy).max() < 1e-9


@every_case
def test_energy_is_lost_to_damping_alone(case: RandomCase, fmus: Path) -> None:
    """dE/dt = -C*omega^2, integrated (physics.md, section 1)."""
    end = 0.3
    with slave(fmu_path(fmus, case.parameters), logging=True) as run:
        run.start(fmu_parameters(case.parameters, case.theta_start), tolerance=1e-10)
        run.run(np.array([0.0, end]), NAMES)
        events = [event.time for event in run.events() if event.time < end]
    # The damping of eq. (11) jumps in the middle, so each stretch between two events is integrated by itself.
    stretches = [(start + 1e-11, stop - 1e-11) for start, stop in pairwise([0.0, *events, end])]
    panels = np.vstack([_panels(start, stop) for start, stop in stretches if stop - start > 4e-11])
    nodes, weights = leggauss(8)
    lengths = np.diff(panels)
    times = (panels[:, :1] + 0.5 * lengths * (1.0 + nodes)).ravel()
    run_of = _run(case, fmus, np.concatenate([[0.0], times, [end]]))
    rate = (run_of["C"] * run_of["omega"] ** 2)[1:-1]
    lost = rate @ (0.5 * lengths * weights).ravel()
    assert run_of["E"][0] - run_of["E"][-1] == pytest.approx(lost, abs=1e-8)


def _panels(start: float, stop: float) -> NDArray[np.float64]:
    """Begin and end of panels of at most 0.25 ms (s), shape (n, 2).

    They are short at both ends: the damping of eq. (11) changes within 1e-4 rad of the middle.
    """
    ends = 4e-6 * 2.0 ** np.arange(7)
    ends = ends[ends < (stop - start) / 2.0]
    inner = np.linspace(start, stop, 2 + int((stop - start) / 2.5e-4))[1:-1]
    if ends.size:
        inner = inner[(inner > start + ends[-1]) & (inner < stop - ends[-1])]
    grid = np.concatenate([[start], start + ends, inner, stop - ends[::-1], [stop]])
    return np.stack([grid[:-1], grid[1:]], axis=1)


@every_case
def test_contact_moment_is_conservative(case: RandomCase, fmus: Path) -> None:
    """M_s = f_x*dx/dtheta, the corrected eq. (5), with eq. (3) differentiated by hand."""
    run = _run(case, fmus, np.linspace(0.0, 1.5, 1501))
    theta, p = run["theta"], case.parameters
    slope = (np.sign(theta) * p.a - p.b * np.sin(theta)) / np.cos(theta) ** 2
    expected = run["f_x"] * slope
    assert np.abs(run["M_s"] - expected).max() <= 1e-12 * np.abs(expected).max()


@every_case
def test_moments_balance(case: RandomCase, fmus: Path) -> None:
    """J*alpha + M_d + M_s = M_g, and M_d = C*omega, M_g = m*g*h*sin(theta): eq. (1)."""
    run = _run(case, fmus, np.linspace(0.0, 1.5, 1501))
    p = case.parameters
    largest = np.abs(run["M_s"]).max()
    assert run["M_d"] == pytest.approx(run["C"] * run["omega"], abs=1e-15 * largest)
    assert run["M_g"] == pytest.approx(p.m * p.g * p.h * np.sin(run["theta"]), abs=1e-14 * largest)
    sum_of_moments = p.J * run["alpha"] + run["M_d"] + run["M_s"] - run["M_g"]
    assert np.abs(sum_of_moments).max() <= 1e-13 * largest


@every_case
def test_inverse_returns_no_torque_for_free_motion(case: RandomCase, fmus: Path) -> None:
    """The inverse FMU of the damping law (eq. 13) on a free oscillation: nothing drives it."""
    times = np.linspace(0.0, 0.5, 101)
    motion = _run(case, fmus, times)
    outputs = ("T", "T_inertia", "T_damping", "T_stiffness")
    with slave(fmus / f"{inverse_fmu(case.parameters.damping)}.fmu") as run:
        run.start(case.parameters.to_names(), tolerance=1e-8)
        inputs = [run.references[name] for name in ("theta", "omega", "alpha")]
        rows = []
        for i, time in enumerate(times):
            run.set(inputs, [motion[name][i] for name in ("theta", "omega", "alpha")])
            run.fmu.doStep(currentCommunicationPoint=time, communicationStepSize=1e-6)
            rows.append(run.get([run.references[name] for name in outputs]))
            run.fmu.doStep(currentCommunicationPoint=time + 1e-6, communicationStepSize=5e-3 - 1e-6)
    torque, inertia, damping, stiffness = np.array(rows).T
    largest = np.abs(inertia).max()
    assert np.abs(torque).max() <= 1e-12 * largest
    assert inertia == pytest.approx(case.parameters.J * motion["alpha"], abs=1e-14 * largest)
    assert damping == pytest.approx(motion["M_d"], abs=1e-14 * largest)
    assert stiffness == pytest.approx(motion["M_s"] - motion["M_g"], abs=1e-12 * largest)
