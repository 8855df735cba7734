"""Tests of the translation of Modelica functions to C."""
