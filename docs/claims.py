"""Write docs/claims.md, as ``make claims`` does."""

from __future__ import annotations

from pathlib import Path

from pyjoystick.reports import claims_page, findings
from pyjoystick.support import write_text

write_text(Path(__file__).with_suffix(".md"), claims_page(findings()))
