"""The joystick FMUs held against the pure-Python reference and against physics."""
