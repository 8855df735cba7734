"""Pages of the joystick and of other models, each built once for all tests."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser

from fmu_build.explore import Settings, explore_page
from fmu_build.packaging.platforms import host_platform
from tests.browser import LivePage, with_module
from tests.shared_fmus import SharedFmus

LIBRARY = Path(__file__).with_name("Models.mo")


class Pages:
    """FMUs by the name of their model, and their pages."""

    def __init__(self, joysticks: Path, shared: SharedFmus, folder: Path) -> None:
        self._joysticks, self._shared, self._folder = joysticks, shared, folder

    def fmu(self, model: str) -> Path:
        """The FMU of a model of Models.mo, or of a joystick."""
        if not model.startswith("Models."):
            made = self._folder / f"{model}.fmu"
            return made if made.exists() else with_module(self._joysticks / made.name, self._folder)
        host = host_platform()
        assert host is not None
        return self._shared.fmu(model, LIBRARY, platforms=(host.name, "wasm32"))

    def file(self, model: str, settings: Settings | None = None, name: str = "") -> Path:
        """The page of a model."""
        file = self._folder / f"{name or model}.html"
        if not file.exists():
            file.write_text(explore_page(self.fmu(model), settings), "utf-8")
        return file


@pytest.fixture(scope="session")
def pages(joystick_fmus: Path, shared_fmus: SharedFmus, tmp_path_factory: pytest.TempPathFactory) -> Pages:
    """Pages by the name of their model."""
    return Pages(joystick_fmus, shared_fmus, tmp_path_factory.mktemp("pages"))


@pytest.fixture
def live(browser: Browser, pages: Pages) -> Iterator[Callable[..., LivePage]]:
    """Open the page of a model; at the end each must have been silent and asked for nothing."""
    opened: list[LivePage] = []

    def open_page(model: str, fragment: str = "", file: Path | None = None, width: int = 1280) -> LivePage:
        opened.append(LivePage.of(browser, file or pages.file(model), fragment, width=width))
        return opened[-1]

    yield open_page
    for page in opened:
        page.close()
