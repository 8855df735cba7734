"""Runs that end early: terminate(), assert(), and models that cannot continue."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from fmpy import read_model_description, simulate_fmu
from fmpy.fmi1 import FMICallException

from tests.shared_fmus import SharedFmus

MODELS = Path(__file__).parent
FAILING = MODELS / "failing" / "Failing.mo"
STATE_EVENTS = MODELS / "StateEvents.mo"
TYPES = ("CoSimulation", "ModelExchange")


class Run:
    """One run, with the messages that the FMU logged."""

    def __init__(self, model: str, library: Path, shared_fmus: SharedFmus) -> None:
        self.folder = shared_fmus.unpacked(model, library)
        self.messages: list[str] = []
        self.description = read_model_description(self.folder)

    def __call__(
        self, fmi_type: str, stop_time: float = 1.5, output: list[str] | None = None, **start_values: float
    ) -> Any:
        return simulate_fmu(
            self.folder,
            model_description=self.description,
            fmi_type=fmi_type,
            stop_time=stop_time,
            output_interval=0.01,
            relative_tolerance=1e-8,
            start_values=start_values,
            output=output,
            logger=lambda _, __, ___, ____, message: self.messages.append(message.decode()),
        )


@pytest.mark.parametrize("fmi_type", TYPES)
def test_terminate_ends_the_run(fmi_type: str, shared_fmus: SharedFmus) -> None:
    run = Run("StateEvents.Stopping", STATE_EVENTS, shared_fmus)
    result = run(fmi_type)
    assert result["time"][-1] == pytest.approx(1.0, abs=0.0101)
    assert any("the body has reached the ground" in message for message in run.messages), run.messages


@pytest.mark.parametrize("fmi_type", TYPES)
def test_an_assertion_stops_the_run_with_its_message(fmi_type: str, shared_fmus: SharedFmus) -> None:
    run = Run("StateEvents.Asserting", STATE_EVENTS, shared_fmus)
    with pytest.raises(FMICallException):
        run(fmi_type, limit=0.5)
    assert any("x has passed its limit" in message for message in run.messages), run.messages


@pytest.mark.parametrize("fmi_type", TYPES)
def test_an_assertion_of_level_warning_only_warns(fmi_type: str, shared_fmus: SharedFmus) -> None:
    run = Run("StateEvents.Asserting", STATE_EVENTS, shared_fmus)
    result = run(fmi_type, warn=0.5)
    assert result["time"][-1] == pytest.approx(1.5)
    assert any("x is large" in message for message in run.messages), run.messages


def test_nothing_is_said_where_all_is_well(shared_fmus: SharedFmus) -> None:
    run = Run("StateEvents.Asserting", STATE_EVENTS, shared_fmus)
    run("CoSimulation")
    assert run.messages == []


@pytest.mark.parametrize("fmi_type", TYPES)
@pytest.mark.parametrize(
    ("model", "message"),
    [
        ("SingularLoop", "singular Jacobian: the equations do not determine `z`, `y`"),
        ("EitherSign", "singular Jacobian: the equations do not determine `z`"),
        ("EitherSide", "the algebraic loop of `z` could not be solved: residual or Jacobian not finite"),
        ("NearlySingularLoop", "the algebraic loop of `z`, `y` could not be solved: singular Jacobian"),
        ("NoSolution", "the algebraic loop of `x` could not be solved: "),
        ("ImpossibleStart", "At time 0: the initial equations of `x` could not be solved: "),
        ("TwoStarts", "At time 0: the initial equations of `p`, `q` could not be solved: singular Jacobian"),
        ("EndlessEvents", "event iteration does not end"),
        ("Paradox", "the discrete equations do not settle: relations or discrete variables change"),
        ("OutOfBounds", "index"),
    ],
)
def test_a_model_that_cannot_go_on_says_why(
    model: str, message: str, fmi_type: str, shared_fmus: SharedFmus
) -> None:
    run = Run(f"Failing.{model}", FAILING, shared_fmus)
    with pytest.raises(FMICallException):
        run(fmi_type)
    assert any(message in logged for logged in run.messages), run.messages


@pytest.mark.parametrize(
    ("model", "expected"),
    [
        ("NotFinite", "level, der(v), der(w)."),
        ("NotFiniteFromTheStart", "time 0: the derivatives are not finite: der(x)."),
    ],
)
def test_derivatives_that_are_not_finite_are_named(
    model: str, expected: str, shared_fmus: SharedFmus
) -> None:
    run = Run(f"Failing.{model}", FAILING, shared_fmus)
    with pytest.raises(FMICallException):
        run("CoSimulation")
    assert run.messages[-1].endswith(expected), run.messages


@pytest.mark.parametrize("fmi_type", TYPES)
def test_a_loop_that_a_parameter_makes_singular_names_what_it_leaves_open(
    fmi_type: str, shared_fmus: SharedFmus
) -> None:
    run = Run("Failing.NoCapacitance", FAILING, shared_fmus)
    run(fmi_type, stop_time=0.1)
    with pytest.raises(FMICallException):
        run(fmi_type, C=0.0)
    message = "`i`, `der(v)`, `der(u)` could not be solved: singular Jacobian: the equations do not determine"
    assert any(f"{message} `der(v)`" in logged for logged in run.messages), run.messages


@pytest.mark.parametrize("fmi_type", TYPES)
@pytest.mark.parametrize("name", ["k", "l"])
def test_an_integer_beyond_32_bits_is_an_error(name: str, fmi_type: str, shared_fmus: SharedFmus) -> None:
    run = Run("Failing.HugeInteger", FAILING, shared_fmus)
    assert run(fmi_type, output=[name], n=46340)[name][-1] == (46340**2 if name == "k" else -(46340**2))
    assert run.messages == []
    with pytest.raises(FMICallException):
        run(fmi_type, output=[name])
    sign = "" if name == "k" else "-"
    expected = (
        f"{name} is {sign}{46341**2}, outside of the range of 32-bit integers, -2147483648 to 2147483647"
    )
    assert any(f"At time 0.5 {expected}" in logged for logged in run.messages), run.messages


@pytest.mark.parametrize(
    ("model", "message"), [("Chattering", "events at practically the same time"), ("Pole", "smallest step")]
)
def test_co_simulation_gives_up_with_a_reason(model: str, message: str, shared_fmus: SharedFmus) -> None:
    run = Run(f"Failing.{model}", FAILING, shared_fmus)
    with pytest.raises(FMICallException):
        run("CoSimulation")
    assert any(message in logged for logged in run.messages), run.messages
