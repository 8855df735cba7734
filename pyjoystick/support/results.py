"""What a scenario leaves behind: a summary that is printed too, and figures as PNG and PDF."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from matplotlib.figure import Figure

from pyjoystick.support import save_figure, write_text


def save_results(folder: Path, summary: str, figures: Mapping[str, Figure]) -> None:
    """Print the summary, and write it and the figures.

    Args:
        folder: where to; made where it is missing
        summary: text in Markdown, for ``summary.md``
        figures: by the names of their files, without suffix

    Raises:
        OutputFileError: a file cannot be written
    """
    for name, figure in figures.items():
        for suffix in ("png", "pdf"):
            save_figure(figure, folder / f"{name}.{suffix}")
    text = summary.rstrip("\n")
    write_text(folder / "summary.md", f"{text}\n")
    print(text)
