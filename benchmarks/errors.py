"""What stops the benchmark."""

from __future__ import annotations


class BenchmarkError(Exception):
    """A program cannot be built or run, or gives other results than those that were checked."""
