from .claims.claim import Claim as Claim, Finding as Finding, Verdict as Verdict
from .claims.document import (
    CHAPTERS as CHAPTERS,
    claims_page as claims_page,
    findings as findings,
    text_of as text_of,
)
from .claims.workbench import Workbench as Workbench
from .html_report.page import (
    Section as Section,
    figure as figure,
    page as page,
    paragraph as paragraph,
    table as table,
)
from .html_report.report import joystick_report as joystick_report
from .html_report.study import Study as Study
