"""Experiment design: which experiments determine the parameters best."""
