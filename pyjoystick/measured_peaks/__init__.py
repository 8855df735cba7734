"""From noisy records to peaks of displacement and velocity."""

from pyjoystick.measured_peaks.peaks import MeasuredPeaks, measured_peaks

__all__ = ["MeasuredPeaks", "measured_peaks"]
