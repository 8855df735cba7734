"""Decoding of stored values of every type."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from pyjoystick.fmu.interface import c_interface
from pyjoystick.fmu.stepping.decoding import decode
from pyjoystick.fmu.stepping.program import Group

TYPES = {
    name: stored for name, stored in c_interface("3.0").types.items() if name not in ("String", "Enumeration")
}


@pytest.mark.parametrize("name", TYPES)
def test_numbers_of_each_type(name: str) -> None:
    stored = TYPES[name]
    random = np.random.default_rng(7)
    rows: np.ndarray[Any, Any] = np.frombuffer(
        random.bytes(12 * 3 * stored.dtype.itemsize), stored.dtype
    ).copy()
    if stored.dtype.kind in "iu":
        limits = np.iinfo(stored.dtype)
        rows[:3] = limits.min, limits.max, limits.max // 3
        if stored.dtype.kind == "i":
            rows[3] = -1
    else:
        rows[:] = random.normal(size=36)
    if name == "Boolean":
        rows[:4] = 0, 1, 255, 0
    stride = 8 + 3 * stored.dtype.itemsize + (-3 * stored.dtype.itemsize) % 8
    raw = np.full((12, stride), 0xAA, dtype=np.uint8)
    raw[:, 8 : 8 + 3 * stored.dtype.itemsize] = rows.view(np.uint8).reshape(12, -1)
    samples = np.full((12, 4), -7.0)
    decode([Group(0, 0, 3, 8, stored.kind)], [2, 0, 1], raw.ravel(), stride, samples)
    expected = rows.reshape(12, 3).astype(np.float64)
    np.testing.assert_array_equal(samples[:, [2, 0, 1]], expected != 0.0 if name == "Boolean" else expected)
    assert (samples[:, 3] == -7.0).all()
