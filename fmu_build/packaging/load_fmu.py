"""Script: load the library of an unpacked FMU and instantiate it once as each of the given FMI types.

Usage: python load_fmu.py FOLDER {me,cs}...    Exit code 0 where everything worked.
"""

from __future__ import annotations

import sys

from fmpy import read_model_description
from fmpy.fmi2 import FMU2Model, FMU2Slave


def load(folder: str, fmi_types: list[str]) -> None:
    """Raises whatever FMPy raises for a library that does not load or refuses the GUID."""
    description = read_model_description(folder)
    interfaces = {
        "me": (FMU2Model, description.modelExchange),
        "cs": (FMU2Slave, description.coSimulation),
    }
    for fmi_type in fmi_types:
        fmu_class, interface = interfaces[fmi_type]
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
