"""A comparison as JSON."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from pyjoystick.fmu import FmuDescription
from pyjoystick.runs.fmu_comparison.compare import RunComparison
from pyjoystick.runs.fmu_comparison.declarations import Declarations
from pyjoystick.runs.fmu_comparison.experiments import Tolerances
from pyjoystick.support import document_text


def as_json(
    fmus: Sequence[FmuDescription],
    runs: Sequence[RunComparison],
    tolerances: Tolerances,
    *,
    declarations: Declarations | None = None,
    notes: Sequence[str] = (),
) -> str:
    """All results of a comparison as JSON.

    Differences that are not finite are null; ``parted_at`` is null if the limit is kept.

    Args:
        fmus: two FMUs, or one that was compared with the reference
        runs: the compared runs
        tolerances: tolerances of the integrators
        declarations: comparison of the declarations of two FMUs
        notes: notes on the comparison
    """
    content: dict[str, Any] = {
        "fmus": [one.identity for one in fmus],
        "tolerances": asdict(tolerances),
        "within_limits": all(run.within_limits for run in runs),
        "runs": [_run(run) for run in runs],
    }
    if declarations is not None:
        content["declarations"] = asdict(declarations)
    return document_text("compare", content, notes)


def _run(run: RunComparison) -> dict[str, Any]:
    differences = [
        asdict(one) | {"judged": one.variable in run.judged, "within_limit": one.within_limit}
        for one in run.differences
    ]
    return {
        "interface": run.interface,
        "experiment": run.experiment,
        "within_limits": run.within_limits,
        "failures": list(run.failures),
        "differences": differences,
    }
