"""The interface that every Modelica compiler backend implements."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from fmu_build.support.request import BuildRequest, BuildResult


class Compiler(Protocol):
    """A Modelica compiler that builds FMUs."""

    name: str
    options: Mapping[str, str]
    """The options of this compiler in `BuildRequest.options`: names and descriptions."""
    computes_sensitivities: bool
    """Whether the compiler supports `BuildRequest.sensitivity`."""

    def version(self) -> str:
        """Return the version of the installed compiler; raises `ToolchainError` if it is not installed."""
        ...

    def build(self, request: BuildRequest) -> BuildResult:
        """Build the FMU; on failure, raise a `BuildError` and leave all files unchanged."""
        ...
