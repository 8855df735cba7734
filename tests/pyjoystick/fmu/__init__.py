"""Tests of finding, describing and running FMUs."""
