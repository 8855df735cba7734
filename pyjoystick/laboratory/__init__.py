"""From instruments' files to motions and numbers with uncertainties; and instruments made up."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
