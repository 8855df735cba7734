"""Modelica source as text, where the compiler does not hand on what is in it."""

from __future__ import annotations

import re

STRING = r'"(?:[^"\\]|\\.)*"'
_SKIPPED = re.compile(rf"{STRING}|//[^\n]*|/\*.*?\*/", re.DOTALL)


def blanked(text: str) -> str:
    """The text with spaces for comments and strings, so that places and lines stay what they are."""
    return _SKIPPED.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)
