"""Display of a fit in notebooks."""

from pyjoystick.identification.fitting.figures import plot_records as plot
from pyjoystick.identification.fitting.text_report import summary

__all__ = ["plot", "summary"]
