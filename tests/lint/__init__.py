"""Checks that `make lint` runs in addition to ruff and mypy."""
