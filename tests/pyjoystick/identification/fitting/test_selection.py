"""Model selection."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.identification import CONSTANT_DAMPING, RELEASE, FitSettings, Free, Uncertainty
from pyjoystick.identification.fitting.result import criteria
from pyjoystick.identification.fitting.selection import compare_models, comparison_table
from pyjoystick.model import NOMINAL_POWER_LAW
from pyjoystick.support import ParameterError
from tests.pyjoystick.identification.fitting.made import releases

NO_PROFILES = Uncertainty(profiles=())
CONSTANT = dataclasses.replace(CONSTANT_DAMPING, uncertainty=NO_PROFILES)
#: Eq. (11) at alpha = 1, both sides alike: two parameters.
ALIKE = FitSettings(
    fmu="JoystickPowerLaw",
    fixed={"damping.alpha": 1.0},
    free=(Free("damping.A_pos", start=0.05), Free("damping.n_pos", start=0.0), *RELEASE),
    ties={"damping.A_neg": "damping.A_pos", "damping.n_neg": "damping.n_pos"},
    uncertainty=NO_PROFILES,
)


def test_criteria_by_hand() -> None:
    found = criteria(-10.0, 3, 20)
    assert found.aicc == pytest.approx(20.0 + 6.0 + 24.0 / 16.0)
    assert found.bic == pytest.approx(20.0 + 3.0 * math.log(20.0))
    assert criteria(-10.0, 3, 4).aicc == math.inf


def test_the_law_that_made_the_records_is_found(fmus_by_name: Path) -> None:
    """By the criteria, and by the prediction of records that were left out, whose noise is the floor."""
    truth = NOMINAL_POWER_LAW.replace(
        {"damping.alpha": 1.0, "damping.A_neg": 0.086, "damping.n_neg": 0.3, "damping.n_pos": 0.3}
    )
    noise = math.radians(0.1)
    records = releases(truth, 3, noise=noise)
    told: list[tuple[str, int, int]] = []
    constant, alike = compare_models(
        records, {"constant": CONSTANT, "alike": ALIKE}, on_progress=lambda *news: told.append(news)
    )
    assert told == [(name, k, 3) for name in ("constant", "alike") for k in range(3)]
    assert constant.fit.criteria is not None
    assert alike.fit.criteria is not None
    assert alike.fit.criteria.aicc < constant.fit.criteria.aicc - 10.0
    assert alike.prediction_error == pytest.approx(noise, rel=0.15)
    assert constant.prediction_error > 1.5 * alike.prediction_error
    table = comparison_table((constant, alike)).splitlines()
    parameters = 12 + (alike.fit.correlation != 0.0)
    assert [cell.strip() for cell in table[3].split("|")[1:5]] == ["alike", str(parameters), "0.0", "0.0"]


def test_one_record_cannot_be_left_out(fmus_by_name: Path) -> None:
    (only,) = compare_models(releases(NOMINAL_POWER_LAW), {"constant": CONSTANT})
    assert np.isnan(only.prediction_error)


def test_models_of_different_data_are_refused() -> None:
    other = dataclasses.replace(CONSTANT, comparison="peaks")
    for models in ({}, {"a": CONSTANT, "b": other}, {"b": other}):
        with pytest.raises(ParameterError, match="models"):
            compare_models(releases(NOMINAL_POWER_LAW), models)
