"""Fuzzing: random FMI calls in C, and damaged files for every reader."""
