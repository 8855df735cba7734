"""Tests of the peaks of noisy records."""
