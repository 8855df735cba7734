"""Self-contained HTML pages: figures and style are included, nothing is fetched."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from importlib import resources

from matplotlib.figure import Figure

from pyjoystick.reports.html_report.thinning import thin_dots
from pyjoystick.support import figure_as_html


@dataclass(frozen=True, slots=True)
class Section:
    """A section of the page.

    Attributes:
        title: its heading, text
        parts: pieces of HTML, made by the functions of this module
    """

    title: str
    parts: Sequence[str]


def paragraph(text: str) -> str:
    """A paragraph of text."""
    return f"<p>{escape(text)}</p>"


def figure(content: Figure, caption: str, *, alt: str) -> str:
    """A figure as inline vector graphics.

    Args:
        content: the figure; invisible dots are removed from it
        caption: caption below the figure
        alt: description for those who cannot see it
    """
    thin_dots(content)
    return f"<figure>{figure_as_html(content, alt=alt)}\n<figcaption>{escape(caption)}</figcaption></figure>"


def page(title: str, introduction: str, sections: Sequence[Section], *, footer: str) -> str:
    """The whole page, with a table of contents.

    Args:
        title: heading of the page, text
        introduction: HTML below the heading
        sections: in order
        footer: text at the end
    """
    style = (
        resources.files("pyjoystick.reports.html_report").joinpath("report.css").read_text(encoding="utf-8")
    )
    contents = "\n".join(
        f'<li><a href="#part-{i}">{escape(one.title)}</a></li>' for i, one in enumerate(sections, start=1)
    )
    body = "\n".join(
        "\n".join((f'<section id="part-{i}"><h2>{escape(one.title)}</h2>', *one.parts, "</section>"))
        for i, one in enumerate(sections, start=1)
    )
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{escape(title)}</title>
<style>
{style}</style>
</head>
<body>
<header><h1>{escape(title)}</h1>
{introduction}</header>
<nav aria-label="Contents"><ol>
{contents}
</ol></nav>
<main>
{body}
</main>
<footer><p>{escape(footer)}</p></footer>
</body>
</html>
"""
