"""Text from Modelica sources in XML and HTML."""

from __future__ import annotations

import re

_NOT_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")


def xml_text(text: str) -> str:
    """The text with a space for each character that XML 1.0 has no form for, not even an escaped one."""
    return _NOT_XML.sub(" ", text)
