"""The speed of the joystick's free oscillation: the FMU against a program written by hand, and other ways."""
