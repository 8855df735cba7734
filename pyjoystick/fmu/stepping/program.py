"""A run in machine terms: addresses, counts and blocks of values, as the kernel reads them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from pyjoystick.support import FloatArray

# Indices in `Program.functions`; setters and getters follow.
RESET, SETUP, ENTER, EXIT, STEP, TERMINATE, DERIVATIVES = range(7)

# Status values of FMI functions, and further ones of the kernel.
OK, WARNING, DISCARD, ERROR, FATAL, PENDING = range(6)
#: The FMU terminated the run.
ENDED: Final = 101
#: The FMU returned before the end of a step without permission.
EARLY: Final = 102
#: The stop flag was set.
STOPPED: Final = 103
#: The pause flag was set; the run can be resumed.
UNFINISHED: Final = 104
#: The run exceeded its time limit.
LATE: Final = 105

# Indices in an array of integers that the kernel keeps up to date: the run, the communication point reached
# (`BETWEEN_RUNS` if none), the number of samples taken, and the function called last; and a pause flag for
# others to set, at which the kernel returns after the current step.
RUN, POINT, SAMPLES, FUNCTION, PAUSE = range(5)
#: 128 bytes, because two threads that write to one cache line in every step slow each other down.
PLACE_SIZE: Final = 16
BETWEEN_RUNS: Final = -1

#: Bytes for the results of fmi3DoStep, in their own cache line.
FLAGS_SIZE: Final = 128
#: Offset of the time that fmi3DoStep has reached.
REACHED: Final = 24

# Storage of values. The kind of integers and Booleans is four times their size, plus their type.
FLOAT64, FLOAT32, TEXT = range(3)
UNSIGNED, SIGNED, BOOLEAN = range(3)


class Group(NamedTuple):
    """Variables that one call sets or gets; their values are adjacent in a row.

    Attributes:
        function: index of the setter or getter in `Program.functions`
        references: address of the value references
        size: number of values
        offset: bytes from the start of the row
        kind: how the values are stored
        surplus: number of values minus number of variables, nonzero for arrays
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
    """Data that all runs of a plan share. Addresses point to arrays that the plan keeps alive.

    The plain loop is given lists in place of the arrays over the points.

    Attributes:
        version: FMI version, 2 or 3
        functions: addresses of the C functions
        times: communication points (s), shape (points,)
        recorded: whether a sample is taken there, shape (points,)
        tolerance: tolerance for the FMU's integrator
        stop_defined: whether the FMU is given the stop time
        constants, constants_row: parameters that all runs share, and the address of their row
        varied: parameters that each run gives
        varied_stride: bytes from the row of one run to that of the next
        inputs: inputs that change or are set at the start
        inputs_rows: address of their first row; there is one for each point
        inputs_stride: bytes from row to row
        changed: whether to set a group of inputs at a point, shape (points, groups)
        moving: number of inputs whose derivative is given
        moving_references: address of their value references
        moving_orders: address of as many ones
        slopes: address of their derivatives, one row per step
        outputs: variables to record
        outputs_stride: bytes from sample to sample
        columns: column of each value in a table of samples, in the order of the groups; -1 for none
    """

    version: int
    functions: Sequence[int] | NDArray[np.intp]
    times: FloatArray
    recorded: NDArray[np.bool_]
    tolerance: float
    stop_defined: int
    constants: Sequence[Group]
    constants_row: int
    varied: Sequence[Group]
    varied_stride: int
    inputs: Sequence[Group]
    inputs_rows: int
    inputs_stride: int
    changed: NDArray[np.bool_]
    moving: int
    moving_references: int
    moving_orders: int
    slopes: int
    outputs: Sequence[Group]
    outputs_stride: int
    columns: Sequence[int] | NDArray[np.intp]


class Workspace(NamedTuple):
    """Memory of one instance of the FMU.

    Attributes:
        instance: address of the instance
        place: progress, shape (PLACE_SIZE,)
        raw: samples of one run as the FMU stores them, shape (samples * outputs_stride,)
        raw_address: address of `raw`
        flags: results of fmi3DoStep, shape (FLAGS_SIZE,)
        flags_address: address of `flags`
    """

    instance: int
    place: NDArray[np.intp]
    raw: NDArray[np.uint8]
    raw_address: int
    flags: NDArray[np.uint8]
    flags_address: int
