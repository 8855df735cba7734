"""From load-deflection curves of a testing machine to the springs of an actuator (Fig. 7, Table 1)."""

from pyjoystick.load_curve.curve import Branch, LoadCurve
from pyjoystick.load_curve.fit import LoadCurveFit, fit_load_curve
from pyjoystick.load_curve.reading import read_load_curve

__all__ = ["Branch", "LoadCurve", "LoadCurveFit", "fit_load_curve", "read_load_curve"]
