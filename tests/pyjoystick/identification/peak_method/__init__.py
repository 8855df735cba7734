"""Tests of the peak method."""
