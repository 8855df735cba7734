"""The joystick in Python: parameters, the reference from the equations alone, periods from the energy."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
