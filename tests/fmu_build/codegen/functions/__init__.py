"""Tests of Modelica functions as C functions."""
