"""The fit recovers Table 1 from synthetic records, within the errors that it states."""

from __future__ import annotations

import contextlib
import dataclasses
import re

import numpy as np
import pytest

from pyjoystick.laboratory import LoadCurve, fit_load_curve, load_curve_report, plot_load_curve
from pyjoystick.laboratory.load_curve.cubic import misses, segment_force
from pyjoystick.laboratory.load_curve.report import hysteresis_work
from pyjoystick.model import BACKWARD_TABLE, FORWARD_TABLE, NOMINAL, SegmentTable, table_force
from pyjoystick.motion import RecordError
from pyjoystick.support import ParameterError
from tests.pyjoystick.laboratory.load_curve.coverage import deviations_of
from tests.pyjoystick.laboratory.load_curve.machine import MACHINE, curve, cycle

_RUNS = 6


def test_stated_errors_cover_the_truth() -> None:
    """Monte Carlo: of 17 quantities in 6 records, 95 % intervals hold 90 % or more, and 4 sigma hold all.

    The quantities of one record are not independent; `coverage` as a script takes more
    of them.
    """
    found = deviations_of(range(100, 100 + _RUNS))
    assert found.pop("misfit") == pytest.approx(np.ones(_RUNS), abs=0.1)
    sizes = np.abs(list(found.values()))
    assert sizes.shape == (17, _RUNS)
    assert np.mean(sizes < 1.96) >= 0.9
    assert np.max(sizes) < 4.0


def test_noise_friction_and_zero_are_found() -> None:
    fit = fit_load_curve(curve(FORWARD_TABLE, 1))
    assert fit.travel_noise == pytest.approx(MACHINE.travel_noise, rel=0.1)
    assert fit.force_noise == pytest.approx(MACHINE.force_noise, rel=0.1)
    assert fit.friction == pytest.approx(MACHINE.friction, abs=0.01)
    assert fit.zero == pytest.approx(MACHINE.zero, abs=0.03)


def test_a_curve_without_noise_comes_back() -> None:
    travel = np.concatenate((up := np.arange(0.0, 3.6e-3, 2e-6), up[::-1]))
    fit = fit_load_curve(LoadCurve.from_cycle(travel, table_force(FORWARD_TABLE, travel)))
    assert fit.table.x == pytest.approx(FORWARD_TABLE.x, abs=1e-9)
    assert fit.table.k == pytest.approx(FORWARD_TABLE.k, rel=1e-4)


@pytest.mark.parametrize("seed", range(6))
def test_forces_rounded_to_a_newton_end_without_a_warning(seed: int) -> None:
    """The first segment may have no stiffness, or lie far away; here a warning of NumPy is an error."""
    travel = np.concatenate((up := np.linspace(0.0, 4.5e-3, 1500), up[::-1]))
    force = np.round(table_force(FORWARD_TABLE, travel) + 0.5 * np.sign(np.gradient(travel)))
    noise = np.random.default_rng(seed).normal(0.0, 3e-6, travel.size)
    with contextlib.suppress(RecordError):
        fit = fit_load_curve(LoadCurve.from_cycle(travel + noise, force))
        assert np.isfinite([*fit.x_errors, *fit.k_errors]).all()


def test_other_numbers_of_segments() -> None:
    table = SegmentTable((1e-3, 2e-3), (5e4, 1e4))
    travel = np.concatenate((up := np.arange(0.0, 4e-3, 1e-5), up[::-1]))
    force = table_force(table, travel) + 0.02 * np.random.default_rng(3).standard_normal(travel.size)
    fit = fit_load_curve(LoadCurve.from_cycle(travel, force), segments=2)
    assert np.all(np.abs(np.array(fit.table.x) - table.x) < 4.0 * fit.x_errors)
    assert np.all(np.abs(np.array(fit.table.k) - table.k) < 4.0 * fit.k_errors)
    with pytest.raises(ParameterError, match="four travels"):
        fit.springs()
    assert "returnSpring" not in load_curve_report(fit)


def test_springs_and_segments_are_one_curve() -> None:
    fit = fit_load_curve(curve(BACKWARD_TABLE, 2))
    x = np.linspace(0.0, 4e-3, 4001)
    np.testing.assert_allclose(segment_force(fit, x), table_force(fit.table, x), atol=1e-9)
    values = {name: value for name, (value, _) in fit.springs().items()}
    k_0, k_1, k_2, k_3 = fit.table.k
    x_0, x_1, x_2, x_3 = fit.table.x
    assert values["returnSpring.F_0"] == pytest.approx((k_0 - k_1) * (x_1 - x_0))
    assert values["balanceSpring.F_0"] == pytest.approx((k_2 - k_3) * (x_3 - x_2))
    assert values["balanceSpring.k_s"] == pytest.approx(k_3 - k_1)


def test_errors_of_the_springs_follow_from_the_covariance() -> None:
    """Against draws from the distribution that the covariance stands for."""
    fit = fit_load_curve(curve(FORWARD_TABLE, 4))
    mean = np.array([*fit.table.x, *fit.table.k])
    draws = np.random.default_rng(0).multivariate_normal(
        mean, fit.covariance[:8, :8], 20_000, method="cholesky"
    )
    preloads = (draws[:, 4] - draws[:, 5]) * (draws[:, 1] - draws[:, 0])
    # 20000 draws give a standard deviation to 0.5 %.
    assert fit.springs()["returnSpring.F_0"][1] == pytest.approx(np.std(preloads), rel=0.03)


def test_the_cubic_is_no_match() -> None:
    missed = misses(fit_load_curve(curve(FORWARD_TABLE, 1)))
    assert missed["cubic"].rms > 10.0 * missed["segments"].rms
    assert missed["cubic"].largest > 30.0


def test_hysteresis() -> None:
    fit = fit_load_curve(curve(FORWARD_TABLE, 1))
    # Twice the friction over the travel in contact that is kept: the last 0.5 % are not.
    expected = 2.0 * MACHINE.friction * (0.995 * 3.6e-3 - FORWARD_TABLE.x[0])
    assert hysteresis_work(fit) == pytest.approx(expected, rel=0.02)
    match = re.search(r"loading lies ([.\d]+) N above unloading", load_curve_report(fit))
    assert match
    assert float(match[1]) == pytest.approx(2.0 * MACHINE.friction, abs=0.02)


def test_loading_alone_is_used_with_a_note() -> None:
    travel, force = cycle(FORWARD_TABLE, 5)
    half = len(travel) // 2
    fit = fit_load_curve(LoadCurve.from_cycle(travel[:half], force[:half]))
    assert fit.friction == 0.0
    assert any("friction is counted as force of the springs" in note for note in fit.notes)
    # The force of friction is in the preload now, as the note says.
    preload = fit.springs()["returnSpring.F_0"]
    assert preload[0] == pytest.approx(NOMINAL.forward.return_spring.F_0 + MACHINE.friction, abs=0.1)
    assert np.isnan(hysteresis_work(fit))


def test_slack_within_the_curve_is_told_with_its_rows() -> None:
    fit = fit_load_curve(curve(FORWARD_TABLE, 6, slack=(1.5e-3, 0.05e-3)))
    (note,) = [note for note in fit.notes if "miss the record" in note]
    assert fit.misfit > 1.5
    match = re.fullmatch(
        r"the segments miss the record by (\S+) times its noise, most in rows (\d+)-(\d+) "
        r"\(travel about (\S+) mm\): look there for slack, sliding or one more segment",
        note,
    )
    assert match
    times, first, last, travel = (float(group) for group in match.groups())
    assert times == pytest.approx(fit.misfit, rel=0.05)
    rows = np.concatenate([branch.rows for branch in fit.curve.branches])
    at = np.concatenate([branch.travel for branch in fit.curve.branches])
    assert travel == pytest.approx(1e3 * np.mean(at[(rows >= first) & (rows <= last)]), abs=0.05)


def test_clearance_is_told_with_its_row() -> None:
    fit = fit_load_curve(curve(FORWARD_TABLE, 7))
    (note,) = [note for note in fit.notes if "clearance" in note]
    match = re.match(r"no force up to a travel of ([.\d]+) mm \(row (\d+)\)", note)
    assert match
    assert float(match[1]) == pytest.approx(0.075, abs=1e-3)
    assert int(match[2]) == pytest.approx(25, abs=1)


def test_a_segment_with_few_samples_is_told() -> None:
    fit = fit_load_curve(curve(FORWARD_TABLE, 8, step=15e-6))
    (note,) = [note for note in fit.notes if note.startswith("k_2")]
    match = re.fullmatch(
        r"k_2 rests on (\d+) samples between (\S+) and (\S+) mm and is uncertain by (\S+) %: .* more slowly",
        note,
    )
    assert match
    count, first, last, percent = (float(group) for group in match.groups())
    assert (first, last) == pytest.approx((1e3 * fit.table.x[2], 1e3 * fit.table.x[3]), rel=1e-4)
    low, high = fit.table.x[2:]
    inside = [np.sum((one.travel >= low) & (one.travel < high)) for one in fit.curve.branches]
    assert count == sum(inside) < 6
    assert percent == pytest.approx(100.0 * fit.k_errors[2] / fit.table.k[2], rel=0.06)


@pytest.mark.parametrize("first", [28, 40, 100])
def test_a_record_that_begins_in_contact_is_refused(first: int) -> None:
    travel, force = cycle(FORWARD_TABLE, 9)
    cut = slice(first, len(travel) - first)
    with pytest.raises(
        RecordError, match=r"row 0: is in contact from the first rows on.*begin the record before"
    ):
        fit_load_curve(LoadCurve.from_cycle(travel[cut], force[cut]))


def test_unloading_above_loading_is_refused() -> None:
    travel, force = cycle(FORWARD_TABLE, 10)
    swapped = np.concatenate((force[len(force) // 2 :][::-1] - 2.0, force[: len(force) // 2][::-1] + 2.0))
    with pytest.raises(RecordError, match=r"unloading lies [\d.]+ N above loading") as refused:
        fit_load_curve(LoadCurve.from_cycle(travel, swapped))
    stated = re.search(r"lies ([\d.]+) N", refused.value.reason)
    assert stated
    # Twice the friction, and 2 N put onto one branch and taken off the other.
    assert float(stated[1]) == pytest.approx(2.0 * MACHINE.friction + 4.0, abs=0.05)


def test_a_small_friction_below_zero_is_refused() -> None:
    """Of rows in reverse order: clear to the fit, though small beside the largest force."""
    travel, force = cycle(FORWARD_TABLE, 14)
    with pytest.raises(RecordError, match=r"unloading lies 0\.(59|60)\d* N above loading"):
        fit_load_curve(LoadCurve.from_cycle(travel[::-1], force[::-1]))


def test_a_drift_of_the_load_cell_is_noted() -> None:
    travel, force = cycle(FORWARD_TABLE, 14)
    assert not any("drifts" in note for note in fit_load_curve(LoadCurve.from_cycle(travel, force)).notes)
    drifting = force + np.linspace(0.0, 0.2, len(force))
    notes = fit_load_curve(LoadCurve.from_cycle(travel, drifting)).notes
    (drift,) = (note for note in notes if "drifts" in note)
    assert re.search(r"changes by \+0\.(19|2\d*) N from loading to unloading", drift)


@pytest.mark.parametrize("name", ["travel_noise", "force_noise"])
def test_noise_that_is_refused(name: str) -> None:
    with pytest.raises(ParameterError, match=name):
        fit_load_curve(curve(FORWARD_TABLE, 1), **{name: 0.0})


def test_the_figure_shows_the_steep_segments() -> None:
    fit = fit_load_curve(curve(FORWARD_TABLE, 1))
    figure = plot_load_curve(fit, title="synthetic")
    _, first, second = figure.axes
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels == ["loading", "unloading", "segments", "cubic"]
    for axes, i in ((first, 0), (second, 2)):
        low, high = axes.get_xlim()
        assert low < 1e3 * fit.table.x[i] < 1e3 * fit.table.x[i + 1] < high
    single = dataclasses.replace(fit, table=SegmentTable(fit.table.x[:1], fit.table.k[:1]))
    assert len(plot_load_curve(single).axes) == 1


def test_a_travel_of_six_steps_is_refused() -> None:
    travel, force = cycle(FORWARD_TABLE, 1, step=24e-6)
    steps = np.round(np.interp(travel, (travel.min(), travel.max()), (0.0, 5.0))) * 1e-3
    with pytest.raises(RecordError, match="4 segments"):
        fit_load_curve(LoadCurve.from_cycle(steps, force))


def test_a_record_that_ends_before_the_second_spring_is_refused_by_name() -> None:
    travel, force = cycle(FORWARD_TABLE, 1)
    kept = travel < 0.8 * FORWARD_TABLE.x[2]
    short = LoadCurve.from_cycle(travel[kept], force[kept], source="short.csv")
    with pytest.raises(RecordError, match=r"^short.csv.*--segments 2"):
        fit_load_curve(short).springs()
    assert fit_load_curve(short, 2).table.k[1] == pytest.approx(FORWARD_TABLE.k[1], rel=0.01)


@pytest.mark.parametrize("resolution", [0.0, 0.1])
def test_a_load_cell_at_the_end_of_its_range_is_refused_with_its_rows(resolution: float) -> None:
    travel, force = cycle(FORWARD_TABLE, 1)
    if resolution:
        force = resolution * np.round(force / resolution)
        fit_load_curve(LoadCurve.from_cycle(travel, force))  # coarse forces alone are none
    limit = float(np.floor(0.8 * np.max(force)))
    with pytest.raises(RecordError, match=r"the force stays at its largest value from .* mm on") as caught:
        fit_load_curve(LoadCurve.from_cycle(travel, np.minimum(force, limit)))
    rows = list(caught.value.rows)
    assert len(rows) > 100
    assert (force[rows] >= limit).all()
