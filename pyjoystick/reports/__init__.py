"""Output for other people and tools: projects, the paper's claims, reports, live pages, exported FMUs."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)
