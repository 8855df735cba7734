"""Several FMUs as one system: its description, SSP archives, and a master that runs it by co-simulation."""

from pyjoystick.coupling.archive import read_ssp, write_ssp
from pyjoystick.coupling.errors import CouplingError
from pyjoystick.coupling.joystick import operator_and_joystick
from pyjoystick.coupling.master import run_coupled
from pyjoystick.coupling.schemes import SCHEMES
from pyjoystick.coupling.step_errors import coupling_errors, orders
from pyjoystick.coupling.system import Component, Connection, CoupledSystem

__all__ = [
    "SCHEMES",
    "Component",
    "Connection",
    "CoupledSystem",
    "CouplingError",
    "coupling_errors",
    "operator_and_joystick",
    "orders",
    "read_ssp",
    "run_coupled",
    "write_ssp",
]
