"""A synthetic laboratory: what its instruments would record of a known joystick.

Its output is called synthetic wherever it appears.
"""
