"""Names of pages such as ``docs/fitting.md`` in docstrings, changelog and generated text become links."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

from docutils import nodes
from sphinx import addnodes
from sphinx.application import Sphinx
from sphinx.util.typing import ExtensionMetadata

_PAGE = re.compile(r"docs/(?P<page>[\w/-]+)\.md")


def setup(app: Sphinx) -> ExtensionMetadata:
    """Have every page searched after it is read."""
    app.connect("doctree-read", _link_pages)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _link_pages(app: Sphinx, document: nodes.document) -> None:
    source = Path(app.srcdir)
    for text in list(document.findall(nodes.Text)):
        # A name in code type is linked if it is all that stands there.
        replaced = text.parent if isinstance(text.parent, nodes.literal) else text
        if isinstance(replaced, nodes.literal) and not _PAGE.fullmatch(text):
            continue
        if _PAGE.search(text) and not _stays(replaced):
            replaced.parent.replace(replaced, list(_with_links(text, source, app.env.docname)))


def _stays(node: nodes.Node) -> bool:
    """Whether a link may not stand there: in a link, or in code."""
    while node.parent is not None:
        node = node.parent
        if isinstance(node, nodes.reference | nodes.literal | nodes.literal_block | addnodes.pending_xref):
            return True
    return False


def _with_links(text: str, source: Path, docname: str) -> Iterator[nodes.Node]:
    """The text with a link in place of each page that is there, by the title of the page."""
    end = 0
    for match in _PAGE.finditer(text):
        if not (source / f"{match['page']}.md").is_file():
            continue
        if match.start() > end:
            yield nodes.Text(text[end : match.start()])
        end = match.end()
        link = addnodes.pending_xref(
            refdomain="std",
            reftype="doc",
            reftarget=f"/{match['page']}",
            refdoc=docname,
            refexplicit=False,
            refwarn=True,
        )
        link += nodes.inline(match["page"], match["page"])
        yield link
    if text[end:]:
        yield nodes.Text(text[end:])
