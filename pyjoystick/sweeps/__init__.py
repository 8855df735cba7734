"""Sweeps: many runs of an FMU over parameters, on the cores of this machine or a Dask cluster."""

from pyjoystick.errors import SettingsError
from pyjoystick.sweeps.design import Sampling, design
from pyjoystick.sweeps.errors import (
    ChangedSweepError,
    ClusterError,
    MissingPackageError,
    SensitivityError,
    SweepFileError,
)
from pyjoystick.sweeps.files import read_sweep
from pyjoystick.sweeps.runner import Outcome, run_sweep
from pyjoystick.sweeps.sensitivity import sensitivity
from pyjoystick.sweeps.settings import Settings, read_settings
from pyjoystick.sweeps.sweep import Sweep

__all__ = [
    "ChangedSweepError",
    "ClusterError",
    "MissingPackageError",
    "Outcome",
    "Sampling",
    "SensitivityError",
    "Settings",
    "SettingsError",
    "Sweep",
    "SweepFileError",
    "design",
    "read_settings",
    "read_sweep",
    "run_sweep",
    "sensitivity",
]
