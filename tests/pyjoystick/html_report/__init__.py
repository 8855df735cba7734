"""Tests of pyjoystick.html_report."""
