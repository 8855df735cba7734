"""Docstrings as this project writes them: Google's sections, code in backticks, everything else plain text.

Types are in the annotations, so that a colon within a docstring is a colon.
"""

from __future__ import annotations

import re

from sphinx.application import Sphinx
from sphinx.ext.napoleon.docstring import GoogleDocstring
from sphinx.util.typing import ExtensionMetadata

_CODE = re.compile(r"(``.+?``|`[^`]+`)")
#: What would begin a substitution, an emphasis or a reference: ``|theta|``, ``*args``, ``n_``.
_MARKS = re.compile(r"[|*]|(?<=\w)_(?!\w)")
#: How Sphinx writes an alias that stands within another type.
_ALIAS = re.compile(r"TypeAliasForwardRef\('([\w.]+)'\)")


class _Docstring(GoogleDocstring):
    def _consume_returns_section(self, preprocess_types: bool = False) -> list[tuple[str, str, list[str]]]:
        lines = self._dedent(self._consume_to_next_section())
        return [("", "", lines)] if lines else []

    def _parse_attributes_section(self, section: str) -> list[str]:
        """A plain list: the types are in the signature, and a row may have several names."""
        rows = [":Attributes:"]
        for name, _, description in self._consume_fields():
            rows += self._format_block("    - ", [f"**{name}**: {description[0]}", *description[1:]])
        return [*rows, ""]

    def _parse_raises_section(self, section: str) -> list[str]:
        """Errors with what they mean, or words alone, as in "as `fit`"."""
        rows = []
        for _, kinds, description in self._consume_fields(parse_type=False, prefer_type=True):
            named = any(description)
            rows += self._format_block(
                f":raises {kinds}: " if named else ":raises: ", description if named else [kinds]
            )
        return [*rows, ""]


def setup(app: Sphinx) -> ExtensionMetadata:
    """Have every docstring read this way."""
    app.connect("autodoc-process-docstring", _process)
    app.connect("autodoc-process-signature", _readable)
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _process(app: Sphinx, what: str, name: str, obj: object, options: object, lines: list[str]) -> None:
    # Of an attribute, "what" would have napoleon take the words before the first colon for a type.
    lines[:] = _Docstring([escaped(line) for line in lines], None, None, "method", name, obj).lines()


def escaped(line: str) -> str:
    """A line of a docstring as reStructuredText: what is not code is plain text."""
    parts = _CODE.split(line)
    parts[::2] = [_MARKS.sub(r"\\\g<0>", plain) for plain in parts[::2]]
    return "".join(parts)


def _readable(
    app: Sphinx,
    what: str,
    name: str,
    obj: object,
    options: object,
    signature: str | None,
    returns: str | None,
) -> tuple[str | None, str | None]:
    if signature:
        # The default of a field that has a factory is no Python, and would leave the signature without links.
        signature = _ALIAS.sub(r"\1", signature).replace("<factory>", "...")
    return signature, returns and _ALIAS.sub(r"\1", returns)
