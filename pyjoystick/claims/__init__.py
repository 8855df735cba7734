"""The paper's statements, each checked by a small function that computes numbers and decides by them."""

from pyjoystick.claims.claim import Claim, Finding, Verdict
from pyjoystick.claims.document import CHAPTERS, claims_page, findings, text_of
from pyjoystick.claims.workbench import Workbench

__all__ = ["CHAPTERS", "Claim", "Finding", "Verdict", "Workbench", "claims_page", "findings", "text_of"]
