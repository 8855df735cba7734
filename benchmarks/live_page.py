"""How long the live page takes from a moved slider to its curves: ``python -m benchmarks.live_page``.

In a headless Chromium without a graphics card. A move is an ``input`` event at a random phase of the screen's
60 Hz. It ends when the main thread has arranged and painted the picture with its curves; what follows, on the
way to a screen, no script can see. Its parts: until the curves are on their canvases; until the browser
begins the next picture, which no page can shorten; and the picture itself. The page's runs are timed beside
those of the same FMU and the same motion by the compiled loop of `pyjoystick`, in turns: 1501 rows of the
variables that the page shows.
"""

from __future__ import annotations

import os
import shutil
import statistics
import tempfile
import time
from pathlib import Path
from typing import Annotated, Final

import numpy as np
import typer
from numpy.typing import NDArray
from playwright.sync_api import Page, sync_playwright

from benchmarks.report import machine
from pyjoystick.fmu import Fmu, find_fmu
from pyjoystick.model import NOMINAL, PAPER, STOP_ANGLE
from pyjoystick.reports import held_fmu, joystick_page
from pyjoystick.support import TextTable

_MOVES: Final = 100
#: Moves the slider of damping.C; returns [drawn, waiting, picture] of each move in milliseconds.
_MOVE_ALL: Final = """async moves => {
  const slider = document.querySelector('[data-name="damping.C"] input[type=range]');
  const runs = () => Number(document.body.dataset.runs);
  const milliseconds = [];
  for (let i = 0; i < moves; i++) {
    await new Promise(resolve => setTimeout(resolve, 35 + 17 * Math.random()));
    const [before, begun] = [runs(), performance.now()];
    slider.value = String(100 + (i % 2) * 100 + i);
    slider.dispatchEvent(new Event("input"));
    while (runs() === before) await new Promise(resolve => new MutationObserver((_, observer) => {
      observer.disconnect();
      resolve();
    }).observe(document.body, { attributes: true }));
    const drawn = performance.now(); // observers are called when the page has dealt with the result
    const frame = await new Promise(requestAnimationFrame);
    const { port1, port2 } = new MessageChannel();
    port2.postMessage(null); // comes after the picture
    await new Promise(resolve => port1.onmessage = resolve);
    const picture = Math.max(drawn, frame);
    milliseconds.push([drawn - begun, picture - drawn, performance.now() - picture]);
  }
  return milliseconds;
}"""


def main(
    rounds: Annotated[int, typer.Option(min=2, help="How often 100 moves and native runs are timed.")] = 5,
) -> None:
    """Time 100 moves of a slider, and a run in Chromium against the same run of the FMU."""
    program = shutil.which("chromium")
    if program is None:
        typer.echo("error: the program chromium is not installed", err=True)
        raise typer.Exit(1)
    fmu = find_fmu(held_fmu(NOMINAL))
    with tempfile.TemporaryDirectory(prefix="benchmarks-") as folder, sync_playwright() as playwright:
        file = Path(folder) / "joystick.html"
        file.write_text(joystick_page(fmu, PAPER, NOMINAL, -STOP_ANGLE), encoding="utf-8")
        arguments = ["--no-sandbox", "--disable-gpu"]
        browser = playwright.chromium.launch(executable_path=program, args=arguments)
        page = browser.new_page(viewport={"width": 1280, "height": 900})
        page.goto(file.as_uri())
        page.wait_for_selector("body[data-runs]")
        page.evaluate(_MOVE_ALL, _MOVES)  # code that runs often is compiled again
        typer.echo(_report(page, fmu, rounds))
        browser.close()


def _report(page: Page, fmu: Path, rounds: int) -> str:
    moves: list[list[float]] = []
    ratios, in_page, native = [], [], []
    with Fmu(fmu) as one:
        for _ in range(rounds):
            moves += page.evaluate(_MOVE_ALL, _MOVES)
            in_page.append(_run_in_page(page))
            native.append(_native(one))
            ratios.append(in_page[-1] / native[-1])
    drawn, waiting, picture = np.array(moves).T
    rows = [
        _row("slider to drawn", drawn),
        _row("waiting for the next frame", waiting),
        _row("painting", picture),
        _row("slider to painted", drawn + waiting + picture),
        _row("the same without waiting", drawn + picture),
        ["a run in the page (ms)", f"{statistics.median(in_page):.2f}", ""],
        ["a run by the compiled loop (ms)", f"{statistics.median(native):.2f}", ""],
        ["their ratio, median of the rounds", f"{statistics.median(ratios):.2f}", ""],
    ]
    load = f"load {os.getloadavg()[0]:.1f}, {len(moves)} moves"
    table = TextTable(("what", "median", "95th percentile"), rows)
    return "\n".join([f"{machine()}; {load}", "", table.markdown()])


def _row(what: str, milliseconds: NDArray[np.float64]) -> list[str]:
    return [f"{what} (ms)", *(f"{part:.1f}" for part in np.percentile(milliseconds, [50, 95]))]


def _run_in_page(page: Page) -> float:
    """Return the least time of twenty runs (ms), as reported by the page: values in, run, and table out."""
    times = []
    for _ in range(20):
        page.evaluate(_MOVE_ALL, 1)
        times.append(float(page.locator("#status").inner_text().split(" in ")[1].removesuffix("ms")))
    return min(times)


def _native(fmu: Fmu) -> float:
    """Return the least time of a hundred runs (ms) of the page's motion, with as many output variables."""
    moving = [one.name for one in fmu.description.variables.values() if one.causality in ("output", "input")]
    springs = [
        f"{side}.{kind}Spring.{end}"
        for side in ("forward", "backward")
        for kind in ("return", "balance")
        for end in ("delta", "isEngaged", "isReleased")
    ]
    start = {"theta_start": -STOP_ANGLE}  # otherwise it would stay at rest
    plan = fmu.plan(np.arange(1501) * 1e-3, parameters=start, outputs=[*moving, *springs])
    times = []
    for _ in range(100):
        begun = time.perf_counter()
        plan.run()
        times.append(1e3 * (time.perf_counter() - begun))
    return min(times)


if __name__ == "__main__":
    typer.run(main)
