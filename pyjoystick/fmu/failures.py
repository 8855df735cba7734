"""Conversion of a failed call to an error."""

from __future__ import annotations

from typing import Final

import numpy as np

from pyjoystick.fmu.errors import THE_END, FmuEndedError, FmuRunError
from pyjoystick.fmu.instance import Instance
from pyjoystick.fmu.interface import CInterface
from pyjoystick.fmu.stepping.program import DISCARD, EARLY, ENDED, FUNCTION, REACHED, STEP, Workspace

_LABELS: Final = ("ok", "warning", "discard", "error", "fatal", "pending")


def failure(
    instance: Instance, workspace: Workspace, interface: CInterface, status: int, reached: float
) -> FmuRunError:
    """Make the error for a bad status of the last function called.

    Args:
        instance: the instance
        workspace: its workspace
        interface: the FMI functions
        status: status from `stepping.program`
        reached: the last communication point (s)
    """
    function = interface.functions[workspace.place[FUNCTION]]
    path, messages = instance.description.path, tuple(instance.log.messages())
    ended = _end_of_run(instance, workspace, status, reached)
    if ended is not None:
        return FmuEndedError(ended, THE_END, path, messages)
    if status == EARLY:
        reason = f"{function} came back at t = {_told(workspace):.9g} s, before the end of the step"
        return FmuRunError(reached, reason, path, messages)
    label = _LABELS[status] if 0 <= status < len(_LABELS) else "not a status"
    return FmuRunError(reached, f"{function} failed with status {status} ({label})", path, messages)


def _end_of_run(instance: Instance, workspace: Workspace, status: int, begin: float) -> float | None:
    """Time at which the FMU terminated the run in the step from `begin` (s); None if it did not."""
    if status == ENDED:
        return max(begin, _told(workspace))
    is_discarded = status == DISCARD and workspace.place[FUNCTION] == STEP
    return instance.end_of_run(begin) if is_discarded else None


def _told(workspace: Workspace) -> float:
    """Time (s) that the FMU reports to have reached in the last step."""
    return float(workspace.flags.view(np.float64)[REACHED // 8])
