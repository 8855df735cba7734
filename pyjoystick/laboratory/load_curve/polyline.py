"""Distances of points from a polyline, in a plane scaled by the noise of its axes."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from pyjoystick.support import FloatArray


def signed_distances(points: FloatArray, vertices: FloatArray) -> FloatArray:
    """Signed distance of each point from the nearest segment, positive to the left of the line.

    Args:
        points: shape (n, 2)
        vertices: corners of the line in order, shape (m, 2); segments of zero length are ignored

    Returns:
        shape (n,)
    """
    starts, steps = vertices[:-1], np.diff(vertices, axis=0)
    lengths = np.hypot(steps[:, 0], steps[:, 1])
    kept = lengths > 0.0
    starts, lengths = starts[kept], lengths[kept]
    along = steps[kept] / lengths[:, None]
    from_start = points[:, None, :] - starts[None, :, :]
    position = np.clip(np.einsum("nmi,mi->nm", from_start, along), 0.0, lengths)
    away = from_start - position[:, :, None] * along
    squared = np.einsum("nmi,nmi->nm", away, away)
    nearest = np.argmin(squared, axis=1)
    index = np.arange(len(points))
    left = along[nearest, 0] * away[index, nearest, 1] - along[nearest, 1] * away[index, nearest, 0]
    return np.asarray(np.copysign(np.sqrt(squared[index, nearest]), left))


def corners(points: FloatArray, count: int) -> list[int]:
    """Indices of the `count` inner points at which a polyline best bends.

    The point farthest from the line so far becomes its next corner (Ramer, Douglas and Peucker).

    Args:
        points: shape (n, 2), in order along the line
        count: number of corners, below n - 2
    """
    chosen = [0, len(points) - 1]
    while len(chosen) < count + 2:
        distances = np.zeros(len(points))
        for first, last in pairwise(chosen):
            inner = points[first : last + 1]
            distances[first : last + 1] = np.abs(signed_distances(inner, points[[first, last]]))
        distances[chosen] = -1.0
        chosen = sorted([*chosen, int(np.argmax(distances))])
    return chosen[1:-1]
