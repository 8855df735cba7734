"""The parameters of the joystick as frozen, checked values in SI units, and the paper's values."""
