"""A synthetic laboratory: what its instruments would have shown of a joystick that is known.

Wherever its output appears it is called synthetic.
"""
