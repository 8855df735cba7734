"""The joystick FMUs against the pure-Python reference and physical laws."""
