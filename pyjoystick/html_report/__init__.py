"""A report on a joystick as one page of HTML that can be sent on: figures, tables, parameters, versions."""

from pyjoystick.html_report.page import Section, figure, page, paragraph, table
from pyjoystick.html_report.report import joystick_report
from pyjoystick.html_report.study import Study

__all__ = ["Section", "Study", "figure", "joystick_report", "page", "paragraph", "table"]
