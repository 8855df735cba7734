"""Modelica source as text: its classes, the constructs that occur in them, places in messages."""
