"""How a notebook shows the paper's claims."""

from __future__ import annotations

import re

from pyjoystick.reports.claims.document import Findings, claims_page


def summary(found: Findings) -> str:
    """The page without the remark for those who would edit it."""
    return re.sub(r"<!--.*?-->\n+", "", claims_page(found))
