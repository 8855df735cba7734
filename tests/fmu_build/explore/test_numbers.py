"""A page shows what the FMU computes, for a joystick and for other models."""

from __future__ import annotations

from collections.abc import Callable
from urllib.parse import quote

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Fmu
from tests.browser import LivePage
from tests.fmu_build.explore.conftest import Pages
from tests.fmu_build.random_joysticks import random_joysticks

#: The C libraries of the module and of the FMU round `pow` and the like differently.
_CLOSE = {"rtol": 1e-9, "atol": 1e-9}

Live = Callable[..., LivePage]


def _run(pages: Pages, model: str, table: pd.DataFrame, **settings: object) -> pd.DataFrame:
    with Fmu(pages.fmu(model)) as fmu:
        time = np.round(table.index.to_numpy(), 12)
        return fmu.run(time, outputs=list(table.columns), **settings)  # type: ignore[arg-type]


def test_joystick_with_changed_values_and_a_table(pages: Pages, live: Live) -> None:
    page = live("Joystick", "#theta_start=-0.3&damping.C=0.03")
    with page.rerun():
        page.control("T").locator("textarea").fill("0, 0\n0.2, 1\n0.4, 1\n0.4, -0.5")
    shown = page.csv()
    drive = pd.DataFrame({"T": [0.0, 1.0, 1.0, -0.5]}, index=[0.0, 0.2, 0.4, 0.4])
    expected = _run(
        pages, "Joystick", shown, parameters={"theta_start": -0.3, "damping.C": 0.03}, inputs=drive
    )
    assert len(shown) == 1501
    np.testing.assert_allclose(shown.to_numpy(), expected.to_numpy(), **_CLOSE)


@pytest.mark.parametrize("model", ["Joystick", "JoystickPowerLaw"])
def test_random_joysticks_have_the_bits_of_the_same_module_in_wasmtime(
    model: str, pages: Pages, live: Live
) -> None:
    """So no floating-point operation of the browser's differs from those of other hosts."""
    with Fmu(pages.fmu(model), sandbox=True) as fmu:
        page = live(model)
        for case in random_joysticks(fmu.description, 50, seed=23):
            values = [f"{name}={float(value)!r}" for name, value in case.items()]
            address = "#" + "&".join([*values, "T:table=", ":step=0.005"])
            with page.rerun():
                page.page.evaluate("address => { location.hash = address; }", address)
            shown = page.csv()
            expected = fmu.run(0.005 * np.arange(301), parameters=case, outputs=list(shown.columns))
            assert np.ptp(expected["theta"]) > 0.01
            np.testing.assert_array_equal(shown.to_numpy(), expected.to_numpy())


def test_default_experiment_with_its_inputs(pages: Pages, live: Live) -> None:
    shown = live("Joystick").csv()
    push = pd.DataFrame({"T": [0.0, 0.0, -1.7, -1.7, 0.0]}, index=[0.0, 0.1, 0.1, 0.3, 0.3])
    expected = _run(pages, "Joystick", shown, inputs=push)
    assert expected["theta"].abs().max() > 0.1  # the joystick was really pushed
    np.testing.assert_allclose(shown.to_numpy(), expected.to_numpy(), **_CLOSE)


def test_bouncing_ball(pages: Pages, live: Live) -> None:
    page = live("Models.Ball", "#e=0.6&h=2&:stop=1.5&:plots=" + quote('[[null,"h","bounces"],["h","v"]]'))
    shown = page.csv()
    assert list(shown.columns) == ["h", "bounces", "v"]
    expected = _run(pages, "Models.Ball", shown, parameters={"e": 0.6, "h": 2.0})
    assert shown["bounces"].iloc[-1] == 2
    np.testing.assert_allclose(shown.to_numpy(), expected.to_numpy(dtype=float), **_CLOSE)


def test_two_mass_chain(pages: Pages, live: Live) -> None:
    page = live("Models.Chain")
    with page.rerun():
        page.type("F", "3")
    with page.rerun():
        page.control("kind").locator("select").select_option("hard")
    with page.rerun():
        page.type("strands", "4")
    with page.rerun():
        page.type("x[1]", "20")  # mm
    shown = page.csv()
    parameters = {"kind": 2, "strands": 4, "x[1]": 0.02}
    expected = _run(pages, "Models.Chain", shown, parameters=parameters, inputs={"F": 3.0})
    np.testing.assert_allclose(shown.to_numpy(), expected.to_numpy(), **_CLOSE)
