"""The angle of the joystick from markers whose motion is known, and where it comes to rest."""

from __future__ import annotations

import dataclasses
import re
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from pyjoystick.laboratory import BASE, TOP, MarkerLayout, measure_angle, rest_angle, synthetic_markers
from pyjoystick.laboratory.measurements.angle import AngleMeasurement, Base, Origin
from pyjoystick.laboratory.measurements.markers import Markers
from pyjoystick.model import NOMINAL, SIDES, Side, contact_moment, gravity_moment, simulate
from pyjoystick.motion import RecordError
from pyjoystick.support import ParameterError
from tests.pyjoystick.laboratory.measurements.made import swing

TIME = np.arange(180) / 60.0
THETA = swing(TIME)


def _markers(*, noise: float = 0.0, seed: int = 1, layout: MarkerLayout | None = None) -> Markers:
    random = np.random.default_rng(seed)
    return synthetic_markers(TIME, THETA, random=random, noise=noise, layout=layout)


def _measured(
    markers: Markers, *, forward: str = "x", origin: Origin = "arc", base_motion: Base = "still"
) -> AngleMeasurement:
    return measure_angle(
        markers, top=TOP, base=BASE, forward=forward, origin=origin, base_motion=base_motion, rest=(2.5, 3.0)
    )


def _from_rest() -> np.ndarray:
    return np.asarray(THETA - THETA[TIME >= 2.5].mean())


@pytest.mark.parametrize("heading", [0.0, 0.4, np.pi / 2.0, 3.0])
def test_the_angle_is_exact_without_noise_wherever_the_joystick_points(heading: float) -> None:
    markers = _markers(layout=MarkerLayout(heading=heading, sideways=0.0))
    forward = {0.0: "x", 0.4: "x", np.pi / 2.0: "y", 3.0: "-x"}[heading]
    measured = _measured(markers, forward=forward)
    np.testing.assert_allclose(measured.theta, _from_rest(), atol=1e-6)
    np.testing.assert_allclose(measured.arc.radius, 0.266, rtol=1e-8)
    assert measured.plane.out_of_plane < 1e-10
    assert measured.notes == ()


def test_the_other_direction_turns_the_sign() -> None:
    markers = _markers()
    np.testing.assert_array_equal(
        _measured(markers, forward="-x").theta, -_measured(markers, forward="x").theta
    )


def test_the_angle_agrees_with_the_dot_product_of_the_projected_vectors() -> None:
    markers = _markers(noise=3e-4)
    measured = _measured(markers)
    middle = (markers.of("BASE1").mean(axis=0) + markers.of("BASE2").mean(axis=0)) / 2.0
    radii = measured.plane.project(markers.of(TOP) - middle) - measured.pivot
    rest = measured.rest_radius
    cosine = radii @ rest / (np.hypot(*radii.T) * np.hypot(*rest))
    away = np.abs(measured.theta) > 0.02
    np.testing.assert_allclose(np.arccos(cosine[away]), np.abs(measured.theta[away]), atol=1e-12)


@pytest.mark.parametrize("share", [0.02, 0.03])
def test_the_share_out_of_the_plane_is_that_of_the_motion(share: float) -> None:
    measured = _measured(_markers(layout=MarkerLayout(sideways=share)))
    assert measured.plane.out_of_plane == pytest.approx(share, rel=0.1)
    np.testing.assert_allclose(measured.theta, _from_rest(), atol=3e-3 * np.max(np.abs(THETA)))
    assert measured.notes == ()


def test_more_than_that_is_noted() -> None:
    markers = _markers(layout=MarkerLayout(sideways=0.08))
    with pytest.raises(RecordError, match=r"plane of motion is uncertain.*or say which axis"):
        _measured(markers)
    measured = measure_angle(markers, top=TOP, base=BASE, forward="x", up="z", rest=(2.5, 3.0))
    (note,) = measured.notes
    assert "not planar: the top leaves the plane by 7.5 %" in note


def test_the_plane_of_the_main_direction_and_up_does_for_a_small_motion() -> None:
    small = synthetic_markers(TIME, THETA / 9.0, random=np.random.default_rng(4))
    with pytest.raises(RecordError, match="plane of motion is uncertain"):
        _measured(small)
    measured = measure_angle(small, top=TOP, base=BASE, forward="x", up="z", origin="middle", rest=(2.5, 3.0))
    away = np.abs(THETA) > np.radians(4.0)
    # The middle of the base lies 25 mm below the pivot.
    ratio = measured.theta[away] @ THETA[away] / (THETA[away] @ THETA[away]) * 9.0
    assert ratio == pytest.approx(0.266 / 0.291, rel=0.01)


def test_the_stated_noise_is_that_of_the_angle() -> None:
    errors, stated = [], []
    for seed in range(40):
        measured = _measured(_markers(noise=3e-4, seed=seed, layout=MarkerLayout(sideways=0.0)))
        quiet = np.abs(THETA) < np.radians(2.0)  # where the scale, which the arc's radius gives, is no matter
        errors.append(np.std(measured.theta[quiet] - THETA[quiet]))
        stated.append(measured.noise)
    # Standard error of the ratio: about 100 samples in each of 40 runs, 1.2 %; three of them.
    assert np.mean(stated) == pytest.approx(np.sqrt(np.mean(np.square(errors))), rel=0.036)


def test_the_radius_is_within_its_standard_error() -> None:
    deviations = []
    for seed in range(60):
        arc = _measured(_markers(noise=3e-4, seed=seed, layout=MarkerLayout(sideways=0.0))).arc
        deviations.append((arc.radius - 0.266) / arc.radius_error)
    assert abs(np.mean(deviations)) < 3.0 / np.sqrt(60)
    assert np.std(deviations) == pytest.approx(1.0, abs=3.0 / np.sqrt(2 * 60))


def test_the_middle_of_the_base_as_the_pivot_scales_the_angle() -> None:
    layout = MarkerLayout(bases=((-0.08, 0.05, -0.03), (0.08, 0.05, -0.03)), sideways=0.0)
    measured = _measured(_markers(layout=layout), origin="middle")
    small = np.abs(THETA) < np.radians(4.0)
    slope = np.polyfit(_from_rest()[small], measured.theta[small], 1)[0]
    assert slope == pytest.approx(0.266 / (0.266 + 0.03), rel=2e-3)


def test_a_base_that_moves_is_followed() -> None:
    markers = _markers(layout=MarkerLayout(sideways=0.0))
    turn = 0.05 * np.sin(2.0 * np.pi * 1.3 * TIME) * (TIME < 2.4)
    shift = 0.02 * np.sin(2.0 * np.pi * 0.9 * TIME) * (TIME < 2.4)
    heading = MarkerLayout().heading
    along, up = np.array([np.cos(heading), np.sin(heading), 0.0]), np.array([0.0, 0.0, 1.0])
    x, z = markers.positions @ along, markers.positions @ up
    cos, sin = np.cos(turn)[:, None], np.sin(turn)[:, None]
    new_x, new_z = cos * x + sin * z + shift[:, None], -sin * x + cos * z
    moved = markers.positions + (new_x - x)[..., None] * along + (new_z - z)[..., None] * up
    shaken = dataclasses.replace(markers, positions=moved)
    moving = _measured(shaken, base_motion="moving")
    np.testing.assert_allclose(moving.theta, _from_rest(), atol=2e-3)
    with pytest.raises(RecordError, match="the pivot is uncertain"):
        _measured(shaken)


def test_a_base_that_moves_a_little_is_noted() -> None:
    markers = _markers()
    slow = 0.002 * np.sin(2.0 * np.pi * 0.4 * TIME)
    shifted = dataclasses.replace(
        markers, positions=markers.positions + slow[:, None, None] * [1.0, 0.0, 0.0]
    )
    assert any("the base moves by 3.9 mm" in note for note in _measured(shifted).notes)


def test_base_markers_across_the_motion_cannot_tell_its_rotation() -> None:
    markers = _markers(layout=MarkerLayout(bases=((0.0, 0.05, -0.03), (0.0, -0.05, -0.03))))
    assert np.isfinite(_measured(markers).theta).all()
    with pytest.raises(RecordError, match=r"only \d\.\d mm apart in the plane of motion"):
        _measured(markers, base_motion="moving")


def test_frames_without_the_top_have_no_angle_and_no_row_in_the_record() -> None:
    positions = _markers().positions.copy()
    positions[20:23, 0] = np.nan
    positions[40, 1] = np.nan
    measured = _measured(dataclasses.replace(_markers(), positions=positions))
    assert np.flatnonzero(np.isnan(measured.theta)).tolist() == [20, 21, 22]
    record = measured.record("trial")
    assert len(record.theta) == 177
    assert 21 not in record.rows
    both = _measured(dataclasses.replace(_markers(), positions=positions), base_motion="moving")
    assert np.flatnonzero(np.isnan(both.theta)).tolist() == [20, 21, 22, 40]


def test_what_cannot_be_measured_is_refused() -> None:
    markers = _markers(noise=3e-4)
    with pytest.raises(RecordError, match=r"is not along the direction called forward.*x, -x, y"):
        _measured(markers, forward="y")
    with pytest.raises(RecordError, match="'up' is not an axis; known are x, -x"):
        _measured(markers, forward="up")
    with pytest.raises(RecordError, match="as markers of the base; name two different ones"):
        measure_angle(markers, top=TOP, base=("BASE1", "BASE1"), forward="x")
    with pytest.raises(RecordError, match="the plane of motion is uncertain"):
        measure_angle(markers, top="BASE1", base=("TOP", "BASE2"), forward="x")
    with pytest.raises(RecordError, match=r"no frame .* between 9 and 10 s, called at rest; .* 0 to 2\.98"):
        measure_angle(markers, top=TOP, base=BASE, forward="x", rest=(9.0, 10.0))
    fixed = synthetic_markers(TIME, np.zeros(180), random=np.random.default_rng(1), noise=0.0)
    with pytest.raises(RecordError, match="the marker does not move"):
        measure_angle(fixed, top=TOP, base=BASE, forward="x")
    lost = markers.positions.copy()
    lost[:, 2] = np.nan
    with pytest.raises(RecordError, match="'BASE2': is never visible"):
        _measured(dataclasses.replace(markers, positions=lost))
    lost = markers.positions.copy()
    lost[5:, 0] = np.nan
    with pytest.raises(RecordError, match="'TOP, BASE1, BASE2': are in sight together in 5 frames"):
        _measured(dataclasses.replace(markers, positions=lost))


def test_a_rest_position_in_motion_is_noted() -> None:
    measured = measure_angle(_markers(), top=TOP, base=BASE, forward="x", rest=(0.5, 0.8))
    assert any("in the rest position" in note for note in measured.notes)


def test_a_measured_radius_makes_the_pivot_certain() -> None:
    """Of ten records: the error of the distance from the pivot to the top, which is that of the scale."""
    errors = []
    for seed in range(10):
        markers = _markers(noise=3e-4, seed=seed)
        for radius in (None, 0.266):
            found = measure_angle(markers, top=TOP, base=BASE, forward="x", rest=(2.5, 3.0), radius=radius)
            errors.append(float(np.hypot(*found.rest_radius)) - 0.266)
    own, given = np.sqrt(np.mean(np.array(errors).reshape(-1, 2) ** 2, axis=0))
    assert own > 1e-3
    assert given < 1e-4


def test_a_wrong_radius_is_noted_and_one_that_cannot_be_is_refused() -> None:
    markers = _markers(noise=3e-4)
    measured = measure_angle(markers, top=TOP, base=BASE, forward="x", rest=(2.5, 3.0), radius=0.300)
    (note,) = measured.notes
    assert "mm, 300.0 mm were given: is it measured from the pivot" in note
    with pytest.raises(ParameterError, match="radius = -1"):
        measure_angle(markers, top=TOP, base=BASE, forward="x", radius=-1.0)


def test_the_rest_may_lie_beside_the_middle() -> None:
    markers = _markers()
    leaning = measure_angle(markers, top=TOP, base=BASE, forward="x", rest=(2.5, 3.0), rest_angle=-0.003)
    np.testing.assert_allclose(leaning.theta, _measured(markers).theta - 0.003, atol=1e-15)


def test_numbers_in_the_notes() -> None:
    """Against what the measurement itself holds, and the scatter of the radius over records."""
    known: dict[str, Any] = {"top": TOP, "base": BASE, "forward": "x", "up": "z"}
    layout = MarkerLayout(sideways=0.0)
    noisy = [_markers(noise=7e-4, seed=seed, layout=layout) for seed in range(20)]
    found = [measure_angle(markers, rest=(2.5, 3.0), **known) for markers in noisy]
    shares = []
    for measured in found:
        (note,) = [note for note in measured.notes if note.startswith("the arc's radius has")]
        match = re.search(r"a standard error of ([\d.]+) %", note)
        assert match
        shares.append(float(match[1]))
    scatter = np.std([measured.arc.radius for measured in found], ddof=1)
    # Twenty records give a standard deviation to 16 %; three of them.
    assert np.mean(shares) == pytest.approx(100.0 * scatter / 0.266, rel=0.5)
    measured = measure_angle(_markers(noise=3e-4), rest=(2.5, 3.0), radius=0.3, **known)
    arc = measured.arc
    assert f"{1e3 * arc.radius:.1f} +- {1e3 * arc.radius_error:.1f} mm, 300.0 mm" in measured.notes[0]
    moving = measure_angle(_markers(), rest=(0.5, 0.8), **known)
    moved = np.degrees(np.ptp(moving.theta[(TIME >= 0.5) & (TIME <= 0.8)]))
    assert any(f"moves by {moved:.2f} degrees in the rest" in note for note in moving.notes)


@pytest.mark.parametrize("side", SIDES)
def test_the_weight_presses_into_the_springs_by_less_than_is_stated(side: Side) -> None:
    found = rest_angle(NOMINAL, side)
    assert np.sign(found) == (1.0 if side == "forward" else -1.0)

    def excess(theta: float) -> float:
        return float(contact_moment(NOMINAL, theta) - gravity_moment(NOMINAL, theta))

    balance = brentq(excess, found, 1.1 * found, xtol=1e-12)
    assert 1.0 < balance / found < 1.004


def test_a_joystick_that_is_let_go_ends_there() -> None:
    run = simulate(NOMINAL, time=np.array([0.0, 3.0, 6.0]), theta_start=np.radians(-20.0))
    side: Side = "forward" if run.theta[-1] > 0.0 else "backward"
    assert run.theta[-1] == pytest.approx(rest_angle(NOMINAL, side), rel=0.01)
