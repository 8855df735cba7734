"""Reference model in pure Python, with which the FMUs are compared: the joystick of eqs. (1)-(13).

It is written from the equations alone and depends only on NumPy, SciPy, `pyjoystick.model.parameters` and
`pyjoystick.support`.
"""
