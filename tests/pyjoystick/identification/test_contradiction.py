"""A parameter that was both measured and fitted: contradicting values."""

from __future__ import annotations

import pytest

from pyjoystick.identification import combined_uncertainties_apart, contradictions
from pyjoystick.laboratory import Measured

SWING = "swing test swing.csv"


def test_values_that_cannot_both_be_right_are_named_with_what_to_look_at() -> None:
    """A clock that is 0.3 % slow makes J 0.6 % larger."""
    fitted = {"J": Measured(0.0098616, 6.9e-6), "damping.C": Measured(0.038, 3e-5)}
    (found,) = contradictions(fitted, {"J": (Measured(0.0097997, 1.4e-5), SWING)})
    assert found.apart == pytest.approx(6.19e-5 / 1.561e-5, rel=1e-3)
    assert found.sentence == (
        "J = 0.0098616 +- 6.9e-06 of the fit contradicts 0.0097997 +- 1.4e-05 of the swing test swing.csv: "
        "4.0 combined standard uncertainties apart. Check the clock of the records, the scale of their angle "
        "and h"
    )
    assert found.short.startswith("J is 4.0 combined standard uncertainties off the swing test swing.csv")


@pytest.mark.parametrize(
    ("value", "error", "contradicts"),
    [(0.80, 0.01, False), (0.829, 0.01, False), (0.831, 0.01, True), (0.769, 0.01, True), (0.9, 0.0, False)],
)
def test_three_combined_uncertainties_are_a_contradiction_and_no_statement_is_none(
    value: float, error: float, contradicts: bool
) -> None:
    found = list(contradictions({"m": Measured(0.8, 0.0)}, {"m": (Measured(value, error), "balance")}))
    assert bool(found) == contradicts
    assert all(one.sentence.endswith("and the measurement of m") for one in found)


def test_distance_by_the_root_of_both_squares() -> None:
    assert combined_uncertainties_apart(Measured(1.0, 0.3), Measured(2.0, 0.4)) == pytest.approx(2.0)
