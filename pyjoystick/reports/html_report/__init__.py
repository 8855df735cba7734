"""A report on a joystick as one page of HTML that can be sent on: figures, tables, parameters, versions."""
