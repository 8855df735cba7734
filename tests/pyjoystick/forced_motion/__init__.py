"""Tests of forced motion."""
