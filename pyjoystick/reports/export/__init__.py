"""A joystick as FMUs, a Modelica class and tables for other tools."""
