"""Display of fitted load-deflection curves in notebooks."""

from pyjoystick.laboratory.load_curve.figures import plot_load_curve as plot
from pyjoystick.laboratory.load_curve.report import load_curve_report as summary

__all__ = ["plot", "summary"]
