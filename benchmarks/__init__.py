"""Speed of the joystick's free oscillation: the FMU against a hand-written program and other methods."""
