"""The joystick of eqs. (1)-(13) in pure Python: the yardstick by which the FMUs are judged.

It is written from the equations alone and leans on NumPy, SciPy and `pyjoystick.model.parameters` only.
"""
