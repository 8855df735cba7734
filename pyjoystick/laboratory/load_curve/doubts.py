"""Doubts about the fit of a load-deflection curve, and records that cannot be fitted."""

from __future__ import annotations

from typing import Final

import numpy as np

from pyjoystick.laboratory.load_curve.curve import LoadCurve
from pyjoystick.model import SegmentTable
from pyjoystick.motion import RecordError
from pyjoystick.support import FloatArray

_FIRST_SAMPLES: Final = 3
_CLEAR: Final = 5.0
_LEAST_PART: Final = 0.02
#: Minimum samples per branch and segment; with fewer, linearized standard errors are too small.
_FEWEST_IN_SEGMENT: Final = 3
#: Part of the travel up to contact in which there is surely none.
_BEFORE_CONTACT: Final = 0.8
_LARGEST_ERROR: Final = 0.2
#: A force is saturated if it stays at its largest value for this many samples and this part of the travel.
_FLAT_SAMPLES: Final = 5
_FLAT_TRAVEL: Final = 0.01
_LARGEST_MISFIT: Final = 1.5


def require_contact_within(curve: LoadCurve, force_noise: float) -> None:
    """Reject a record that starts in contact, or in which unloading needs more force than loading.

    Raises:
        RecordError: one of these is true
    """
    loading = curve.loading
    first = float(np.median(loading.force[:_FIRST_SAMPLES]))
    largest = float(np.max(loading.force))
    lowest = float(min(np.min(branch.force) for branch in curve.branches))
    threshold = max(_CLEAR * force_noise, _LEAST_PART * (largest - lowest))
    if abs(first) > threshold and first - lowest > threshold:
        raise _begins_in_contact(curve)
    if curve.unloading is None:
        return
    order = np.argsort(curve.unloading.travel)
    back = np.interp(loading.travel, curve.unloading.travel[order], curve.unloading.force[order])
    between = float(np.median(loading.force - back))
    if between < -threshold:
        raise unloading_above(curve, -between)


def unloading_above(curve: LoadCurve, force: float) -> RecordError:
    """Make the error for an unloading branch that lies above the loading branch by this force (N)."""
    return RecordError(
        curve.source,
        f"unloading lies {force:.3g} N above loading",
        "friction cannot do that: are the rows in the order in which they were recorded?",
        column="force",
    )


def require_no_saturation(curve: LoadCurve) -> None:
    """Reject a force that stays at its largest value while travel goes on, as from a saturated load cell.

    Coarsely resolved forces stay constant everywhere in contact, so the stretch at the top must be twice as
    long as others.

    Raises:
        RecordError: the force is saturated
    """
    loading = curve.loading
    edges = np.flatnonzero(np.diff(loading.force) != 0.0)
    firsts, lasts = np.append(0, edges + 1), np.append(edges, len(loading.force) - 1)
    lengths = loading.travel[lasts] - loading.travel[firsts]
    level, top = loading.force[firsts], float(np.max(loading.force))
    at_top = (level == top) & (lasts - firsts + 1 >= _FLAT_SAMPLES)
    others = lengths[(level > 0.5 * top) & (level < top)]
    usual = float(np.max(others)) if others.size else 0.0
    flat = at_top & (lengths > max(2.0 * usual, _FLAT_TRAVEL * np.ptp(loading.travel)))
    if flat.any():
        i = int(np.flatnonzero(flat)[0])
        raise RecordError(
            curve.source,
            f"the force stays at its largest value from {1e3 * loading.travel[firsts[i]]:.4g} mm on: the "
            "load cell or its amplifier is at the end of its range",
            "record with more range, or end the record before that",
            column="force",
            rows=loading.rows[firsts[i] : lasts[i] + 1].tolist(),
            value=f"{top:.4g} N",
        )


def require_samples_before_contact(curve: LoadCurve, table: SegmentTable) -> None:
    """Reject a fit whose first kink is not within the record.

    Raises:
        RecordError: fewer than three loading samples are before it
    """
    if int(np.sum(curve.loading.travel < table.x[0])) < _FIRST_SAMPLES:
        raise _begins_in_contact(curve)


def _begins_in_contact(curve: LoadCurve) -> RecordError:
    return RecordError(
        curve.source,
        "is in contact from the first rows on, so that the clearance x_0 cannot be determined",
        "begin the record before contact",
        column="force",
        rows=[int(curve.loading.rows[0])],
        value=f"{curve.loading.force[0]:.4g} N",
    )


def doubts(
    curve: LoadCurve,
    table: SegmentTable,
    k_errors: FloatArray,
    misfit: float,
    distances: FloatArray,
) -> tuple[str, ...]:
    """What to check before using the numbers, with rows and a remedy."""
    notes = [*curve.notes]
    loading = curve.loading
    contact = int(np.argmax(loading.travel >= table.x[0]))
    notes.append(
        f"no force up to a travel of {1e3 * table.x[0]:.4g} mm (row {loading.rows[contact]}): this counts as "
        "the clearance x_0; slack of the fixture would be in it, so take that up before travel is set to zero"
    )
    if (drift := _drift(curve, table.x[0])) is not None:
        notes.append(
            f"the force before contact changes by {drift:+.2g} N from loading to unloading: the load cell "
            "drifts, and the friction is off by up to half of that; let it warm up, or record faster"
        )
    ends = [*table.x[1:], float(np.max(loading.travel))]
    for i, (first, last) in enumerate(zip(table.x, ends, strict=True)):
        samples = sum(
            int(np.sum((branch.travel >= first) & (branch.travel < last))) for branch in curve.branches
        )
        if samples < _FEWEST_IN_SEGMENT * len(curve.branches) or k_errors[i] > _LARGEST_ERROR * table.k[i]:
            notes.append(
                f"k_{i} rests on {samples} samples between {1e3 * first:.5g} and {1e3 * last:.5g} mm and is "
                f"uncertain by {100.0 * k_errors[i] / table.k[i]:.2g} %: record there more slowly"
            )
    if misfit > _LARGEST_MISFIT:
        notes.append(_where_it_misses(curve, misfit, distances))
    return tuple(notes)


def _where_it_misses(curve: LoadCurve, misfit: float, distances: FloatArray) -> str:
    """Rows of the stretch with the largest misfit; single outliers do not count."""
    rows = np.concatenate([branch.rows for branch in curve.branches])
    travel = np.concatenate([branch.travel for branch in curve.branches])
    width = max(5, len(rows) // 100)
    smooth = np.abs(np.convolve(distances, np.ones(width) / width, mode="same"))
    worst = int(np.argmax(smooth))
    first, last = max(0, worst - width // 2), min(len(rows) - 1, worst + width // 2)
    return (
        f"the segments miss the record by {misfit:.2g} times its noise, most in rows {rows[first]}-"
        f"{rows[last]} (travel about {1e3 * travel[worst]:.4g} mm): look "
        "there for slack, sliding or one more segment"
    )


def _drift(curve: LoadCurve, contact: float) -> float | None:
    """Change of the force before contact from loading to unloading (N), if it stands out from the noise."""
    if curve.unloading is None:
        return None
    first, last = (branch.force[branch.travel < _BEFORE_CONTACT * contact] for branch in curve.branches)
    if min(len(first), len(last)) < _FIRST_SAMPLES:
        return None
    error = float(np.sqrt(first.var(ddof=1) / len(first) + last.var(ddof=1) / len(last)))
    change = float(last.mean() - first.mean())
    return change if abs(change) > _CLEAR * error and error > 0.0 else None
