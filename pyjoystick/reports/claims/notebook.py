"""Display of the paper's claims in notebooks."""

from __future__ import annotations

import re

from pyjoystick.reports.claims.document import Findings, claims_page


def summary(found: Findings) -> str:
    """The page without the remark for editors."""
    return re.sub(r"<!--.*?-->\n+", "", claims_page(found))
