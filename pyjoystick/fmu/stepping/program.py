"""A run in the terms of the machine: addresses, counts and blocks of values, as the kernel reads them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pyjoystick.support import FloatArray

# Places in `Program.functions`; setters and getters follow.
RESET, SETUP, ENTER, EXIT, STEP, TERMINATE, DERIVATIVES = range(7)

# What the functions return, and what the kernel adds.
OK, WARNING, DISCARD, ERROR, FATAL, PENDING = range(6)
#: The FMU ended the run by itself.
ENDED: Final = 101
#: The FMU came back before the end of a step, which it was not allowed to.
EARLY: Final = 102
#: The stop flag was set.
STOPPED: Final = 103
#: The pause flag was set; the run goes on from there.
UNFINISHED: Final = 104
#: The run has taken longer than it may.
LATE: Final = 105

# Places in an array of integers that the kernel keeps up to date: the run, the communication point that was
# reached (`BETWEEN_RUNS` where none is under way), the number of samples taken, the function called last; and
# a flag for others to set, at which the kernel comes back after the step.
RUN, POINT, SAMPLES, FUNCTION, PAUSE = range(5)
#: 128 bytes: two threads that write to one cache line in every step would slow each other down.
PLACE_SIZE: Final = 16
BETWEEN_RUNS: Final = -1

#: Bytes for what fmi3DoStep tells, a cache line of their own.
FLAGS_SIZE: Final = 128
#: Where the time is in it that fmi3DoStep has reached.
REACHED: Final = 24

# How values of an FMU are stored. A whole number or a Boolean has four times its bytes and what it is.
FLOAT64, FLOAT32, TEXT = range(3)
UNSIGNED, SIGNED, BOOLEAN = range(3)


class Group(NamedTuple):
    """Variables that one call sets or gets: their values are neighbors in a row.

    Attributes:
        function: place of the setter or getter in `Program.functions`
        references: address of the value references
        size: number of values
        offset: bytes from the start of the row
        kind: how the values are stored
        surplus: how many more values than variables there are, because of arrays
    """

    function: int
    references: int
    size: int
    offset: int
    kind: int
    surplus: int = 0


#: A group in an array that the compiled kernel reads.
GROUP: Final = np.dtype([(name, np.intp) for name in Group._fields], align=True)


class Program(NamedTuple):
    """What all runs of a plan share. Addresses are those of arrays that the plan keeps alive.

    Attributes:
        version: of FMI, 2 or 3
        functions: addresses of the C functions
        times: communication points (s), shape (points,)
        recorded: whether a sample is taken there, shape (points,)
        tolerance: what the FMU's integrator is asked to keep
        stop_defined: the FMU is told the end of the run
        constants, constants_row: parameters that all runs share, and the address of their row
        varied: parameters that each run gives
        varied_stride: bytes from the row of one run to that of the next
        inputs: inputs that change or are set at the start
        inputs_rows: address of their first row; there is one for each point
        inputs_stride: bytes from row to row
        changed: whether a group of inputs is to be set at a point, shape (points, groups)
        moving: number of inputs whose derivative is given
        moving_references: address of their value references
        moving_orders: address of as many ones
        slopes: address of their derivatives, one row a step
        outputs: what is recorded
        outputs_stride: bytes from sample to sample
        columns: column of each value in a table of samples, in the order of the groups; -1 for none
    """

    version: int
    functions: Sequence[int] | NDArray[np.intp]
    times: Sequence[float] | FloatArray
    recorded: Sequence[bool] | NDArray[np.bool_]
    tolerance: float
    stop_defined: int
    constants: Sequence[Group]
    constants_row: int
    varied: Sequence[Group]
    varied_stride: int
    inputs: Sequence[Group]
    inputs_rows: int
    inputs_stride: int
    changed: Sequence[Sequence[bool]] | NDArray[np.bool_]
    moving: int
    moving_references: int
    moving_orders: int
    slopes: int
    outputs: Sequence[Group]
    outputs_stride: int
    columns: Sequence[int] | NDArray[np.intp]


class Workspace(NamedTuple):
    """What one instance of the FMU has for itself.

    Attributes:
        instance: its address
        place: where it is, shape (PLACE_SIZE,)
        raw: samples of one run as the FMU stores them, shape (samples * outputs_stride,)
        raw_address: of `raw`
        flags: what fmi3DoStep tells, shape (FLAGS_SIZE,)
        flags_address: of `flags`
    """

    instance: int
    place: NDArray[np.intp]
    raw: NDArray[np.uint8]
    raw_address: int
    flags: NDArray[np.uint8]
    flags_address: int
