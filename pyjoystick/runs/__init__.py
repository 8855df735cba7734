"""Experiments on FMUs and the reference: free oscillation, sweeps, comparisons, coupled systems."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
