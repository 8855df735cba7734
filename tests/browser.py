"""A real browser for testing pages: Debian's Chromium, driven by Playwright."""

from __future__ import annotations

import csv
import os
import shutil
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
from playwright.sync_api import (
    Browser,
    ConsoleMessage,
    Error,
    Locator,
    Page,
    Request,
    expect,
    sync_playwright,
)

from fmu_build.packaging import wasm_module
from fmu_build.packaging.module import module_name

#: Set by .ci/run: where Chromium is missing, the tests fail instead of being skipped.
REQUIRED = "PYJOYSTICK_REQUIRE_BROWSER"
_LEFT = "about:blank"
_ARGUMENTS = (
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)
#: The second is the same browser with windows, in which these tests take half as long again.
_PROGRAMS = ("chromium-headless-shell", "chromium")
#: What a click on a button would save as a file, and does not.
_SAVED = """button => {
  const { createObjectURL } = URL;
  const { click } = HTMLAnchorElement.prototype;
  let saved;
  URL.createObjectURL = (blob) => { saved = blob; return "about:blank"; };
  HTMLAnchorElement.prototype.click = () => {};
  button.click();
  Object.assign(URL, { createObjectURL });
  Object.assign(HTMLAnchorElement.prototype, { click });
  return saved.text();
}"""


@contextmanager
def opened() -> Iterator[Browser]:
    """A headless Chromium; skips, or fails where it is required, if there is none."""
    program = next(filter(None, map(shutil.which, _PROGRAMS)), None)
    if program is None:
        missing = "the program chromium is not installed"
        if os.environ.get(REQUIRED):
            pytest.fail(f"{missing}, but {REQUIRED} is set")
        pytest.skip(missing)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=[*_ARGUMENTS])
        yield browser
        browser.close()


def tab(browser: Browser) -> Page:
    """A tab that was left, or a new one: its process takes longer to start than a page to load."""
    tabs = [page for context in browser.contexts for page in context.pages]
    return next((page for page in tabs if page.url == _LEFT), None) or browser.new_page()


def leave(page: Page) -> None:
    """Leave a tab for another page; the pointer must not rest on what is there next."""
    page.goto(_LEFT)
    page.mouse.move(0, 0)


def with_module(fmu: Path, folder: Path) -> Path:
    """A copy of an FMU in another folder that carries the module that would be compiled for each page."""
    copy = folder / fmu.name
    shutil.copy(fmu, copy)
    with zipfile.ZipFile(copy, "a") as archive:
        archive.writestr(module_name(fmu.stem), wasm_module(fmu))
    return copy


@dataclass
class LivePage:
    """A page of `fmu_build explore` in the browser, and what went wrong in it."""

    page: Page
    file: Path
    has_own_context: bool
    messages: list[str] = field(default_factory=list)
    requests: list[str] = field(default_factory=list)

    @classmethod
    def of(
        cls, browser: Browser, file: Path, fragment: str = "", *, width: int = 1280, **context: Any
    ) -> LivePage:
        """The page of a file, after its first run; with more options of a browser's context."""
        page = browser.new_page(**context) if context else tab(browser)
        page.set_viewport_size({"width": width, "height": 900})
        page.set_default_timeout(60_000)  # a busy machine takes its time
        live = cls(page, file, has_own_context=bool(context))
        page.on("console", live._said)
        page.on("pageerror", live._failed)
        page.on("request", live._asked)
        page.goto(file.as_uri() + fragment)
        page.wait_for_selector("body[data-runs]")
        return live

    def _said(self, message: ConsoleMessage) -> None:
        self.messages.append(message.text)

    def _failed(self, error: Error) -> None:
        self.messages.append(str(error))

    def _asked(self, request: Request) -> None:
        self.requests.append(request.url)

    @property
    def runs(self) -> int:
        """How many results the page has shown."""
        return int(self.page.get_attribute("body", "data-runs") or 0)

    @contextmanager
    def rerun(self) -> Iterator[None]:
        """Wait for the next result after what is done inside."""
        before = self.runs
        yield
        for _ in range(1000):
            if self.runs > before:
                return
            self.page.wait_for_timeout(5)
        pytest.fail("the page did not run the model again")

    def settle(self) -> None:
        """Wait until the page has done what waits for the sliders to rest, such as its words."""
        for _ in range(1000):
            if self.page.get_attribute("body", "data-settled") == str(self.runs):
                return
            self.page.wait_for_timeout(5)
        pytest.fail("the page does not come to rest")

    def control(self, name: str) -> Locator:
        """The control of a value; its group is opened."""
        control = self.page.locator(f'.control[data-name="{name}"]')
        if not control.is_visible():
            self.page.locator("details", has=control).locator("summary").click()
        return control

    def type(self, name: str, text: str) -> None:
        """Type a value, in the unit that the page shows."""
        self.control(name).locator("input.number").fill(text)

    def csv(self, *, download: bool = False) -> pd.DataFrame:
        """What the CSV button saves, indexed by time, columns by name.

        Without a download, which takes thirty times as long, it is taken from where the page hands it over.
        """
        button = self.page.get_by_role("button", name="CSV", exact=True)
        if download:
            with self.page.expect_download() as started:
                button.click()
            text = Path(started.value.path()).read_text("utf-8")
        else:
            text = button.evaluate(_SAVED)
        header, *rows = csv.reader(text.splitlines())
        numbers = [[float(cell) for cell in row] for row in rows]  # to the last bit, as pandas would not
        names = [name.split(" (")[0] for name in header]
        return pd.DataFrame(numbers, columns=names).set_index("time")

    def words(self) -> list[str]:
        """What the plots say of themselves: the range of each curve."""
        self.settle()
        plots = self.page.locator("figure canvas").all()
        return [plot.get_attribute("aria-label") or "" for plot in plots]

    def address(self) -> str:
        """What the address says of the state, once it has been written."""
        expect(self.page.locator("body")).not_to_have_attribute("data-address", "due")
        return self.page.url.partition("#")[2]

    def alert(self) -> str:
        """The message above the page; empty without one."""
        return self.page.locator("#alert").inner_text()

    def close(self) -> None:
        """Leave the page; nothing must have been said or asked for beside the file and its worker."""
        page = self.page
        page.close() if self.has_own_context else leave(page)
        page.remove_listener("console", self._said)
        page.remove_listener("pageerror", self._failed)
        page.remove_listener("request", self._asked)
        assert self.messages == []
        known = ("blob:", self.file.as_uri(), _LEFT)
        others = [url for url in self.requests if not url.startswith(known)]
        assert others == []
