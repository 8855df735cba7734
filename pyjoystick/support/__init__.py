"""Common to all rooms: errors, checks of values, settings from TOML, writing of files, style of figures."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
