"""Fit of connected straight segments with unknown kinks to a load-deflection curve.

The search is SciPy's; no library of piecewise regression fits this task. pwlf 2.7 finds the kinks of a
synthetic curve (stiffnesses 400-fold apart, kinks 10 um apart), but needs 50 s where this fit needs about
one, assigns all error to the force, and can neither keep the first segment at no force nor share the kinks of
two branches. Error of travel is what matters: at 1 MN/m, a micrometer is a newton. Distances are therefore
measured to the line itself, in the plane scaled by the noise of both axes.
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass
from typing import Final

import numpy as np
from scipy.optimize import least_squares

from pyjoystick.laboratory.load_curve.curve import Branch, LoadCurve
from pyjoystick.laboratory.load_curve.doubts import (
    doubts,
    require_contact_within,
    require_no_saturation,
    require_samples_before_contact,
    unloading_above,
)
from pyjoystick.laboratory.load_curve.polyline import corners, signed_distances
from pyjoystick.model import ActuatorAssembly, SegmentTable
from pyjoystick.motion import RecordError
from pyjoystick.support import Drawn, FloatArray, ParameterError, positive

#: Minimum noise relative to the range, for records without noise.
#: A friction so many standard errors below zero is none.
_CERTAIN: Final = 5.0
_LEAST_NOISE: Final = 1e-6
#: Number of segments of an actuator with two springs (Fig. 7c).
_SEGMENTS: Final = 4
_MEDIAN_TO_DEVIATION: Final = 1.4826


@dataclass(frozen=True, slots=True, eq=False)
class LoadCurveFit(Drawn):
    """The fit of a load-deflection curve.

    Attributes:
        curve: the record
        table: travels x_i (m) and stiffnesses k_i (N/m) of the segments, as in Table 1
        friction: half the force between loading and unloading (N); 0 if only one was recorded
        zero: force reading without load (N)
        covariance: covariance of x_0 .. x_n-1, k_0 .. k_n-1, friction, zero, in SI units, shape (2n+2, 2n+2)
        travel_noise, force_noise: standard deviations of one sample (m, N)
        misfit: root mean square of the distances in units of the noise; 1 if the model is right
        notes: doubts, one sentence each
    """

    _shown_by = "pyjoystick.laboratory.load_curve.notebook"

    curve: LoadCurve
    table: SegmentTable
    friction: float
    zero: float
    covariance: FloatArray
    travel_noise: float
    force_noise: float
    misfit: float
    notes: tuple[str, ...]

    @property
    def x_errors(self) -> FloatArray:
        """Standard errors of the travels (m), shape (n,)."""
        return np.sqrt(np.diag(self.covariance))[: len(self.table.x)]

    @property
    def k_errors(self) -> FloatArray:
        """Standard errors of the stiffnesses (N/m), shape (n,)."""
        count = len(self.table.x)
        return np.sqrt(np.diag(self.covariance))[count : 2 * count]

    @property
    def friction_error(self) -> float:
        """Standard error of the friction (N)."""
        return float(np.sqrt(self.covariance[-2, -2]))

    @property
    def has_springs(self) -> bool:
        """Whether it has the four segments of the two springs of one side."""
        return len(self.table.x) == _SEGMENTS

    @property
    def assembly(self) -> ActuatorAssembly:
        """The return and the balance spring.

        Raises:
            ParameterError: not four segments
            RecordError: stiffnesses that no pair of restrained springs has
        """
        try:
            return ActuatorAssembly.from_table(self.table.x, self.table.k)
        except ParameterError as error:
            if not self.has_springs:
                raise
            reason = f"its four segments are not those of two preloaded springs: {error}"
            advice = (
                "does the record end before the second spring, or show fewer kinks? Fit those with --segments"
                " 2, or record the whole travel"
            )
            raise RecordError(self.curve.source, reason, advice, column="force") from error

    def springs(self) -> dict[str, tuple[float, float]]:
        """Value and standard error by name: ``returnSpring.k_s``, ``.k_h``, ``.F_0``, ``.x_0``, and so on.

        The errors are propagated from those of x and k, with their correlation, to first order.

        Raises:
            ParameterError, RecordError: as `assembly`
        """
        assembly = self.assembly
        x, k = np.array(self.table.x), np.array(self.table.k)
        row = np.eye(8)
        gap_1, gap_2 = x[1] - x[0], x[3] - x[2]
        slopes = {
            "returnSpring.k_s": row[5],
            "returnSpring.k_h": row[4] - row[5],
            "returnSpring.F_0": gap_1 * (row[4] - row[5]) + (k[0] - k[1]) * (row[1] - row[0]),
            "returnSpring.x_0": row[0],
            "balanceSpring.k_s": row[7] - row[5],
            "balanceSpring.k_h": row[6] - row[7],
            "balanceSpring.F_0": gap_2 * (row[6] - row[7]) + (k[2] - k[3]) * (row[3] - row[2]),
            "balanceSpring.x_0": row[2],
        }
        values = {"returnSpring": assembly.return_spring, "balanceSpring": assembly.balance_spring}
        found = {}
        for name, slope in slopes.items():
            spring, field = name.split(".")
            error = float(np.sqrt(slope @ self.covariance[:8, :8] @ slope))
            found[name] = (float(getattr(values[spring], field)), error)
        return found


def fit_load_curve(
    curve: LoadCurve,
    segments: int = _SEGMENTS,
    *,
    travel_noise: float | None = None,
    force_noise: float | None = None,
) -> LoadCurveFit:
    """Fit straight segments: no force up to x_0, then stiffness k_i from x_i to x_i+1.

    Both branches have the same kinks and stiffnesses; friction adds a constant force during loading
    and subtracts it during unloading. The force reading before contact is fitted too.

    Args:
        curve: the record, which must start before contact
        segments: number of segments under load; four for an actuator (Fig. 7c)
        travel_noise: standard deviation of one sample of travel (m); by default from the scatter
        force_noise: standard deviation of one sample of force (N); by default from the scatter

    Raises:
        ParameterError: no segment, or a noise that is not above 0
        RecordError: the record starts in contact, unloading is above loading, the force is flat at its
            largest value, or there are too few samples
    """
    if segments < 1:
        positive("segments", 0)
    noise = np.array(
        [
            _noise(curve, "travel") if travel_noise is None else positive("travel_noise", travel_noise, "m"),
            _noise(curve, "force") if force_noise is None else positive("force_noise", force_noise, "N"),
        ]
    )
    if len(curve.loading.rows) < 5 * (segments + 1):
        reason = f"has {len(curve.loading.rows)} samples of loading for {segments} segments"
        raise RecordError(curve.source, reason, "record more slowly or more often")
    require_contact_within(curve, noise[1])
    require_no_saturation(curve)
    model = _Model(curve, segments, noise)
    solution = least_squares(model.residuals, model.start(), method="trf", x_scale="jac", max_nfev=300)
    if not solution.success:
        raise RecordError(curve.source, f"{segments} segments do not fit", "try another number of segments")
    # Segments without stiffness, or beyond the record, have no covariance, which is checked next.
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
        natural = model.natural(solution.x)
        distances = model.distances(natural)
        freedom = len(distances) - len(natural) + (curve.unloading is None)
        misfit = float(np.sqrt(np.sum(distances**2) / freedom))
        covariance = _covariance(model, natural) * max(misfit, 1.0) ** 2
    x, k, friction, zero = model.parted(natural)
    if not ((np.diag(covariance) >= 0.0).all() and (k > 0.0).all()):
        reason = f"does not determine {segments} segments"
        advice = "try fewer, such as --segments 2 where the record ends before the second spring"
        raise RecordError(curve.source, reason, advice)
    table = SegmentTable(tuple(np.maximum(x, 0.0)), tuple(k))
    require_samples_before_contact(curve, table)
    scale = np.concatenate(
        (np.full(segments, noise[0]), np.full(segments, noise[1] / noise[0]), [noise[1]] * 2)
    )
    covariance = covariance * np.outer(scale, scale)
    if friction < -_CERTAIN * float(np.sqrt(covariance[-2, -2])):
        raise unloading_above(curve, -2.0 * friction)
    k_errors = np.sqrt(np.diag(covariance))[segments : 2 * segments]
    return LoadCurveFit(
        curve=curve,
        table=table,
        friction=friction,
        zero=zero,
        covariance=covariance,
        travel_noise=float(noise[0]),
        force_noise=float(noise[1]),
        misfit=misfit,
        notes=doubts(curve, table, k_errors, misfit, distances),
    )


def _noise(curve: LoadCurve, name: str) -> float:
    """Standard deviation of one sample, from second differences, which steady motion does not affect."""
    series = [getattr(branch, name) for branch in curve.branches]
    second = np.abs(np.concatenate([np.diff(values, 2) for values in series]))
    reach = max(float(np.ptp(values)) for values in series)
    # A second difference has six times the variance of one sample.
    return max(_MEDIAN_TO_DEVIATION * float(np.median(second)) / math.sqrt(6.0), _LEAST_NOISE * reach)


class _Model:
    """The lines of both branches in the plane scaled by the noise.

    The search runs over x_0, the logarithms of the gaps between kinks and of the stiffnesses, the friction
    (with two branches) and the zero of the force, so that no step can change their order.
    """

    def __init__(self, curve: LoadCurve, segments: int, noise: FloatArray) -> None:
        self.segments = segments
        self.noise = noise
        self.points = [_points(branch) / noise for branch in curve.branches]

    def start(self) -> FloatArray:
        loading = self.points[0]
        found = loading[corners(loading, self.segments)]
        ends = np.vstack((found, loading[-1]))
        gaps = np.maximum(np.diff(ends[:, 0]), 1e-3)
        stiffnesses = np.maximum(np.diff(ends[:, 1]) / gaps, 1e-6)
        before = loading[:, 1][loading[:, 0] < found[0, 0]]
        zero = float(np.median(before)) if before.size else 0.0
        friction = [1.0] if len(self.points) > 1 else []
        return np.concatenate(([found[0, 0]], np.log(gaps[:-1]), np.log(stiffnesses), friction, [zero]))

    def natural(self, q: FloatArray) -> FloatArray:
        """Parameters x_0 .. x_n-1, k_0 .. k_n-1, friction, zero, all in units of the noise."""
        n = self.segments
        x = q[0] + np.concatenate(([0.0], np.cumsum(np.exp(q[1:n]))))
        friction = q[2 * n] if len(self.points) > 1 else 0.0
        return np.concatenate((x, np.exp(q[n : 2 * n]), [friction, q[-1]]))

    def parted(self, natural: FloatArray) -> tuple[FloatArray, FloatArray, float, float]:
        """Convert to x (m), k (N/m), friction (N), zero (N)."""
        n = self.segments
        x, k = natural[:n] * self.noise[0], natural[n : 2 * n] * self.noise[1] / self.noise[0]
        return x, k, float(natural[-2] * self.noise[1]), float(natural[-1] * self.noise[1])

    def residuals(self, q: FloatArray) -> FloatArray:
        # A step of the search may overflow; results that are not finite make it take a shorter one.
        with np.errstate(over="ignore", invalid="ignore", divide="ignore"):
            return self.distances(self.natural(q))

    def distances(self, natural: FloatArray) -> FloatArray:
        signs = (1.0, -1.0)[: len(self.points)]
        lines = [self._line(natural, sign, points) for sign, points in zip(signs, self.points, strict=True)]
        return np.concatenate(
            [signed_distances(points, line) for points, line in zip(self.points, lines, strict=True)]
        )

    def _line(self, natural: FloatArray, sign: float, points: FloatArray) -> FloatArray:
        """Corners of one branch; friction is a step at contact in loading, the last force in unloading."""
        n = self.segments
        x, k, friction, zero = natural[:n], natural[n : 2 * n], natural[-2], natural[-1]
        end = max(float(np.max(points[:, 0])), float(x[-1]) + 1.0)
        forces = np.concatenate(([0.0], np.cumsum(k * np.diff(np.append(x, end)))))
        start = min(float(np.min(points[:, 0])), float(x[0]) - 1.0)
        loaded = np.column_stack((np.append(x, end), forces + sign * friction))
        contact = x[0] if sign > 0.0 else x[0] + max(friction, 0.0) / k[0]
        free = [[start, 0.0], [contact, 0.0]]
        line = np.vstack((free, loaded if sign > 0.0 else loaded[1:]))
        line[:, 1] += zero
        return line


def _points(branch: Branch) -> FloatArray:
    return np.column_stack((branch.travel, branch.force))


def _covariance(model: _Model, natural: FloatArray) -> FloatArray:
    """Covariance of the natural parameters for distances of unit variance; omits friction if not fitted.

    NaN, or negative variances, if the distances do not determine the parameters.
    """
    fitted = np.ones(len(natural), dtype=bool)
    fitted[-2] = len(model.points) > 1
    slopes = []
    for i in np.flatnonzero(fitted):
        step = np.zeros(len(natural))
        step[i] = 1e-4 * max(abs(natural[i]), 1.0) if i >= model.segments else 1e-3
        slopes.append((model.distances(natural + step) - model.distances(natural - step)) / (2.0 * step[i]))
    jacobian = np.column_stack(slopes)
    covariance = np.zeros((len(natural), len(natural)))
    # Columns differ by orders of magnitude, which the pseudo-inverse must not mistake for rank deficiency.
    norms = np.linalg.norm(jacobian, axis=0)
    norms[norms == 0.0] = np.nan
    scaled = jacobian / norms
    with suppress(np.linalg.LinAlgError):
        covariance[np.ix_(fitted, fitted)] = np.linalg.inv(scaled.T @ scaled) / np.outer(norms, norms)
        return covariance
    return np.full_like(covariance, np.nan)
