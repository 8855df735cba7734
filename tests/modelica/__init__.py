"""Tests of the Modelica library alone: its text, its compiled models, and their simulation."""
