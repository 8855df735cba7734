"""Trial values of parameters that may select other branches."""

from __future__ import annotations

import pytest

from fmu_build.codegen.probes import probe_values


@pytest.mark.parametrize("value", [0.0, 0.5, -300.0])
def test_far_values_are_on_both_sides_and_differ_in_size_from_the_present_one(value: float) -> None:
    far = probe_values(value, 3, ())
    assert min(far) <= value - 10.0 * (1.0 + abs(value))
    assert max(far) >= value + 10.0 * (1.0 + abs(value))


def test_parameters_are_probed_in_different_orders() -> None:
    assert len({tuple(probe_values(1.0, number, ())) for number in range(8)}) == 8


def test_near_values_are_on_both_sides_of_what_is_compared_with() -> None:
    below, above, *_ = probe_values(0.0, 0, (4.0,))
    assert below < 4.0 < above
    assert (round(below), round(above)) == (4, 5)
