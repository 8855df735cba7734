"""The request for a build and its result, common to all compilers."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, get_args

from fmu_build.support.errors import BuildError

FmiVersion = Literal["2.0", "3.0"]
FmiType = Literal["me", "cs"]


ALL = "all"
"""In a request for sensitivities: every Real output, or every Real parameter that can be set."""


@dataclass(frozen=True, slots=True)
class SensitivityRequest:
    """Derivatives of variables by parameters, along the whole run and through its events."""

    variables: tuple[str, ...]
    parameters: tuple[str, ...]

    @classmethod
    def parse(cls, text: str) -> SensitivityRequest:
        """Read ``theta,omega:damping.C,J``; commas within brackets (``a[1,2]``) belong to a name.

        Raises `BuildError` unless both sides of the colon name something.
        """
        left, colon, right = text.partition(":")
        sides = [tuple(name.strip() for name in re.split(r",(?![^\[]*\])", side)) for side in (left, right)]
        if not colon or not all(all(side) for side in sides):
            raise BuildError(
                f"sensitivities {text!r}: use VARIABLES:PARAMETERS, such as theta,omega:J,damping.C; "
                f"{ALL!r} means every Real output, or every Real parameter"
            )
        return cls(*sides)


def _ignore(stage: str) -> None:
    pass


@dataclass(frozen=True, slots=True)
class BuildRequest:
    """A request to build an FMU.

    `model` is a qualified Modelica class name; `library` is the Modelica file or package folder that declares
    it (default: the PreloadedSprings library of this project, or a library in MODELICAPATH); `further` are
    other libraries, any of which may declare the model, too; `output` is the folder that receives
    ``<last part of the class name>.fmu``.
    """

    model: str
    output: Path
    library: Path | None = None
    fmi_version: FmiVersion = "2.0"
    fmi_types: Sequence[FmiType] = ("me", "cs")
    platforms: Sequence[str] = field(default_factory=tuple)
    """Platform tuples such as ``aarch64-linux``, FMI 2's names such as ``win64``, or ``all``; empty means the
    host's."""
    options: Mapping[str, str] = field(default_factory=dict)
    """Options specific to the compiler, by name; see `Compiler.options`."""
    sensitivity: SensitivityRequest | None = None
    """Sensitivities for the FMU to compute; not supported by all compilers."""
    on_stage: Callable[[str], None] = _ignore
    """Called with a short text, such as ``generating C``, when a stage of the build begins."""
    further: Sequence[Path] = field(default_factory=tuple)

    @property
    def libraries(self) -> tuple[Path, ...]:
        """The libraries that were given, in this order."""
        return (*(() if self.library is None else (self.library,)), *self.further)


def check_fmi(request: BuildRequest) -> None:
    """Raise `BuildError` for an unknown FMI version or type."""
    versions, types = get_args(FmiVersion), get_args(FmiType)
    if request.fmi_version not in versions:
        raise BuildError(
            f"unknown FMI version {request.fmi_version!r}; use {' or '.join(map(repr, versions))}"
        )
    if not request.fmi_types or not set(request.fmi_types) <= set(types):
        raise BuildError(f"FMI types {list(request.fmi_types)!r}: use 'me', 'cs' or both")


@dataclass(frozen=True, slots=True)
class BuildResult:
    """A finished FMU: its path, the compiler that built it, the log, and the time that the build took."""

    path: Path
    compiler: str
    compiler_version: str
    log: str
    seconds: float
