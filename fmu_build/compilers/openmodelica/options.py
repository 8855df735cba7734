"""Options of the OpenModelica backend."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from fmu_build.support.errors import BuildError

OPTIONS = {
    "omc": "path of omc, or of an OpenModelica installation (default: OPENMODELICAHOME, then PATH)",
    "port-file": "port file of a running omc server, which is left running",
    "docker": "name of a Docker image with omc in it",
    "timeout": "longest time for one answer of omc in seconds (default: 1800)",
    "cs-solver": "integrator in co-simulation, if omc offers a choice: cvode (default) or euler",
}
_SOLVERS = ("cvode", "euler")
_TIMEOUT = 1800.0
_PLACES = ("omc", "port-file", "docker")


@dataclass(frozen=True, slots=True)
class Options:
    """The location of omc (at most one of the first three fields is set), and how to use it."""

    omc: Path | None = None
    port_file: Path | None = None
    docker: str | None = None
    timeout: float = _TIMEOUT
    cs_solver: str = "cvode"


def read_options(given: Mapping[str, str]) -> Options:
    """Parse the options from their names and texts; raises `BuildError` for an invalid value."""
    places = [name for name in _PLACES if name in given]
    if len(places) > 1:
        raise BuildError(f"the options {' and '.join(places)} exclude each other: each names the omc to use")
    empty = [name for name, value in given.items() if not value]
    if empty:
        raise BuildError(f"the option {empty[0]} has no value; it takes the {OPTIONS[empty[0]]}")
    return Options(
        omc=Path(given["omc"]) if "omc" in given else None,
        port_file=Path(given["port-file"]) if "port-file" in given else None,
        docker=given.get("docker"),
        timeout=_seconds(given["timeout"]) if "timeout" in given else _TIMEOUT,
        cs_solver=_solver(given.get("cs-solver", "cvode")),
    )


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = math.nan
    if not 0.0 < seconds < math.inf:
        raise BuildError(f"timeout={text}: the option takes a positive number of seconds")
    return seconds


def _solver(text: str) -> str:
    if text not in _SOLVERS:
        raise BuildError(f"cs-solver={text}: the option takes {' or '.join(_SOLVERS)}")
    return text
