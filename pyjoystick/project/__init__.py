"""Projects: folders with a laboratory's files, from which one command identifies the joystick."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
