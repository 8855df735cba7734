"""Runs of one instance of an FMU from start to end, in plain arithmetic that Numba can compile.

Nothing here raises exceptions or uses Python objects: failures are returned as a status, with the run, the
point and the function in the workspace's `place`.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.stepping import decoding, reducing
from pyjoystick.fmu.stepping.calls import (
    access2,
    access3,
    begin,
    change_mode,
    do_step2,
    do_step3,
    set_input_derivatives,
)
from pyjoystick.fmu.stepping.decoding import decode
from pyjoystick.fmu.stepping.program import (
    BETWEEN_RUNS,
    DERIVATIVES,
    EARLY,
    ENDED,
    ENTER,
    EXIT,
    FUNCTION,
    OK,
    PAUSE,
    POINT,
    REACHED,
    RESET,
    RUN,
    SAMPLES,
    SETUP,
    STEP,
    STOPPED,
    TERMINATE,
    UNFINISHED,
    WARNING,
    Group,
    Program,
    Workspace,
)
from pyjoystick.fmu.stepping.reducing import Operation, reduce_run
from pyjoystick.motion import EXTREMA_FUNCTIONS
from pyjoystick.support import FloatArray

#: Part of a step that an FMU may miss. One that adds up fixed steps on a clock of its own lags by the
#: rounding of their sum, 1e-9 of a step of 1 ms after 12 s; a step that ends early, at an event, misses more.
_MISSED = 1e-3


def run_many(
    program: Program,
    operations: Sequence[Operation],
    instants: FloatArray,
    workspace: Workspace,
    is_new: bool,
    parameters: int,
    first: int,
    last: int,
    values: FloatArray,
    cells: FloatArray,
    done: NDArray[np.bool_],
    stop: NDArray[np.bool_],
) -> int:
    """Execute the runs `first` to `last` - 1.

    Args:
        program: what the runs share
        operations: what to keep of each run
        instants: sample times (s), shape (samples,)
        workspace: workspace of the instance; its place is `BETWEEN_RUNS`, or where to resume the first run
        is_new: nothing has been done with the instance yet
        parameters: address of the row of parameters of run 0
        first: the first run
        last: the run after the last
        values: samples, shape (runs, samples, variables), or (1, samples, variables) if only their
            reductions are wanted
        cells: results of the operations, shape (runs, cells)
        done: set for each run that reached its end, shape (runs,)
        stop: set by another thread to end the work after the current step, shape (1,)

    Returns:
        OK, or the status that ended the work at the run in the workspace's place
    """
    place = workspace.place
    for run in range(first, last):
        place[RUN] = run
        status = OK
        if place[POINT] == BETWEEN_RUNS:
            status = start(program, workspace, is_new, parameters + run * program.varied_stride)
            is_new = False
        if not _is_bad(status):
            status = _advance(program, workspace, stop)
        if _is_bad(status):
            return status
        samples = values[run if len(values) > 1 else 0]
        decode(program.outputs, program.columns, workspace.raw, program.outputs_stride, samples)
        reduce_run(operations, instants, samples, cells[run])
        place[POINT] = BETWEEN_RUNS
        done[run] = True
    return OK


def _is_bad(status: int) -> bool:
    return status != OK and status != WARNING


def start(program: Program, workspace: Workspace, is_new: bool, parameters: int) -> int:
    """Take the instance from any state to the first communication point."""
    instance, place, functions = workspace.instance, workspace.place, program.functions
    place[POINT] = place[SAMPLES] = 0
    if not is_new:
        place[FUNCTION] = RESET
        status = change_mode(functions[RESET], instance)
        if _is_bad(status):
            return status
    if program.version == 2:
        status = _begin(program, workspace, SETUP)
        if _is_bad(status):
            return status
    status = transfer(program, workspace, program.constants, program.constants_row)
    if _is_bad(status):
        return status
    status = transfer(program, workspace, program.varied, parameters)
    if _is_bad(status):
        return status
    if program.version == 2:
        place[FUNCTION] = ENTER
        status = change_mode(functions[ENTER], instance)
    else:
        status = _begin(program, workspace, ENTER)
    if _is_bad(status):
        return status
    status = transfer(program, workspace, program.inputs, program.inputs_rows)
    if _is_bad(status):
        return status
    place[FUNCTION] = EXIT
    return change_mode(functions[EXIT], instance)


def _begin(program: Program, workspace: Workspace, function: int) -> int:
    workspace.place[FUNCTION] = function
    times = program.times
    return begin(
        program.functions[function],
        workspace.instance,
        1,
        program.tolerance,
        times[0],
        program.stop_defined,
        times[-1] if program.stop_defined else 0.0,
    )


def _advance(program: Program, workspace: Workspace, stop: NDArray[np.bool_]) -> int:
    """Step from the communication point in the workspace's place to the end, a stop or a pause."""
    place = workspace.place
    point = place[POINT]
    end = len(program.times) - 1
    while True:
        if point > 0:
            status = _set_inputs(program, workspace, point)
            if _is_bad(status):
                return status
        if program.recorded[point]:
            row = workspace.raw_address + place[SAMPLES] * program.outputs_stride
            status = transfer(program, workspace, program.outputs, row)
            if _is_bad(status):
                return status
            place[SAMPLES] += 1
        if point == end:
            break
        status = _step(program, workspace, point)
        if _is_bad(status):
            return status
        point += 1
        place[POINT] = point
        if stop[0]:
            return STOPPED
        if place[PAUSE]:
            place[PAUSE] = 0
            return UNFINISHED
    place[FUNCTION] = TERMINATE
    return change_mode(program.functions[TERMINATE], workspace.instance)


def _set_inputs(program: Program, workspace: Workspace, point: int) -> int:
    row = program.inputs_rows + point * program.inputs_stride
    for i in range(len(program.inputs)):
        if program.changed[point][i]:
            status = _access(program, workspace, program.inputs[i], row)
            if _is_bad(status):
                return status
    return OK


def transfer(program: Program, workspace: Workspace, groups: Sequence[Group], row: int) -> int:
    """Set or get the variables of a row of values."""
    for i in range(len(groups)):
        status = _access(program, workspace, groups[i], row)
        if _is_bad(status):
            return status
    return OK


def _access(program: Program, workspace: Workspace, group: Group, row: int) -> int:
    workspace.place[FUNCTION] = group.function
    function, values = program.functions[group.function], row + group.offset
    count = group.size - group.surplus
    if program.version == 2:
        return access2(function, workspace.instance, group.references, count, values)
    return access3(function, workspace.instance, group.references, count, values, group.size)


def _step(program: Program, workspace: Workspace, point: int) -> int:
    """Step from a communication point to the next."""
    place, instance = workspace.place, workspace.instance
    if program.moving > 0:
        place[FUNCTION] = DERIVATIVES
        status = set_input_derivatives(
            program.functions[DERIVATIVES],
            instance,
            program.moving_references,
            program.moving,
            program.moving_orders,
            program.slopes + point * program.moving * 8,
        )
        if _is_bad(status):
            return status
    place[FUNCTION] = STEP
    function, time = program.functions[STEP], program.times[point]
    length = program.times[point + 1] - time
    if program.version == 2:
        return do_step2(function, instance, time, length, 1)
    flags = workspace.flags_address
    status = do_step3(function, instance, time, length, 1, flags, flags + 8, flags + 16, flags + REACHED)
    if _is_bad(status):
        return status
    if workspace.flags[8]:
        return ENDED
    is_early = workspace.flags[16] or stopped_short(
        workspace.flags.view(np.float64)[REACHED // 8], time, length
    )
    return EARLY if is_early else status


def stopped_short(reached: float, begin: float, length: float) -> bool:
    """Whether fmi3DoStep ended inside of the step from `begin`, even if it does not report an early return.

    The start of the step does not count: an FMU may leave `reached` as it was.
    """
    return begin < reached < begin + length - _MISSED * length


#: Functions to compile for `run_many`, each after those that it calls.
FUNCTIONS = (
    *EXTREMA_FUNCTIONS,
    *decoding.FUNCTIONS,
    *reducing.FUNCTIONS,
    _is_bad,
    _access,
    transfer,
    _set_inputs,
    stopped_short,
    _step,
    _begin,
    start,
    _advance,
)
