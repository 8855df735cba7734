"""Draws docs/free_oscillation.svg, the figure of the README: ``make figure``."""

from __future__ import annotations

import math
from pathlib import Path

import matplotlib as mpl

from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW
from pyjoystick.runs import free_oscillation
from pyjoystick.support import LAWS, plot_motion

# The same bytes every time, and no more points than the eye can tell apart.
mpl.rcParams.update({"svg.hashsalt": "pyjoystick", "path.simplify_threshold": 0.1})
runs = {
    label: free_oscillation(math.radians(-20), parameters=joystick, output_interval=2e-3)
    for label, joystick in {"constant damping": NOMINAL, "power-law damping": NOMINAL_POWER_LAW}.items()
}
styles = dict(zip(runs, (LAWS["constant"], LAWS["power-law"]), strict=True))
plot_motion(runs, styles=styles).savefig(Path(__file__).with_suffix(".svg"), metadata={"Date": None})
