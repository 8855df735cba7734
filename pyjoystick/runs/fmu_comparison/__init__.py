"""Comparison of two FMUs of the same model, for example from different compilers."""
