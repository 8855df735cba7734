"""Documents made from numbers: the paper's claims, a joystick as one page of HTML."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
