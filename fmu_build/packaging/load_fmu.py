"""Script: load an FMU's library and instantiate it once as each of the given FMI types.

Usage: python load_fmu.py FMU {me,cs}...    Exit code 0 where everything worked.
"""

from __future__ import annotations

import shutil
import sys

from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Model, FMU2Slave


def load(path: str, fmi_types: list[str]) -> None:
    """Raises whatever FMPy raises for a library that does not load or refuses the GUID."""
    description = read_model_description(path)
    folder = extract(path)
    try:
        for fmi_type in fmi_types:
            fmu_class, interface = {
                "me": (FMU2Model, description.modelExchange),
                "cs": (FMU2Slave, description.coSimulation),
            }[fmi_type]
            fmu = fmu_class(
                guid=description.guid,
                unzipDirectory=folder,
                modelIdentifier=interface.modelIdentifier,
                instanceName="check",
            )
            fmu.instantiate()
            fmu.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    try:
        load(sys.argv[1], sys.argv[2:])
    except Exception as error:  # noqa: BLE001 - FMPy raises bare Exception; the process ends here anyway
        sys.exit(f"{type(error).__name__}: {error}")
