"""The algorithms of Algorithms.mo in plain Python, written from their meaning in Modelica."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

WEIGHTS = (0.1, 0.2, 0.3, 0.4)


def horner(a: Sequence[float], x: float) -> list[float]:
    return [sum(coefficient * x**power for power, coefficient in enumerate(a))]


def interpolate(xs: Sequence[float], ys: Sequence[float], x: float) -> list[float]:
    k = 0
    while k < len(xs) - 2 and x > xs[k + 1]:
        k += 1
    return [ys[k] + (ys[k + 1] - ys[k]) * (x - xs[k]) / (xs[k + 1] - xs[k])]


def polar(x: float, y: float) -> list[float]:
    return [math.hypot(x, y), math.atan2(y, x)]


def nested(x: float) -> list[float]:
    r, phi = polar(x, 2 * x + 1)
    inner = horner([x, phi, r], 0.5)[0]
    return [r * horner([1, 2, 3], phi)[0] + horner([r, x], inner)[0]]


def overwritten(x: float) -> list[float]:
    a, b = polar(x, 1 - x)
    b, a = polar(b, a)
    return [a, b]


def piecewise(x: float) -> list[float]:
    return [min(max(x, -1.0), 1.0), float(-1 <= x <= 1)]


def logic(x: float, b: bool) -> list[float]:
    d = (x > 1 and not b) or x == 0.5
    c = (b or x < 3) if d else (not b and x != 2)
    return [float(c), 1.0 if c and d else x if c else -x]


def divisions(a: int, b: int) -> list[float]:
    quotient = abs(a) // abs(b) * (1 if a * b > 0 else -1)
    return [quotient, a - math.floor(a / b) * b, a - quotient * b, a / b + (a - b) / 7]


def rounding(x: float) -> list[float]:
    return [math.floor(x), math.ceil(x), math.floor(x), x % 0.75, math.fmod(x, 0.75), x]


def elementary(x: float) -> list[float]:
    y = math.sin(x) + math.cos(x) * math.tan(x / 4) + math.exp(-x) + math.log(x + 2) + math.log10(x + 3)
    y += math.sqrt(x + 2) + math.asin(x / 9) + math.acos(x / 9) + math.atan(x) + math.atan2(x, 2)
    y += math.sinh(x / 2) + math.cosh(x / 2) + math.tanh(x) + x**3 + 2**x + min(x, 0.5) * max(x, -0.5)
    return [(y if x > 1 else -y) + abs(x)]


def ratios(x: float) -> list[float]:
    return [x + sum(i / j + i // j + j % i + i**j for i in (1, 2, 3) for j in (1, 3, 5))]


def early_return(x: float) -> list[float]:
    return [2 * x if x > 1 else x * x + 1]


def exchange(x: float) -> list[float]:
    return [2.0, x] if x > 1 else [x, 2.0]


def rotated(x: float) -> list[float]:
    return [2 * x, 3.0, x] if x > 0 else [6 * x, 2 * x, 3.0]


def chain(x: float) -> list[float]:
    if x <= 0.5:
        return [x + 1 - x]
    y, z = x * x + 0.25, 0.25
    z = y + 0.5 * y * z
    y = 0.5 * y * z + y
    return [y - (z * y - x)]


def applied(matrix: Sequence[float], v: Sequence[float]) -> list[float]:
    w = np.reshape(matrix, (2, 3)) @ v
    return [*w, w[0] + 2 * w[1]]


def matrices(v: Sequence[float]) -> list[float]:
    vector = np.array(v)
    a = np.eye(4) + 1.5
    a[1, :] = vector
    a[:, 2] = 2 * vector
    a = a @ a.T
    b = a[:, 1:3]
    y = a @ vector - vector * vector / np.arange(1, 5) + b @ (1, -1)
    for i in (1, 2):
        y[1:3] = y[0:2].copy()
        y[0] += i
    return [*y, vector @ y + b.sum() + a.min() + vector.max() + np.prod(vector[:3])]


def branches(x: float) -> list[float]:
    if x > 1:
        return [7, 10, 10 * x]
    return [3, 2, x] if x > 0.5 else [x, 2, x]


def sums(a: Sequence[float]) -> list[float]:
    b = [a[i] * (i + 1) for i in range(5)]
    y = sum(b) + math.prod(element + 1 for element in a) + max(b[1], b[3])
    y += sum(a[5 - i] / i for i in range(2, 6))
    return [y + sum(2**i * b[i] * WEIGHTS[3 - i] for i in range(4))]


def picked(k: int, a: Sequence[float]) -> list[float]:
    """With an index beyond the bounds of an array, what depends on it is not a number."""
    matrix = [list(a), [4.0, 5.0, 6.0]]
    y = a[k - 1] + WEIGHTS[k - 1] if 1 <= k <= 3 else math.nan
    z = matrix[k - 1][1] + a[k - 1] if 1 <= k <= 2 else math.nan
    b = [0.0 if i == k - 1 else a[i] for i in range(3)] if 1 <= k <= 3 else [math.nan] * 3
    return [y, z, *b]


def geared(gear: int, x: float) -> list[float]:
    return [gear * x]


def moved(x: float, y: float, d: float) -> list[float]:
    return [x + d, y * d**3]


def named(double: float, at: Sequence[float]) -> list[float]:
    return [math.cos(double) * sum(at) + math.tan(math.cos(double))]


def never(x: float, _unused: float) -> list[float]:
    return [x]
