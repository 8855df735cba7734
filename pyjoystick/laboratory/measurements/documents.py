"""Results of importing measurements, as JSON in SI units."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pyjoystick.laboratory.measurements.chain import Chain, Motion
from pyjoystick.laboratory.measurements.results import residual
from pyjoystick.motion import Log
from pyjoystick.support import document_text

if TYPE_CHECKING:
    from pyjoystick.laboratory.measurements.comparison import AccelerometerComparison
    from pyjoystick.laboratory.measurements.trial import Trial


def trial_json(trial: Trial, notes: Sequence[str] = ()) -> str:
    """Markers, how the angle was found, and the output of the chain.

    Args:
        trial: the motion
        notes: notes on it
    """
    markers, measured, arc = trial.markers, trial.measured, trial.measured.arc
    known = measured.theta[np.isfinite(measured.theta)]
    content = {
        "file": str(measured.source),
        "record": trial.record.name,
        "frames": len(markers.time),
        "rate": markers.rate,
        "duration": markers.time[-1],
        "markers": [
            {
                "name": name,
                "frames_without": np.count_nonzero(markers.missing(name)),
                "residual": residual(markers, name),
            }
            for name in (trial.setup.top, *trial.setup.base)
        ],
        "direction": measured.plane.along,
        "out_of_plane": measured.plane.out_of_plane,
        "pivot_to_top": arc.radius,
        "pivot_to_top_error": arc.radius_error,
        "noise_across_arc": arc.noise,
        "noise": measured.noise,
        "theta_min": known.min(),
        "theta_max": known.max(),
        "motion": _motion(trial.setup.chain, trial.motion),
    }
    return document_text("import markers", content, notes)


def _motion(chain: Chain, motion: Motion) -> dict[str, Any]:
    low_pass, known = chain.low_pass, np.isfinite(motion.theta)
    return {
        "samples": np.count_nonzero(known),
        "rate": chain.rate,
        "bridged": np.count_nonzero(motion.bridged),
        "gaps": [{"start": start, "end": end} for start, end in motion.gaps],
        "filter_order": low_pass.order,
        "cutoff": low_pass.design_cutoff(chain.rate),
        "half_power_frequency": low_pass.half_power_frequency(chain.rate),
        "largest_omega": np.max(np.abs(motion.omega[known])),
        "largest_alpha": np.max(np.abs(motion.alpha[known])),
    }


def comparison_json(compared: AccelerometerComparison, notes: Sequence[str] = ()) -> str:
    """Comparison of an accelerometer with the differentiated angle.

    Args:
        compared: the comparison
        notes: notes on it
    """
    record, found = compared.record, compared.found
    content = {
        "file": record.source,
        "samples": record.samples,
        "rate": record.rate,
        "smallest": record.smallest,
        "largest": record.largest,
        "distance": compared.setup.distance,
        "delay": compared.setup.delay,
        "zero": found.zero,
        "gravity_share": found.gravity_share,
        "alpha": [
            {"name": name, "peak": found.peaks[name], "rms_difference": found.differences[name]}
            for name in ("less gravity", "with gravity")
        ],
        "differentiated": {"peak": found.peaks["differentiated"], "rms": found.differences["differentiated"]},
        "correlation": found.correlation,
        "lag": found.lag,
    }
    return document_text("import accelerometer", content, notes)


def log_json(log: Log, notes: Sequence[str] = ()) -> str:
    """How a laboratory's table was interpreted.

    Args:
        log: the table
        notes: notes on it
    """
    time = log.series["time"]
    content = {
        "file": str(log.path),
        "form": log.form,
        "heading_line": log.line or None,
        "samples": len(time),
        "rate": log.rate,
        "columns": [
            {
                "name": name,
                "heading": match.heading.text,
                "unit": match.unit,
                "minimum": log.series[name].min(),
                "maximum": log.series[name].max(),
            }
            for name, match in log.found.items()
        ],
        "lines_left_out": log.left_out,
    }
    return document_text("import record", content, notes)
