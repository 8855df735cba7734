"""The directive ``modelica-library``: a Modelica library of the project, class by class."""

from __future__ import annotations

import re
from html import escape
from pathlib import Path
from typing import Final

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective
from sphinx.util.typing import ExtensionMetadata

from extensions.modelica_library import ModelicaClass, Parameter, read_packages

LIBRARIES: Final = Path(__file__).parents[2] / "modelica"


class ModelicaLibrary(SphinxDirective):
    """A section for each package, and in it one for each class: its documentation and parameters.

    The argument is the name of the library.
    """

    required_arguments = 1

    def run(self) -> list[nodes.Node]:
        """The sections."""
        sections: list[nodes.Node] = []
        for package, *classes in read_packages(LIBRARIES / self.arguments[0]):
            section = _section(package, package.name)
            section.extend(_section(one, one.name.rpartition(".")[2]) for one in classes)
            sections.append(section)
        return sections


def _section(described: ModelicaClass, title: str) -> nodes.section:
    section = nodes.section(ids=[nodes.make_id(described.name)], names=[described.name])
    section += nodes.title(text=title)
    summary = nodes.paragraph()
    summary += nodes.emphasis(text=described.kind)
    summary += nodes.Text(f": {described.description}")
    section += summary
    section += nodes.raw(text=_html(described.documentation), format="html")
    if described.parameters:
        section += nodes.raw(text=_table(described.parameters), format="html")
    return section


def _html(documentation: str) -> str:
    """The documentation of a class with its links leading to sections of the same page.

    What the Modelica Standard Library documents has none there: of a link to it, the text remains.
    """
    own = re.sub(r'<a href="modelica://Modelica\b[\w.]*">(.*?)</a>', r"\1", documentation, flags=re.DOTALL)
    linked = re.sub(r'href="modelica://([\w.]+)"', lambda link: f'href="#{nodes.make_id(link[1])}"', own)
    # The site's look for tables instead of the attributes that Modelica tools need.
    return re.sub(r"<table[^>]*>", '<table class="docutils">', linked)


def _table(parameters: tuple[Parameter, ...]) -> str:
    rows = "".join(
        f"<tr><td><code>{escape(one.name)}</code></td><td>{escape(one.kind)}</td>"
        f"<td>{escape(one.default)}</td><td>{escape(one.description)}</td></tr>"
        for one in parameters
    )
    head = "<tr><th>parameter</th><th>type</th><th>default</th><th></th></tr>"
    return f'<table class="docutils"><thead>{head}</thead><tbody>{rows}</tbody></table>'


def setup(app: Sphinx) -> ExtensionMetadata:
    """Make the directive known."""
    app.add_directive("modelica-library", ModelicaLibrary)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
