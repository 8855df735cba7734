"""The pages written by `pyjoystick explore`, in a browser."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser

from pyjoystick.cli import main
from tests.browser import LivePage, with_module

Live = Callable[..., LivePage]


@pytest.fixture(scope="session")
def fmus(joystick_fmus: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The FMUs of joysticks; those of pages each with its module, so that this is compiled once."""
    folder = tmp_path_factory.mktemp("fmus")
    for name in ("HeldJoystick", "HeldJoystickPowerLaw", "MountedJoystick"):
        with_module(joystick_fmus / f"{name}.fmu", folder)
    for name in ("Joystick", "JoystickFriction", "OperatedJoystick"):
        (folder / f"{name}.fmu").symlink_to(joystick_fmus / f"{name}.fmu")
    return folder


@pytest.fixture
def live(
    browser: Browser,
    fmus: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> Iterator[Live]:
    """Open the page that the command writes with some arguments."""
    for module in ("pyjoystick.fmu.files", "pyjoystick.fmu"):
        monkeypatch.setattr(f"{module}.build_folder", lambda: fmus)
    opened: list[LivePage] = []

    def open_page(*arguments: str, fragment: str = "", **context: Any) -> LivePage:
        file = tmp_path / f"page{len(opened)}.html"
        assert main(["explore", *arguments, "-o", str(file)]) == 0, capsys.readouterr().err
        assert file.stat().st_size <= 250_000
        opened.append(LivePage.of(browser, file, fragment, **context))
        return opened[-1]

    yield open_page
    for page in opened:
        page.close()
