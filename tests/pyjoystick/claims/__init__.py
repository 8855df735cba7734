"""Tests of pyjoystick.claims."""
