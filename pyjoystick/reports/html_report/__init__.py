"""A report on a joystick as a self-contained HTML page: figures, tables, parameters, versions."""
