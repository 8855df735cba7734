from __future__ import annotations

import pickle
from pathlib import Path

import pytest

from pyjoystick.fmu import FmuRunError
from pyjoystick.identification import DampingEstimateError, FitInterruptedError
from pyjoystick.motion import RecordError
from pyjoystick.runs import ChangedSweepError, ClusterError
from pyjoystick.support import (
    MissingPackageError,
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
    FmuRunError(0.5, "fmi2DoStep failed", Path("a.fmu"), ("too steep.",)),
    RecordError("a.csv", "is bad", "mend it", column="theta", rows=iter([3, 4]), value="x"),
    ChangedSweepError(Path("a.csv"), ("m was 1 and is 2",)),
    ClusterError("tcp://host:8786", "was lost"),
    MissingPackageError("Parquet files", "parquet"),
    DampingEstimateError("too few peaks"),
    FitInterruptedError(),
]


@pytest.mark.parametrize("error", EXAMPLES, ids=lambda error: type(error).__name__)
def test_every_error_is_ours_and_survives_pickling(error: PyJoystickError) -> None:
    copy = pickle.loads(pickle.dumps(error))
    assert type(copy) is type(error)
    assert isinstance(copy, PyJoystickError)
    assert str(copy) == str(error) != ""
    assert (vars(copy), copy.args) == (vars(error), error.args)


def test_the_arguments_of_an_error_are_its_fields() -> None:
    assert SimulationError(0.25, reason="why").args == (0.25, "why")
    assert UnknownParameterError("J0", iter(["J", "m"])).args == ("J0", ("J", "m"), "parameter")
    assert DampingEstimateError("too few peaks").args == ("too few peaks",)


def test_errors_are_compared_by_identity() -> None:
    assert SimulationError(0.25, "why") != SimulationError(0.25, "why")
    assert len({*EXAMPLES, *EXAMPLES}) == len(EXAMPLES)


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


def test_a_name_that_is_no_text_is_told_too() -> None:
    assert "there is no parameter 1" in str(UnknownParameterError(1, ("a", "b")))  # type: ignore[arg-type]
