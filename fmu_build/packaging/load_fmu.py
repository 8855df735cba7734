"""Script: load the library of an unpacked FMU and instantiate it once as each of the given FMI types.

Usage: python load_fmu.py FOLDER {me,cs}...    Exit code 0 on success.
"""

from __future__ import annotations

import sys

from fmpy import read_model_description
from fmpy.fmi2 import FMU2Model, FMU2Slave
from fmpy.fmi3 import FMU3Model, FMU3Slave

_CLASSES = {"2.0": (FMU2Model, FMU2Slave), "3.0": (FMU3Model, FMU3Slave)}


def load(folder: str, fmi_types: list[str]) -> None:
    """Load and instantiate the FMU; FMPy's errors, such as a rejected GUID, propagate."""
    description = read_model_description(folder, validate=False)
    model_class, slave_class = _CLASSES[description.fmiVersion]
    interfaces = {
        "me": (model_class, description.modelExchange),
        "cs": (slave_class, description.coSimulation),
    }
    for fmi_type in fmi_types:
        fmu_class, interface = interfaces[fmi_type]
        if interface is None:
            raise ValueError(f"the FMU lacks the FMI type {fmi_type!r}")
        fmu = fmu_class(
            guid=description.guid,
            unzipDirectory=folder,
            modelIdentifier=interface.modelIdentifier,
            instanceName="check",
        )
        fmu.instantiate()
        fmu.freeInstance()


if __name__ == "__main__":
    try:
        load(sys.argv[1], sys.argv[2:])
    except Exception as error:  # FMPy raises bare Exception
        sys.exit(f"{type(error).__name__}: {error}")
