"""How often stated intervals hold the truth.

``python -m tests.pyjoystick.laboratory.load_curve.coverage [RECORDS]``
"""

from __future__ import annotations

import sys

import numpy as np

from pyjoystick.laboratory import fit_load_curve
from pyjoystick.model import BACKWARD_TABLE, FORWARD_TABLE, NOMINAL
from pyjoystick.support import FloatArray
from tests.pyjoystick.laboratory.load_curve.machine import MACHINE, curve


def deviations(seed: int) -> dict[str, float]:
    """Errors of one synthetic record in units of their stated standard errors, by quantity."""
    side, table = (("forward", FORWARD_TABLE), ("backward", BACKWARD_TABLE))[seed % 2]
    fit = fit_load_curve(curve(table, seed))
    names = NOMINAL.to_names()
    found = {f"x_{i}": float((fit.table.x[i] - table.x[i]) / fit.x_errors[i]) for i in range(4)}
    found |= {f"k_{i}": float((fit.table.k[i] - table.k[i]) / fit.k_errors[i]) for i in range(4)}
    found |= {name: (v - names[f"{side}.{name}"]) / e for name, (v, e) in fit.springs().items()}
    return found | {"friction": (fit.friction - MACHINE.friction) / fit.friction_error, "misfit": fit.misfit}


def deviations_of(seeds: range) -> dict[str, FloatArray]:
    """The same for many records."""
    each = [deviations(seed) for seed in seeds]
    return {name: np.array([one[name] for one in each]) for name in each[0]}


if __name__ == "__main__":
    records = int(sys.argv[1]) if len(sys.argv) > 1 else 120
    several = deviations_of(range(5000, 5000 + records))
    several.pop("misfit")
    for quantity, z in several.items():
        inside = np.mean(np.abs(z) < 1.96)
        print(f"{quantity:20s} {inside:.3f} within 1.96, mean {np.mean(z):+.2f}, deviation {np.std(z):.2f}")
    print(f"all {np.mean(np.abs(list(several.values())) < 1.96):.3f}")
