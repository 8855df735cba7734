"""Tests of pyjoystick.model.undamped_period."""
