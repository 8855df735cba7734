"""Tests of pyjoystick.undamped_period."""
