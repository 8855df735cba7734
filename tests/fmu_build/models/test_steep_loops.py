"""Relations on unknowns of algebraic loops that change by 1e5 per second: each event is found once."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from tests.hybrid import Array
from tests.shared_fmus import SharedFmus

MODELS = """package Steep
  model Linear
    parameter Real a = 0.3;
    parameter Real b = 3.1;
    parameter Real c = 2000;
    parameter Real cubic = 0 annotation (Evaluate = true);
    Real z[3];
    Real n;
    Real x(start = 0, fixed = true);
  equation
    der(x) = 1;
    4*z[1] + cubic*z[1]^3 + a*z[2] - z[3] = 5/3;
    0 = z[2] + b*z[3] - cos(time);
    z[1] - 3*z[2] + z[3] = c/(1 + time^2)^2;
    n = floor((z[2] - 3)*sin(time*sin(z[3])));
  end Linear;

  model Nonlinear
    extends Linear(final cubic = 1e-6);
  end Nonlinear;
end Steep;
"""
TIMES = np.linspace(0.0, 0.2, 11)


def _unknowns(time: float, a: float, b: float, c: float, cubic: float) -> Array:
    """The loop's solution by Newton's method, to rounding."""
    matrix = np.array([[4.0, a, -1.0], [0.0, 1.0, b], [1.0, -3.0, 1.0]])
    right = np.array([5.0 / 3.0, np.cos(time), c / (1.0 + time**2) ** 2])
    z = np.linalg.solve(matrix, right)
    for _ in range(20):
        slope = matrix + np.diag([3.0 * cubic * z[0] ** 2, 0.0, 0.0])
        z -= np.linalg.solve(slope, matrix @ z + [cubic * z[0] ** 3, 0.0, 0.0] - right)
    return z


@pytest.mark.parametrize(("model", "cubic"), [("Linear", 0.0), ("Nonlinear", 1e-6)])
def test_steps_of_a_steep_function_of_a_loop(
    model: str, cubic: float, tmp_path: Path, shared_fmus: SharedFmus
) -> None:
    library = tmp_path / "Steep.mo"
    library.write_text(MODELS, "utf-8")
    source = np.random.default_rng(3)
    with Fmu(shared_fmus.fmu(f"Steep.{model}", library)) as fmu:
        for _ in range(20):
            parameters = {
                "a": source.uniform(-1.0, 1.0),
                "b": source.uniform(2.0, 4.0),
                "c": source.uniform(500.0, 4000.0),
            }
            found = fmu.run(TIMES, parameters=parameters, outputs=["n", "z[2]", "z[3]"])
            z = np.array([_unknowns(time, **parameters, cubic=cubic) for time in TIMES])
            np.testing.assert_allclose(found[["z[2]", "z[3]"]], z[:, 1:], rtol=1e-12)
            expected = np.floor((z[:, 1] - 3.0) * np.sin(TIMES * np.sin(z[:, 2])))
            np.testing.assert_array_equal(found["n"], expected)
