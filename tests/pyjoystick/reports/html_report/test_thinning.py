"""Invisible dots, and only these, are left out of a page."""

from __future__ import annotations

import io

import numpy as np
from matplotlib.figure import Figure

from pyjoystick.reports import figure
from pyjoystick.reports.html_report.thinning import thin_dots
from pyjoystick.support import FloatArray


def _drawn(samples: int) -> Figure:
    """Many samples of one line; below it a window on a tenth of them, as of a steep segment."""
    found = Figure(figsize=(4.0, 3.0))
    above, below = found.subplots(2, 1)
    x = np.linspace(0.0, 1.0, samples)
    for axes in (above, below):
        axes.plot(x, x**2, ".", markersize=2.0)
        axes.plot(x, x**3, color="red")
    below.set_xlim(0.4, 0.5)
    return found


def _pixels(content: Figure) -> FloatArray:
    buffer = io.BytesIO()
    content.savefig(buffer, format="rgba")
    return np.frombuffer(buffer.getvalue(), dtype=np.uint8).astype(np.float64)


def test_what_is_left_out_does_not_show() -> None:
    whole, thin = _drawn(20_000), _drawn(20_000)
    thin_dots(thin)
    counts = [[len(line.get_xdata()) for line in axes.lines] for axes in thin.axes]  # type: ignore[arg-type]
    # The line is about 4 inches or 288 points long, and passes up to four cells a point.
    assert all(50 < dots < 1200 and line == 20_000 for dots, line in counts)
    assert [axes.axis() for axes in thin.axes] == [axes.axis() for axes in whole.axes]
    # No pixel changes but at the edges of dots, by less than their smoothing.
    assert np.mean(np.abs(_pixels(thin) - _pixels(whole)) > 64.0) < 1e-3


def test_single_dots_stay() -> None:
    found = Figure()
    x = np.array([0.0, 0.5, np.nan, 1.0])
    (line,) = found.subplots().plot(x, x, "o")
    thin_dots(found)
    assert list(line.get_xdata()) == [0.0, 0.5, 1.0]  # type: ignore[arg-type]


def test_a_page_grows_with_what_it_shows_and_not_with_the_samples() -> None:
    sizes = [len(figure(_drawn(samples), "caption", alt="a line of dots")) for samples in (5_000, 50_000)]
    assert sizes[1] < 1.3 * sizes[0]
