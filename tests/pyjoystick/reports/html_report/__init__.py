"""Tests of pyjoystick.reports.html_report."""
