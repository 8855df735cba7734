"""Records of known joysticks for the tests of fitting, made by the pure-Python reference."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from pyjoystick.fmu import find_fmu, read_description
from pyjoystick.identification import FitSettings, Free, Measurement
from pyjoystick.identification.fitting.problem.forward_model import ForwardModel
from pyjoystick.identification.fitting.problem.instrument import Instrument
from pyjoystick.identification.fitting.problem.least_squares import Problem
from pyjoystick.identification.fitting.problem.noise_model import NoiseModel
from pyjoystick.identification.fitting.problem.predictor import Prediction
from pyjoystick.identification.fitting.problem.variables import Variables
from pyjoystick.laboratory import synthetic_record
from pyjoystick.model import JoystickParameters
from pyjoystick.motion import Record
from pyjoystick.support import FloatArray


def releases(
    joystick: JoystickParameters,
    count: int = 1,
    *,
    noise: float = 0.0,
    seed: int = 1,
    rate: float = 60.0,
    duration: float = 1.6,
) -> list[Record]:
    """Releases from about -20 degrees, each from another angle and at another instant between samples."""
    random = np.random.default_rng(seed)
    return [
        synthetic_record(
            joystick,
            release_angle=math.radians(-20.0 + 0.4 * number),
            random=random,
            name=f"run {number}",
            release_time=0.1 + 0.0037 * number,
            duration=duration,
            rate=rate,
            noise=noise,
        )
        for number in range(count)
    ]


class LinearPredictor:
    """Predicts ``matrix @ row``, so that what a fit must find has a formula."""

    differentiable: tuple[str, ...] = ()

    def __init__(self, name: str, matrix: FloatArray, data: FloatArray) -> None:
        self.times: FloatArray = np.linspace(0.0, 1.0, len(data))
        self.record = Measurement(name, self.times, {"y": data})
        self.data = data
        self.labels = ("y",) * len(data)
        self.matrix = matrix
        self.runs = 0

    def predict(self, rows: FloatArray, instrument: Instrument) -> Prediction:
        self.runs += len(rows)
        return Prediction(rows @ self.matrix.T, {}, "")

    def derivatives(
        self, row: FloatArray, instrument: Instrument, *, rough: bool = False
    ) -> dict[str, FloatArray]:
        return {}


def linear_problem(
    matrices: Sequence[FloatArray], data: Sequence[FloatArray], free: Sequence[Free], sigma: float = 1.0
) -> Problem:
    """A problem whose variables are parameters of the joystick in name alone."""
    predictors = [
        LinearPredictor(f"run {k}", matrix, one)
        for k, (matrix, one) in enumerate(zip(matrices, data, strict=True))
    ]
    settings = FitSettings(fmu="Joystick", free=tuple(free))
    variables = Variables(
        settings, read_description(find_fmu("Joystick")), [one.record for one in predictors]
    )
    noise = NoiseModel.white([np.full(len(one), 1.0 / sigma) for one in data])
    return Problem.of(ForwardModel(variables, predictors), noise)
