"""Tests of pyjoystick.reports.claims."""
