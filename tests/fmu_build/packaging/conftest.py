"""A hand-written model, so that packaging tests need no Modelica compiler."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build.support.description import EnumerationType, GeneratedModel, ModelDescription, Unknown, Variable
from fmu_build.support.request import BuildRequest

_MODE = EnumerationType("Test.Mode", (("Slow", "Takes its time"), ("Fast", "")))


def _oscillator() -> ModelDescription:
    variables = (
        Variable("time", "Real", "independent", "continuous", None, None, unit="s"),
        Variable(
            "x",
            "Real",
            "output",
            "continuous",
            "exact",
            0.1,
            "Displacement",
            "m",
            "mm",
            "Length",
            nominal=0.1,
        ),
        Variable("v", "Real", "local", "continuous", "exact", 0.0, unit="m/s"),
        Variable("der(x)", "Real", "local", "continuous", "calculated", None, unit="m/s", derivative_of=1),
        Variable("der(v)", "Real", "local", "continuous", "calculated", None, unit="m/s2", derivative_of=2),
        Variable("k", "Real", "parameter", "tunable", "exact", 4.0, "Stiffness <&>", "N/m", minimum=0.0),
        Variable("m", "Real", "parameter", "tunable", "exact", 1.0, "Mass", "kg", minimum=1e-6),
        Variable("F", "Real", "input", "continuous", None, 0.0, "Force", "N"),
        Variable("E", "Real", "output", "continuous", "calculated", None, "Energy", "J"),
        Variable("mode", "Enumeration", "parameter", "fixed", "exact", 2, enumeration=_MODE),
        Variable("n", "Integer", "parameter", "fixed", "exact", 3, "Count"),
        Variable("flag", "Boolean", "parameter", "fixed", "exact", True, "Switch"),
    )
    return ModelDescription(
        model_name="Test.Oscillator",
        description="A mass on a spring",
        variables=variables,
        outputs=(Unknown(1, (1,), ("constant",)), Unknown(8, (1, 2), ("dependent", "dependent"))),
        derivatives=(Unknown(3, (2,), ("constant",)), Unknown(4, (1, 7), ("tunable", "tunable"))),
        initial_unknowns=(
            Unknown(3, (2,), ("constant",)),
            Unknown(4, (1, 5, 6, 7), ("dependent",) * 4),
            Unknown(8, (1, 2, 5, 6), ("dependent",) * 4),
        ),
        event_indicators=(),
        documentation='<html><p>Swings. See <a href="modelica://Test.Other">the other</a>.</p></html>',
    )


@pytest.fixture
def description() -> ModelDescription:
    """The oscillator's description."""
    return _oscillator()


@pytest.fixture(scope="session")
def generated() -> GeneratedModel:
    """The oscillator as a backend would generate it."""
    source = Path(__file__).with_name("oscillator.c").read_text("utf-8")
    return GeneratedModel(_oscillator(), source)


@pytest.fixture
def request_in(tmp_path: Path) -> BuildRequest:
    """A request that puts the oscillator into the test's own folder."""
    return BuildRequest(model="Test.Oscillator", output=tmp_path / "out")
