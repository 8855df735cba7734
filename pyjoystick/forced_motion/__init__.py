"""Forced motion (section 5 of the paper): the torque required for a motion, and the motion under a torque."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
