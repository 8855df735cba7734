"""Dynamics of joysticks with opposing restrained preloaded springs: FMUs, parameters, reference model, peaks.

The names of this package are what most uses need; its rooms (`pyjoystick.fmu`, `pyjoystick.model`, ...) hold
the rest. Each is loaded when it is first used, so that importing this package takes no time.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
