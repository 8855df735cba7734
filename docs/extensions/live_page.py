"""The directive ``live``: the page of `pyjoystick explore` within a page of the site.

What the site holds is a picture that links to the live page. ``_static/live.js`` puts the live page in its
place, so that the picture is seen where scripts are off. The live page is made anew with every build.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any, ClassVar, Final
from urllib.parse import quote

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.application import Sphinx
from sphinx.errors import ExtensionError
from sphinx.util.docutils import SphinxDirective
from sphinx.util.typing import ExtensionMetadata

from pyjoystick.fmu import find_fmu
from pyjoystick.model import NOMINAL, PAPER, STOP_ANGLE
from pyjoystick.reports import held_fmu, joystick_page

PAGE: Final = "live/joystick.html"
PICTURE: Final = "/figures/live_page.svg"
#: Bytes. A page that is larger has something in it that does not belong there.
LARGEST: Final = 250_000


class Live(SphinxDirective):
    """The live page, with the picture's description as argument and the state of its address as option."""

    required_arguments = 1
    final_argument_whitespace = True
    option_spec: ClassVar[dict[str, Any]] = {"state": directives.unchanged_required}

    def run(self) -> list[nodes.Node]:
        """A figure whose picture and caption link to the live page."""
        up = "../" * self.env.docname.count("/")
        state = quote(self.options.get("state", ""), safe="=&")
        target = f"{up}{PAGE}" + (f"#{state}" if state else "")
        words = self.arguments[0]
        picture = nodes.image(uri=PICTURE, alt=words)
        alone = nodes.reference("", "Open the live page alone", refuri=target, internal=False)
        return [
            nodes.figure(
                "",
                nodes.reference("", "", picture, refuri=target, classes=["live"], internal=False),
                nodes.caption("", "", alone),
            )
        ]


def make_page(folder: Path) -> Path:
    """Write the live page of the paper's joystick into the folder of a site, and return its path.

    Raises:
        ExtensionError: the page is larger than `LARGEST`
    """
    fmu = find_fmu(held_fmu(NOMINAL))
    text = joystick_page(fmu, PAPER, NOMINAL, -STOP_ANGLE, title="The paper's joystick, live")
    if (size := len(text.encode())) > LARGEST:
        raise ExtensionError(f"{PAGE} has {size} bytes; at most {LARGEST} are allowed")
    path = folder / PAGE
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def _make(app: Sphinx) -> None:
    if app.builder.format == "html":
        make_page(Path(app.outdir))


def setup(app: Sphinx) -> ExtensionMetadata:
    """Called by Sphinx."""
    app.add_directive("live", Live)
    app.connect("builder-inited", _make)
    app.add_js_file("live.js", loading_method="defer")
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
