"""One offline HTML page in which a model runs live: its FMU as WebAssembly, with sliders and plots."""

from fmu_build.explore.addition import Addition
from fmu_build.explore.model import PageModel, page_model
from fmu_build.explore.page import explore_page
from fmu_build.explore.settings import Preset, Settings, read_settings

__all__ = ["Addition", "PageModel", "Preset", "Settings", "explore_page", "page_model", "read_settings"]
