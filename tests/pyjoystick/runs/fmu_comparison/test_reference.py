"""FMUs of the joystick against the reference."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from fmu_build import build_fmu
from pyjoystick.fmu import Interface, UnsupportedFmuError
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.motion import Difference
from pyjoystick.runs import RunComparison, Tolerances, compare_with_reference
from pyjoystick.runs.experiments import COLUMNS
from pyjoystick.support import ParameterError, UnknownParameterError, UnknownVariableError

LAWS = {"Joystick": NOMINAL, "JoystickPowerLaw": NOMINAL_POWER_LAW}


def theta(run: RunComparison) -> Difference:
    (found,) = (one for one in run.differences if one.variable == "theta")
    return found


# Among them the releases with the largest errors that were found in each case.
@pytest.mark.parametrize(
    ("name", "degrees"),
    [
        ("Joystick", (-85.0, -20.0, -0.3, 5.0)),
        ("JoystickPowerLaw", (-20.0, -13.04, -12.51, -0.5, 10.9, 30.0, 85.0)),
    ],
)
def test_the_errors_stay_below_the_limits(name: str, degrees: tuple[float, ...], joystick_fmus: Path) -> None:
    runs = compare_with_reference(joystick_fmus / f"{name}.fmu", LAWS[name], map(math.radians, degrees))
    assert [run.experiment for run in runs] == [f"{one:g} deg" for one in degrees]
    for run in runs:
        assert [one.variable for one in run.differences] == list(COLUMNS)
        assert run.judged == {"theta"}
        assert run.within_limits, theta(run)
        assert theta(run).largest > 0.0


@pytest.mark.parametrize("name", LAWS)
def test_model_exchange_stays_within_a_microradian_at_20_degrees(name: str, joystick_fmus: Path) -> None:
    (run,) = compare_with_reference(
        joystick_fmus / f"{name}.fmu", LAWS[name], [math.radians(-20.0)], interface="ModelExchange"
    )
    assert theta(run).limit == pytest.approx(1e-6, rel=0.05)
    assert run.within_limits


@pytest.mark.parametrize(
    ("name", "interface", "tolerance", "expected"),
    [
        ("Joystick", "CoSimulation", 1e-8, 1.05e-7),
        ("Joystick", "CoSimulation", 1e-6, 1.05e-5),
        ("JoystickPowerLaw", "CoSimulation", 1e-8, 7.0e-7),
        ("Joystick", "ModelExchange", 1e-9, 1.05e-5),
    ],
)
def test_the_limit_goes_with_law_interface_and_tolerance(
    name: str, interface: Interface, tolerance: float, expected: float, joystick_fmus: Path
) -> None:
    (run,) = compare_with_reference(
        joystick_fmus / f"{name}.fmu",
        LAWS[name],
        [math.radians(20.0)],
        duration=0.2,
        interface=interface,
        tolerances=Tolerances(tolerance, tolerance),
    )
    assert theta(run).limit == pytest.approx(expected, rel=0.01)
    assert run.within_limits


@pytest.mark.parametrize("interface", ["CoSimulation", "ModelExchange"])
def test_a_small_mistake_in_a_model_is_found(interface: Interface, off: Path, joystick_fmus: Path) -> None:
    release = [math.radians(-20.0)]
    (run,) = compare_with_reference(off, NOMINAL, release, interface=interface)
    assert not run.within_limits
    assert theta(run).parted_at is not None
    (run,) = compare_with_reference(joystick_fmus / "Joystick.fmu", NOMINAL, release, interface=interface)
    assert run.within_limits


@pytest.fixture(scope="module")
def off(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMU of Off.mo."""
    return build_fmu("Off", tmp_path_factory.mktemp("off"), library=Path(__file__).with_name("Off.mo")).path


def test_limits_are_added_to_that_of_the_angle(joystick_fmus: Path) -> None:
    path = joystick_fmus / "Joystick.fmu"
    (run,) = compare_with_reference(path, NOMINAL, [0.2], duration=0.1, limits={"E": 1e-15})
    assert run.judged == {"theta", "E"}
    assert not run.within_limits
    (run,) = compare_with_reference(path, NOMINAL, [0.2], duration=0.1, limits={"theta": 1e-15})
    assert theta(run).limit == 1e-15
    assert not run.within_limits


def test_what_is_refused(joystick_fmus: Path) -> None:
    with pytest.raises(UnsupportedFmuError, match="does not have the interface of Joystick"):
        compare_with_reference(joystick_fmus / "JoystickInverse.fmu", NOMINAL, [0.2])
    path = joystick_fmus / "Joystick.fmu"
    with pytest.raises(UnknownParameterError, match="no parameter 'damping"):
        compare_with_reference(path, NOMINAL_POWER_LAW, [0.2])
    with pytest.raises(UnknownVariableError, match="no variable 'speed'"):
        compare_with_reference(path, NOMINAL, [0.2], duration=0.1, limits={"speed": 1.0})
    with pytest.raises(ParameterError, match="release_angle"):
        compare_with_reference(path, NOMINAL, [2.0])
