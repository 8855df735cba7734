"""Modelica source as text: its classes, the constructs in them, and positions for messages."""
