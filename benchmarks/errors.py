"""The error of the benchmarks."""

from __future__ import annotations


class BenchmarkError(Exception):
    """A program cannot be built or run, or its results differ from those checked before."""
