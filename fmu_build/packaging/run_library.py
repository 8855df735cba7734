"""Script: run the library of an FMU for Co-Simulation over given communication points.

Usage: python run_library.py FILE    The file contains the request as a JSON object (see `default_run`); it is
overwritten with the values of the outputs at each point and of all variables at some. Exit code 0 on success.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from fmpy.fmi2 import FMU2Slave
from fmpy.fmi3 import FMU3Slave

_GETTERS = {
    "2.0": {"Real": "getReal", "Integer": "getInteger", "Boolean": "getBoolean", "Enumeration": "getInteger"},
    "3.0": {"Real": "getFloat64", "Integer": "getInt32", "Boolean": "getBoolean", "Enumeration": "getInt64"},
}
_REAL_SETTERS = {"2.0": "setReal", "3.0": "setFloat64"}


def run(asked: dict[str, Any]) -> dict[str, list[list[float]]]:
    """Return the outputs at each of the points, and all variables at some; errors of FMPy propagate."""
    version, points = asked["version"], asked["points"]
    experiment = {"tolerance": asked["tolerance"], "startTime": points[0], "stopTime": points[-1]}
    slave = (FMU2Slave if version == "2.0" else FMU3Slave)(
        guid=asked["guid"],
        modelIdentifier=asked["identifier"],
        unzipDirectory=asked["folder"],
        libraryPath=asked["library"],
        instanceName=asked["identifier"],
    )
    slave.instantiate()
    if version == "2.0":
        slave.setupExperiment(**experiment)
        slave.enterInitializationMode()
    else:
        slave.enterInitializationMode(**experiment)
    set_reals = getattr(slave, _REAL_SETTERS[version])
    getters = [(getattr(slave, _GETTERS[version][kind]), reference) for kind, reference in asked["outputs"]]
    every = [(getattr(slave, _GETTERS[version][kind]), reference) for kind, reference in asked["all"]]
    rows, snapshots = [], []
    for index, (point, inputs) in enumerate(zip(points, asked["inputs"], strict=True)):
        if index:
            slave.doStep(points[index - 1], point - points[index - 1])
            rows.append([float(get([reference])[0]) for get, reference in getters])
            if index in asked["snapshots"]:
                snapshots.append([float(get([reference])[0]) for get, reference in every])
        if inputs:
            set_reals(asked["input_references"], inputs)
        if not index:
            slave.exitInitializationMode()
            rows.append([float(get([reference])[0]) for get, reference in getters])
            snapshots.append([float(get([reference])[0]) for get, reference in every])
    slave.terminate()
    slave.freeInstance()
    return {"rows": rows, "snapshots": snapshots}


if __name__ == "__main__":
    file = Path(sys.argv[1])
    try:
        file.write_text(json.dumps(run(json.loads(file.read_text("utf-8")))), "utf-8")
    except Exception as error:  # FMPy raises bare Exception
        sys.exit(f"{type(error).__name__}: {error}")
