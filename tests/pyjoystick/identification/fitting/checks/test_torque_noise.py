"""Noise of the measured torque: in the standard errors, or refused by name."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.identification import CONSTANT_DAMPING, Fit, Measurement, Uncertainty, driven, fit
from pyjoystick.identification.fitting.problem.torque_noise import Whitener, white_level
from pyjoystick.model import NOMINAL, contact_moment, gravity_moment, simulate
from pyjoystick.support import FloatArray

TRUTH = {"J": NOMINAL.J, "damping.C": 0.045, "delay": 0.004}
NOISE = math.radians(0.02)
START = math.radians(6.0)
SETTINGS = dataclasses.replace(driven(CONSTANT_DAMPING), uncertainty=Uncertainty(profiles=()))


def _record(noise: float, seed: int, *, shaken: float = 0.0) -> Measurement:
    """Two seconds of pushes to and fro; noise of the instrument, and white torque that the joystick feels."""
    random = np.random.default_rng(seed)
    hold = float(contact_moment(NOMINAL, START) - gravity_moment(NOMINAL, START))
    corners = np.array([0.0, 0.2, 0.26, 0.7, 0.76, 1.2, 1.26, 1.7, 1.76, 2.0])
    levels = np.array([hold, hold, -1.9, -1.9, 1.9, 1.9, -2.0, -2.0, 1.9, 1.9])
    time = np.arange(1001) / 500.0
    torque = np.interp(time, corners, levels) + shaken * random.standard_normal(len(time))
    instants = np.unique(np.concatenate(([0.0], np.maximum(time - TRUTH["delay"], 0.0))))
    run = simulate(
        NOMINAL,
        time=instants,
        theta_start=START,
        torque=lambda t: float(np.interp(t, time, torque)),
        torque_breakpoints=time,
    )
    theta = run.theta[np.searchsorted(instants, np.maximum(time - TRUTH["delay"], 0.0))]
    measured = {
        "theta": theta + NOISE * random.standard_normal(len(time)),
        "T": torque + noise * random.standard_normal(len(time)),
    }
    return Measurement(f"run {seed}", time, measured)


def _deviations(found: Fit) -> list[float]:
    return [(found.value(name) - true) / found.error(name) for name, true in TRUTH.items()]


@pytest.fixture(scope="module")
def fmu(joystick_fmus: Path) -> Fmu:
    return Fmu(joystick_fmus / "Joystick.fmu")


@pytest.mark.parametrize("noise", [0.0005, 0.002])
def test_standard_errors_contain_the_noise_of_the_torque(fmu: Fmu, noise: float) -> None:
    found = [fit([_record(noise, seed)], SETTINGS, fmu=fmu) for seed in range(4)]
    assert sum(one.trusted for one in found) >= 3, [one.failed for one in found]
    assert [one.records[0].torque_noise for one in found] == pytest.approx([noise] * 4, rel=0.15)
    assert [one.records[0].sigma["theta"] for one in found] == pytest.approx([NOISE] * 4, rel=0.15)
    deviations = np.concatenate([_deviations(one) for one in found])
    # Twelve numbers of one standard deviation: 1.6 is chance in one of 2000.
    assert np.sqrt(np.mean(deviations**2)) < 1.6
    assert "Noise of the torque" in found[0].summary()


def test_too_much_noise_is_named(fmu: Fmu) -> None:
    found = fit([_record(0.2, 1)], SETTINGS, fmu=fmu)
    assert "torque" in found.failed
    (check,) = (one for one in found.checks if one.name == "torque")
    assert "N m, too much" in check.message


def test_noise_that_moves_the_joystick_is_none_of_the_instrument(fmu: Fmu) -> None:
    found = fit([_record(0.0, 3, shaken=0.05)], SETTINGS, fmu=fmu)
    assert found.records[0].torque_noise < 0.002
    assert np.max(np.abs(_deviations(found))) < 4.0


def _smooth(time: FloatArray) -> FloatArray:
    return 1.6 * np.sin(4.0 * np.pi * time) + np.clip(20.0 * (time - 1.0), 0.0, 1.0)


def test_the_level_of_white_noise_in_something_smooth() -> None:
    time = np.arange(2000) / 500.0
    noise = np.random.default_rng(1).standard_normal(len(time))
    assert white_level(_smooth(time) + 0.01 * noise) == pytest.approx(0.01, rel=0.1)
    assert white_level(_smooth(time)) < 1e-6
    assert white_level(np.zeros(2)) == 0.0


def test_the_filter_whitens_and_its_inverse_colors() -> None:
    random = np.random.default_rng(2)
    effects = random.standard_normal((30, 4))
    whitener = Whitener(2.0 * effects)
    covariance = np.eye(30) + 4.0 * effects @ effects.T
    matrix = whitener.whitened(np.eye(30))
    assert matrix @ covariance @ matrix.T == pytest.approx(np.eye(30), abs=1e-12)
    assert whitener.logarithm == pytest.approx(np.linalg.slogdet(covariance)[1])
    values = random.standard_normal(30)
    assert whitener.colored(whitener.whitened(values)) == pytest.approx(values)
    assert Whitener(effects).times(2.0).whitened(values) == pytest.approx(whitener.whitened(values))
