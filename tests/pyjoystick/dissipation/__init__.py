"""Tests of pyjoystick.dissipation."""
