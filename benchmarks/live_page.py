"""How long the live page takes from a moved slider to its curves: ``python -m benchmarks.live_page``.

In a headless Chromium without a graphics card. The runs of the page are timed beside those of the same FMU by
the compiled loop of `pyjoystick`, in turns: 1501 rows of the variables that the page shows.
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
from playwright.sync_api import Page, sync_playwright

from benchmarks.report import machine
from pyjoystick.fmu import Fmu, find_fmu
from pyjoystick.model import NOMINAL, PAPER, STOP_ANGLE
from pyjoystick.reports import held_fmu, joystick_page
from pyjoystick.support import TextTable

_MOVES: Final = 100
#: Moves of the slider of damping.C; each waits for the picture with its curves.
_MOVE_ALL: Final = """async moves => {
  const slider = document.querySelector('[data-name="damping.C"] input[type=range]');
  const runs = () => Number(document.body.dataset.runs);
  const milliseconds = [];
  for (let i = 0; i < moves; i++) {
    const [before, begun] = [runs(), performance.now()];
    slider.value = String(100 + (i % 2) * 100 + i);
    slider.dispatchEvent(new Event("input"));
    while (runs() === before) await new Promise(resolve => new MutationObserver((_, observer) => {
      observer.disconnect();
      resolve();
    }).observe(document.body, { attributes: true }));
    await new Promise(requestAnimationFrame); // draws; asked for after the page did
    milliseconds.push(performance.now() - begun);
    await new Promise(resolve => setTimeout(resolve, 20));
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
    moves: list[float] = []
    ratios, in_page, native = [], [], []
    with Fmu(fmu) as one:
        for _ in range(rounds):
            moves += page.evaluate(_MOVE_ALL, _MOVES)
            in_page.append(_run_in_page(page))
            native.append(_native(one))
            ratios.append(in_page[-1] / native[-1])
    percentiles = statistics.quantiles(moves, n=20, method="inclusive")
    rows = [
        ["slider to curves, median (ms)", f"{statistics.median(moves):.1f}"],
        ["slider to curves, 95th percentile (ms)", f"{percentiles[-1]:.1f}"],
        ["a run in the page (ms)", f"{statistics.median(in_page):.2f}"],
        ["a run by the compiled loop (ms)", f"{statistics.median(native):.2f}"],
        ["their ratio, median of the rounds", f"{statistics.median(ratios):.2f}"],
    ]
    load = f"load {os.getloadavg()[0]:.1f}, {len(moves)} moves"
    return "\n".join([f"{machine()}; {load}", "", TextTable(("what", "value"), rows).markdown()])


def _run_in_page(page: Page) -> float:
    """Median of twenty runs (ms), as the page says it: values in, run, and table out."""
    times = []
    for _ in range(20):
        page.evaluate(_MOVE_ALL, 1)
        times.append(float(page.locator("#status").inner_text().split(" in ")[1].removesuffix("ms")))
    return statistics.median(times)


def _native(fmu: Fmu) -> float:
    """Median of twenty runs (ms) with as many variables as the page has in its table."""
    moving = [one.name for one in fmu.description.variables.values() if one.causality in ("output", "input")]
    springs = [
        f"{side}.{kind}Spring.{end}"
        for side in ("forward", "backward")
        for kind in ("return", "balance")
        for end in ("delta", "isEngaged", "isReleased")
    ]
    plan = fmu.plan(np.arange(1501) * 1e-3, outputs=[*moving, *springs])
    times = []
    for _ in range(20):
        begun = time.perf_counter()
        plan.run()
        times.append(1e3 * (time.perf_counter() - begun))
    return statistics.median(times)


if __name__ == "__main__":
    typer.run(main)
