"""Build FMUs from Modelica models, with tools that pip installs.

>>> from fmu_build import build_fmu
>>> result = build_fmu("PreloadedSprings.Joystick.Joystick", "build/fmi2")  # doctest: +SKIP
>>> result.path  # doctest: +SKIP
PosixPath('build/fmi2/Joystick.fmu')
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from os import PathLike
from pathlib import Path

from fmu_build.compilers import build, compiler_names
from fmu_build.support.errors import (
    BuildError,
    ModelicaError,
    ModelNotFoundError,
    ToolchainError,
    UnknownCompilerError,
    UnsupportedModelError,
)
from fmu_build.support.request import BuildRequest, BuildResult, FmiType, FmiVersion, SensitivityRequest

__all__ = [
    "BuildError",
    "BuildResult",
    "FmiType",
    "FmiVersion",
    "ModelNotFoundError",
    "ModelicaError",
    "ToolchainError",
    "UnknownCompilerError",
    "UnsupportedModelError",
    "build_fmu",
    "compiler_names",
]


def build_fmu(
    model: str,
    output: str | PathLike[str],
    *,
    compiler: str = "rumoca",
    library: str | PathLike[str] | Sequence[str | PathLike[str]] | None = None,
    fmi_version: FmiVersion = "2.0",
    fmi_types: Sequence[FmiType] = ("me", "cs"),
    platforms: Sequence[str] = (),
    options: Mapping[str, str] | None = None,
    sensitivity: str | None = None,
    on_stage: Callable[[str], None] | None = None,
) -> BuildResult:
    """Build the FMU of a Modelica model.

    Args:
        model: qualified class name, such as ``PreloadedSprings.Joystick.Joystick``.
        output: folder that receives ``<last part of the class name>.fmu``; created if it is missing.
        compiler: name of the Modelica compiler; see `compiler_names`.
        library: Modelica file or package folder with the model; the PreloadedSprings library by default.
            Several, if the model uses others that are neither beside its own nor in MODELICAPATH.
            A library of your own may use PreloadedSprings without naming it here.
        fmi_version: version of the FMI standard; some versions of OpenModelica cannot build 3.0.
        fmi_types: Model Exchange, Co-Simulation, or both in one FMU.
        platforms: platform tuples such as ``aarch64-linux``, FMI 2's names such as ``win64``, or ``all``;
            this machine's by default.
        options: settings of the chosen compiler by name; docs/compilers.md lists them.
        sensitivity: derivatives that the FMU computes along its runs, as ``theta,omega:J,damping.C``:
            variables, a colon, parameters; docs/sensitivities.md. With rumoca only.
        on_stage: called with a short text when a stage of the build begins.

    Raises:
        BuildError: its subclasses and messages name the fault and its place. The output folder is then
            left unchanged.
    """
    given = () if library is None else (library,) if isinstance(library, str | PathLike) else library
    libraries = tuple(map(Path, given))
    request = BuildRequest(
        model=model,
        output=Path(output),
        library=libraries[0] if libraries else None,
        further=libraries[1:],
        fmi_version=fmi_version,
        fmi_types=tuple(fmi_types),
        platforms=tuple(platforms),
        options=dict(options or {}),
        sensitivity=None if sensitivity is None else SensitivityRequest.parse(sensitivity),
    )
    if on_stage is not None:
        request = replace(request, on_stage=on_stage)
    return build(compiler, request)
