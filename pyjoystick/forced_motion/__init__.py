"""Forced motion, section 5 of the paper: the torque that a motion needs, and the motion under that torque."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
