"""The joystick of eqs. (1)-(13) in pure Python: the reference with which the FMUs are compared.

It is written from the equations alone and depends only on NumPy, SciPy and `pyjoystick.model.parameters`.
"""
