"""Models that the code generator writes, as C for the fuzzer and the sanitizers; no FMU is packed."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Final

from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.description import GeneratedModel
from fmu_build.support.request import BuildRequest, SensitivityRequest

_TESTS: Final = Path(__file__).parents[1] / "fmu_build"
_MODELS: Final = _TESTS / "models"
_TABLES: Final = _TESTS / "codegen" / "modelica_source" / "tables"


@dataclass(frozen=True)
class _Source:
    """Where a model is, and the derivatives that it computes."""

    model: str
    libraries: tuple[Path, ...]
    sensitivity: str | None = None


_SOURCES: Final = {
    "sensitivities": _Source("Moving.Ball", (_TESTS / "sensitivities" / "Moving.mo",), "h,v:start,g,e,floor"),
    "friction": _Source("Friction.Block", (_MODELS / "Friction.mo",)),
    "sampled": _Source("Sampling.SampledPI", (_MODELS / "Sampling.mo",)),
    "state_events": _Source("StateEvents.Thresholds", (_MODELS / "StateEvents.mo",)),
    "functions": _Source("Functions.Rotation", (_MODELS / "Functions.mo",)),
    "loops": _Source("Algebraic.DiodeBridge", (_MODELS / "Algebraic.mo",)),
    "inputs": _Source("Oscillators.SwitchedInput", (_MODELS / "Oscillators.mo",)),
    "tables": _Source("Tables.Spring", (_TABLES / "Tables.mo", _TABLES / "library" / "Modelica.mo")),
}
GENERATED: Final = tuple(_SOURCES)


@cache
def generated(name: str) -> GeneratedModel:
    """The C of one of `GENERATED`, and what is in it."""
    source = _SOURCES[name]
    sensitivity = None if source.sensitivity is None else SensitivityRequest.parse(source.sensitivity)
    first, *further = source.libraries
    request = BuildRequest(source.model, Path(), first, sensitivity=sensitivity, further=further)
    return generate_model(request)[0]
