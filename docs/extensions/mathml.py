r"""Formulas as MathML, which browsers draw themselves: no script, no network.

A formula may end in ``\tag{5}``, as GitHub has it too: its number stands at the right margin.
"""

from __future__ import annotations

import re

from docutils import nodes
from docutils.utils.math import latex2mathml
from sphinx.application import Sphinx
from sphinx.util.typing import ExtensionMetadata
from sphinx.writers.html5 import HTML5Translator

_TAG = re.compile(r"\\tag\{([^}]*)\}")
#: What browsers set with wrong spaces: the invisible operator between a function and its argument has none,
#: the bars of a magnitude have some on both sides.
_SPACES = (
    (re.compile(r"<mo>&ApplyFunction;</mo>(?!\s*<mo[^>]*>\()"), '<mspace width="0.17em"></mspace>'),
    (re.compile(r'<mo class="mathopen">\|</mo>'), '<mo form="prefix" stretchy="false">|</mo>'),
    (re.compile(r"<mo>\|</mo>"), '<mo form="postfix" stretchy="false">|</mo>'),
)


def setup(app: Sphinx) -> ExtensionMetadata:
    """Make ``mathml`` known as a renderer of formulas."""
    app.add_html_math_renderer("mathml", (_visit_inline, None), (_visit_block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _visit_inline(translator: HTML5Translator, node: nodes.Element) -> None:
    translator.body.append(_mathml(node.astext(), as_block=False))
    raise nodes.SkipNode


def _visit_block(translator: HTML5Translator, node: nodes.Element) -> None:
    text = node.astext()
    formula = _mathml(_TAG.sub("", text).strip(), as_block=True)
    number = "".join(f'<span class="eqno">({tag})</span>' for tag in _TAG.findall(text))
    translator.body.append(f'<div class="formula">{formula}{number}</div>\n')
    raise nodes.SkipNode


def _mathml(text: str, *, as_block: bool) -> str:
    formula: str = latex2mathml.tex2mathml(text, as_block=as_block)
    for wrong, right in _SPACES:
        formula = wrong.sub(right, formula)
    return formula
