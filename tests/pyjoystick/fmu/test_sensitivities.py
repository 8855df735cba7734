"""Sensitivities from FMUs built for them, against variational equations derived by hand."""

from __future__ import annotations

import pickle
import shutil
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu, UnsupportedFmuError
from pyjoystick.model import NOMINAL
from pyjoystick.support import UnknownParameterError, UnknownVariableError
from tests.joystick_fmu.variational import Joystick
from tests.pyjoystick.fmu.doctored import doctored

TIME = np.linspace(0.0, 0.5, 51)
BY = ("damping.C", "J", "theta_start")
RELEASE = -0.3


@pytest.fixture
def beside(joystick_fmus: Path, tmp_path: Path) -> Path:
    """A folder with the plain joystick, and another with sensitivities in the folder beside it."""
    for name in ("Joystick.fmu", "sensitivities/Joystick.fmu"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        shutil.copy(joystick_fmus / name, tmp_path / name)
    return tmp_path


def test_those_of_a_release_by_hand(beside: Path) -> None:
    """At the tolerance of 1e-10 the error is about 1e-8 of the largest value (docs/sensitivities.md)."""
    with Fmu(beside / "Joystick.fmu") as fmu:
        found = fmu.sensitivities(
            TIME, by=BY, outputs=("theta", "omega"), parameters={"theta_start": RELEASE}, tolerance=1e-10
        )
    expected, events = Joystick(NOMINAL.to_names(), BY).motion(TIME, RELEASE)
    assert events > 10
    names = [f"sensitivity.{one}.{by}" for one in ("theta", "omega") for by in BY]
    assert list(found) == names
    assert found.attrs["units"]["sensitivity.theta.J"] == "rad/(kg.m2)"
    for name, row in zip(names, (2, 4, 6, 3, 5, 7), strict=True):
        error = np.abs(found[name].to_numpy() - expected[row])
        assert np.max(error) < 1e-6 * np.max(np.abs(expected[row])), name


def test_batches_give_the_same(beside: Path) -> None:
    names = [f"sensitivity.theta.{name}" for name in BY]
    angles = [RELEASE, 0.2]
    with Fmu(beside / "Joystick.fmu") as fmu:
        assert fmu.sensitive is fmu.sensitive
        plan = pickle.loads(pickle.dumps(fmu)).sensitive.plan(TIME, varied=["theta_start"], outputs=names)
        found = plan.run_batch(np.array(angles)[:, None]).values
        for angle, run in zip(angles, found, strict=True):
            table = fmu.sensitivities(TIME, by=BY, outputs=["theta"], parameters={"theta_start": angle})
            np.testing.assert_array_equal(run, table.to_numpy())


def test_an_fmu_that_has_them_itself(beside: Path) -> None:
    with Fmu(beside / "sensitivities" / "Joystick.fmu") as fmu:
        assert fmu.sensitive is fmu
        found = fmu.sensitivities(TIME, by=["J"], outputs=["omega"])
        assert list(found) == ["sensitivity.omega.J"]


def test_what_an_fmu_was_not_built_for_is_refused(beside: Path) -> None:
    with Fmu(beside / "Joystick.fmu") as fmu, pytest.raises(UnsupportedFmuError) as caught:
        fmu.sensitivities(TIME, by=["J", "m"], outputs=["theta"])
    message = str(caught.value)
    assert "sensitivities/Joystick.fmu: has no sensitivity.theta.m, only sensitivity.theta." in message
    # Not into the folder of the package's own, whose sensitivities the fits need.
    assert "--output FOLDER --sensitivity theta:J,m" in message
    (beside / "sensitivities" / "Joystick.fmu").unlink()
    with Fmu(beside / "Joystick.fmu") as fmu:
        assert fmu.sensitive is None
        with pytest.raises(UnsupportedFmuError, match=r"has no sensitivities: build it with .*fmu_build"):
            fmu.sensitivities(TIME, by=["J"], outputs=["theta"])


def test_names_that_the_fmu_does_not_have_are_not_asked_to_be_built(beside: Path) -> None:
    with Fmu(beside / "Joystick.fmu") as fmu:
        with pytest.raises(
            UnknownParameterError, match=r"no parameter 'damping\.c'; did you mean damping\.C"
        ):
            fmu.sensitivities(TIME, by=["damping.c"], outputs=["theta"])
        with pytest.raises(UnknownVariableError, match="no variable 'Theta'; did you mean theta"):
            fmu.sensitivities(TIME, by=["J"], outputs=["Theta"])


def test_one_name_stands_for_itself_as_in_a_run(beside: Path) -> None:
    with Fmu(beside / "Joystick.fmu") as fmu:
        found = fmu.sensitivities(TIME, by="J", outputs="theta")
    assert list(found) == ["sensitivity.theta.J"]


def test_one_of_another_joystick_is_refused(beside: Path) -> None:
    """Other start values: the derivatives would be those of another motion."""
    (beside / "other" / "sensitivities").mkdir(parents=True)
    one = Path(shutil.copy(beside / "Joystick.fmu", beside / "other"))
    doctored(
        beside / "sensitivities" / "Joystick.fmu",
        one.parent / "sensitivities" / "Joystick.fmu",
        description=lambda xml: xml.replace('start="0.045"', 'start="0.05"'),
    )
    with Fmu(one) as fmu, pytest.raises(UnsupportedFmuError, match=r"is not the model of .*build it anew"):
        fmu.sensitivities(TIME, by=["J"], outputs=["theta"])
