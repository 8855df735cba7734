"""A project: a folder with a laboratory's files, and all that follows from them by one command."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
