"""Display of results in notebooks, as tables and figures, and of progress."""

from __future__ import annotations

import base64
import io
import sys
import time as clock
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from html import escape
from importlib import import_module
from typing import TYPE_CHECKING, Any, ClassVar, Final

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Work that takes less than this shows nothing (s); what it shows changes no more often than this (s).
_PATIENCE: Final = 0.5
_INTERVAL: Final = 0.2

#: Called with a stage, the amount done and the total.
Tell = Callable[[str, int, int], None]


class Shown:
    """A result that a notebook shows as its summary.

    The module `_shown_by` has the function ``summary``; it is named, not imported, because it imports the
    class.
    """

    __slots__ = ()
    _shown_by: ClassVar[str]

    def summary(self) -> str:
        """The result as Markdown that is also readable as plain text."""
        text: str = import_module(self._shown_by).summary(self)
        return text

    def _repr_html_(self) -> str:
        return markdown_as_html(self.summary())


class Drawn(Shown):
    """A result that a notebook shows as summary and figure; `_shown_by` has the function ``plot`` too."""

    __slots__ = ()

    def plot(self) -> Figure:
        """The result as a figure."""
        figure: Figure = import_module(self._shown_by).plot(self)
        return figure

    def _repr_html_(self) -> str:
        return markdown_as_html(self.summary()) + figure_as_html(self.plot())


def markdown_as_html(text: str) -> str:
    """Markdown as HTML; tags in it are text."""
    from markdown_it import MarkdownIt

    html: str = MarkdownIt("js-default").render(text)
    return html


def figure_as_html(figure: Figure, *, alt: str = "") -> str:
    """A figure as vector graphics inside HTML; `alt` says what it shows to those who cannot see it."""
    import matplotlib as mpl

    buffer = io.BytesIO()
    # Without a date and with a fixed salt the same figure is the same text.
    with mpl.rc_context({"svg.hashsalt": "pyjoystick"}):
        figure.savefig(buffer, format="svg", metadata={"Date": None})
    data = base64.b64encode(buffer.getvalue()).decode("ascii")
    return f'<img src="data:image/svg+xml;base64,{data}" alt="{escape(alt)}">'


def is_notebook() -> bool:
    """Whether this program runs in a notebook's kernel."""
    return type(_shell()).__name__ == "ZMQInteractiveShell"


def show_figures() -> None:
    """Have a notebook draw Matplotlib's figures, as ``%matplotlib inline`` does for those of pyplot."""
    if not is_notebook():
        return
    from matplotlib.figure import Figure

    shell = _shell()
    formatters = shell.display_formatter.formatters
    if not any(Figure in formatters[kind].type_printers for kind in ("image/png", "image/svg+xml")):
        import_module("IPython.core.pylabtools").select_figure_formats(shell, {"png"})


def _shell() -> Any:
    """What runs the cells of a notebook; None elsewhere."""
    module = sys.modules.get("IPython")
    return None if module is None else module.get_ipython()


@contextmanager
def notebook_progress(what: str) -> Iterator[Tell]:
    """Return a function that shows progress: in a notebook a bar, removed at the end; elsewhere nothing.

    Args:
        what: the work, in a word or two
    """
    if not is_notebook():
        yield lambda stage, done, total: None
        return
    display: Any = import_module("IPython.display")
    begun, shown, handle = clock.monotonic(), 0.0, None

    def tell(stage: str, done: int, total: int) -> None:
        nonlocal shown, handle
        now = clock.monotonic()
        if now - begun < _PATIENCE or now - shown < _INTERVAL:
            return
        shown = now
        bar = f'<progress value="{done}" max="{total}"></progress>' if total > 1 else "<progress></progress>"
        text = " ".join(filter(None, (what, stage)))
        content = display.HTML(f"{bar} {escape(text)}, {now - begun:.0f} s")
        if handle is None:
            handle = display.display(content, display_id=True)
        else:
            handle.update(content)

    try:
        yield tell
    finally:
        if handle is not None:
            handle.update(display.HTML(""))
