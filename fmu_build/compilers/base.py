"""The interface that every Modelica compiler backend implements."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

from fmu_build.support.request import BuildRequest, BuildResult


class Compiler(Protocol):
    """A Modelica compiler that can make FMUs."""

    name: str
    options: Mapping[str, str]
    """The names of the options that `BuildRequest.options` may have for it, each with what it means."""

    def version(self) -> str:
        """The version of the installed compiler; raises `ToolchainError` where it is not installed."""
        ...

    def build(self, request: BuildRequest) -> BuildResult:
        """Build the FMU or raise a `BuildError`; on an error, no file is left or replaced."""
        ...
