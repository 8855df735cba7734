"""Tests of pyjoystick.model.dissipation."""
