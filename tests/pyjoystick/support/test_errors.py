from __future__ import annotations

import pickle

import pytest

from pyjoystick.support import (
    ParameterError,
    PyJoystickError,
    SeriesError,
    SimulationError,
    UnknownParameterError,
)

EXAMPLES = [
    ParameterError("J", -1.0, "a finite number above 0 kg.m2", "a hint"),
    UnknownParameterError("J0", ["J", "m"]),
    SimulationError(0.25, "the angle has reached pi/2"),
    SeriesError("value", "is nan at index 3; must be finite"),
]


@pytest.mark.parametrize("error", EXAMPLES, ids=lambda error: type(error).__name__)
def test_every_error_is_ours_and_survives_pickling(error: PyJoystickError) -> None:
    copy = pickle.loads(pickle.dumps(error))
    assert isinstance(copy, PyJoystickError)
    assert str(copy) == str(error)
    assert vars(copy) == vars(error)


def test_a_parameter_error_names_field_value_range_and_hint() -> None:
    assert str(EXAMPLES[0]) == "J = -1.0: must be a finite number above 0 kg.m2 (a hint)"


def test_a_parameter_error_can_be_named_inside_a_structure() -> None:
    inner = ParameterError("k_s", 0.0, "above 0", "hint")
    assert (
        str(inner.within("forward.returnSpring")) == "forward.returnSpring.k_s = 0.0: must be above 0 (hint)"
    )


def test_an_unknown_name_gets_the_nearest_known_ones_or_all() -> None:
    known = ["damping.C", "forward.returnSpring.k_s"]
    assert str(UnknownParameterError("damping.D", known)).endswith("did you mean damping.C?")
    assert str(UnknownParameterError("zzz", known)).endswith("known are damping.C, forward.returnSpring.k_s")


def test_of_many_known_names_a_few_are_listed_and_where_the_others_are() -> None:
    known = [f"name{i}" for i in range(90)]
    message = str(UnknownParameterError("zzz", known))
    assert message.endswith(
        "; known are name0, name1, name2, name3, name4 and 85 more "
        "(those of an FMU: `pyjoystick info FMU --all`)"
    )
    assert str(UnknownParameterError("zzz", known[:12])).endswith(", name10, name11")


def test_a_simulation_error_names_the_time() -> None:
    assert str(EXAMPLES[2]) == "the run stopped at t = 0.25 s: the angle has reached pi/2"
