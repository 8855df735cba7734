"""Random joysticks to run in several places."""

from __future__ import annotations

import numpy as np

from pyjoystick.fmu import FmuDescription


def random_joysticks(description: FmuDescription, count: int, seed: int = 17) -> list[dict[str, float]]:
    """Values of parameters near their start values; releases on either side."""
    random = np.random.default_rng(seed)
    known = {
        name: float(variable.start or 0)
        for name, variable in description.variables.items()
        if name in description.settable_names()
        and variable.type == "Real"
        and float(variable.start or 0) > 0.0
    }
    cases = []
    for _ in range(count):
        case = {name: start * random.uniform(0.8, 1.1) for name, start in known.items()}
        if "theta_start" in description.variables:
            case["theta_start"] = random.choice([-1.0, 1.0]) * random.uniform(0.05, 0.35)
        cases.append(case)
    return cases
