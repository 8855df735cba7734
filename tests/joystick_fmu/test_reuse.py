"""Repeated use of one instance."""

from __future__ import annotations

import resource
from pathlib import Path

import numpy as np

from pyjoystick.model import NOMINAL
from tests.joystick_fmu.driver import fmu_parameters, slave

CYCLES = 100_000
WARM_UP = 5_000


def test_a_hundred_thousand_resets(fmus: Path) -> None:
    """Memory stays flat, and every run gives the same bits.

    The peak of the resident memory is compared, so that any growth is seen, also one that is given back.
    """
    parameters = fmu_parameters(NOMINAL, np.deg2rad(-5.0))
    with slave(fmus / "Joystick.fmu") as run:
        references = [run.references[name] for name in ("theta", "omega", "alpha", "E")]
        first = None
        for cycle in range(CYCLES):
            run.start(parameters, tolerance=1e-8)
            run.fmu.doStep(currentCommunicationPoint=0.0, communicationStepSize=0.02)
            result = np.array(run.get(references)).tobytes()
            first = first or result
            assert result == first, f"cycle {cycle}"
            run.fmu.reset()
            if cycle == WARM_UP:
                before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    # ru_maxrss is in kB on Linux: 95,000 runs may add less than 1 MB, ten bytes each.
    assert after - before < 1024
