"""Modelica source as text: its classes, the constructs in them, and places for messages."""
