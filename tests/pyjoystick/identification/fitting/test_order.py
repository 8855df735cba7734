"""The order of records and parameters does not change the answer."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    POWER_LAW_DAMPING,
    Fit,
    FitError,
    FitSettings,
    Free,
    Noise,
    Search,
    Uncertainty,
    fit,
    summary,
    with_values,
)
from pyjoystick.identification.fitting.solution.uncertainty import identifiability
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.motion import read_record
from tests.pyjoystick.identification.fitting.made import releases

DATA = Path(__file__).parents[4] / "scenarios" / "data"
QUICK = Search(stages=(), evaluations=60)


def _power_law(free: tuple[Free, ...] = POWER_LAW_DAMPING.free) -> FitSettings:
    settings = dataclasses.replace(POWER_LAW_DAMPING, free=free, search=QUICK)
    return with_values(settings, NOMINAL_POWER_LAW.to_names(), replace_starts=True)


def _assert_same(one: Fit, other: Fit) -> None:
    assert [check.message for check in one.checks] == [check.message for check in other.checks]
    for j, variable in enumerate(one.variables):
        assert one.x[j] == other.value(variable.label)
        assert one.standard_errors.errors[j] == other.error(variable.label)
        assert one.interval(variable.label) == other.interval(variable.label)


def test_the_verdict_does_not_depend_on_the_order(fmus_by_name: Path) -> None:
    """The six free parameters of eq. (11), which four records hardly determine: rounding errors decided."""
    records = releases(NOMINAL_POWER_LAW, 3, noise=np.radians(0.1), rate=60.0, duration=1.2)
    records = [dataclasses.replace(one, name=f"trial {5 - k}") for k, one in enumerate(records)]
    with Fmu("JoystickPowerLaw") as fmu:
        one = fit(records, _power_law(), fmu=fmu)
        turned = _power_law(tuple(reversed(POWER_LAW_DAMPING.free)))
        other = fit(reversed(records), turned, fmu=fmu)
    _assert_same(one, other)
    assert [record.name for record in other.records] == ["trial 3", "trial 4", "trial 5"]
    assert [variable.label for variable in other.variables[:4]] == [
        "zero_offset [trial 3]", "zero_offset [trial 4]", "zero_offset [trial 5]", "release_time [trial 3]"
    ]  # fmt: skip
    threshold, values = one.identifiability.threshold, one.identifiability.singular_values
    assert one.identifiability.rank == len(one.variables)
    assert values[-1] > 100.0 * threshold, "no verdict at the margin"


def test_all_of_a_result_is_in_the_order_given(fmus_by_name: Path) -> None:
    records = releases(NOMINAL, 3, noise=np.radians(0.1))
    settings = dataclasses.replace(
        CONSTANT_DAMPING,
        free=(*CONSTANT_DAMPING.free, Free("J", start=0.0114)),
        ties={"m": "76 * J", "omega_start": "0 * theta_start"},
        fixed={"b": 0.005},
        noise=Noise(per_record=True),
        uncertainty=Uncertainty(profiles=("damping.C",), bootstrap=2, resampling="residuals"),
    )
    with Fmu("Joystick") as fmu:
        one, other = fit(records, settings, fmu=fmu), fit(records[::-1], settings, fmu=fmu)
    _assert_same(one, other)
    for found, order in ((one, "012"), (other, "210")):
        names = [f"run {number}" for number in order]
        assert [record.name for record in found.records] == names
        assert [found.variables[j].name for j in (0, 10)] == ["damping.C", "J"]
        assert [variable.record for variable in found.variables] == [None, *3 * (0, 1, 2), None]
        assert [found.value(f"theta_start [{name}]") for name in names] == found.x[1:4].tolist()
        assert [(tie.name, tie.record) for tie in found.derived][:1] == [("m", "")]
        np.testing.assert_allclose(found.derived[0].slope, [0.0] * 10 + [76.0])
        assert list(found.profiles) == [0]
        assert found.profiles[0].variable == 0
        assert found.bootstrap is not None
        # The zeros are 0 but for noise of their own size.
        np.testing.assert_allclose(found.bootstrap.fits, np.tile(found.x, (2, 1)), rtol=0.1, atol=1e-3)
        np.testing.assert_array_equal(found.minima[0].x, found.x)
        diagonal = np.sqrt(np.diag(found.standard_errors.covariance))
        np.testing.assert_allclose(diagonal, found.standard_errors.errors)
        assert found.steps.steps.shape == found.x.shape
        for record in found.records:
            assert np.max(np.abs(record.residuals())) < np.radians(0.5)
    assert one.records[0].sigma == other.records[2].sigma


def test_the_route_of_the_search_moves_the_answer_by_less_than_the_sixth_digit(fmus_by_name: Path) -> None:
    records = releases(NOMINAL, 2, noise=np.radians(0.1))
    values = []
    with Fmu("Joystick") as fmu:
        for start, stages in ((0.05, (0.3, 0.6)), (0.2, (0.3, 0.6)), (0.01, (0.5,))):
            settings = dataclasses.replace(
                CONSTANT_DAMPING,
                free=(Free("damping.C", start=start), *CONSTANT_DAMPING.free[1:]),
                search=Search(stages=stages),
                uncertainty=Uncertainty(profiles=()),
            )
            values.append(fit(records, settings, fmu=fmu).value("damping.C"))
    np.testing.assert_allclose(values[1:], values[0], rtol=1e-6)


def test_nor_along_a_flat_valley(fmus_by_name: Path) -> None:
    """B and m of eq. (11), whose standard errors are ten times their values: six digits of these."""
    records = [read_record(DATA / f"synthetic_power_law_{number}.csv") for number in range(1, 5)]
    values = []
    with Fmu("JoystickPowerLaw") as fmu:
        for stages in ((0.3, 0.6), (0.5,)):
            settings = dataclasses.replace(POWER_LAW_DAMPING, search=Search(stages=stages))
            found = fit(records, settings, fmu=fmu)
            values.append([found.value(one.name) for one in settings.free if not one.per_record])
            assert found.error("damping.m") > 10.0 * abs(found.value("damping.m"))
    np.testing.assert_allclose(values[1], values[0], rtol=1e-6)


def test_an_fmu_that_cannot_be_that_exact_is_fitted_as_exactly_as_it_can(
    fmus_by_name: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    settings = dataclasses.replace(CONSTANT_DAMPING, search=QUICK, uncertainty=Uncertainty(profiles=()))
    records = releases(NOMINAL)
    exact = fit(records, settings)
    assert exact.steps.tolerance == 1e-10
    assert "Solution and derivatives at an FMU tolerance of 1e-10." in summary(exact)
    original = Fmu.plan

    def refuse(self: Fmu, *arguments: Any, tolerance: float, **others: Any) -> Any:
        if tolerance < settings.tolerance:
            raise FitError("run 0", "the run fails")
        return original(self, *arguments, tolerance=tolerance, **others)

    monkeypatch.setattr(Fmu, "plan", refuse)
    found = fit(records, settings)
    assert found.steps.tolerance == settings.tolerance
    assert found.value("damping.C") == pytest.approx(exact.value("damping.C"), rel=1e-5)


def test_what_is_lost_in_the_scatter_of_the_results_has_no_influence() -> None:
    """And does not hide what has one: exact columns beside one of noise."""
    jacobian = np.eye(4)[:, :3]
    jacobian[:, 2] = 0.0
    known = identifiability(jacobian, np.ones(3), ("a", "b", "c"), np.array([1e-9, 1e-9, 1.0]))
    assert known.rank == 2
    assert known.sentences == ("c has no influence on what was measured",)
