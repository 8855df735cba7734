"""Conversion of checked settings to the input of the stepping loop."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from pyjoystick.fmu.description import FmuDescription, Variable
from pyjoystick.fmu.drive import Drive, inputs_asked_for
from pyjoystick.fmu.inputs import InputSeries
from pyjoystick.fmu.interface import CInterface, RowFormat, TextGetter, c_interface
from pyjoystick.fmu.stepping.program import Program
from pyjoystick.fmu.values import Value
from pyjoystick.support import FloatArray


@dataclass(frozen=True, slots=True, eq=False)
class Preparation:
    """A run of an FMU, ready to be executed with any varied values.

    Attributes:
        program: program for the loop
        interface: FMI functions that it calls
        varied: row layout of the varied values
        outputs: row layout of the recorded values
        texts: getter of texts, if any are recorded
        memory: objects that the addresses in the program point to
        drive: inputs that the FMU requests within its steps; None if none of them changes
    """

    program: Program
    interface: CInterface
    varied: RowFormat
    outputs: RowFormat
    texts: TextGetter | None
    memory: tuple[object, ...]
    drive: Drive | None = None


def prepare(
    description: FmuDescription,
    fmi: Any,
    points: FloatArray,
    is_recorded: NDArray[np.bool_],
    tolerance: float,
    parameters: Mapping[str, Value],
    varied: Sequence[Variable],
    inputs: Sequence[InputSeries],
    outputs: Sequence[Variable],
) -> Preparation:
    """Lay out everything that is common to all runs.

    Args:
        description: the FMU
        fmi: its library as loaded by FMPy; None if another process loads it
        points: communication points (s), shape (n,)
        is_recorded: whether a sample is taken there, shape (n,)
        tolerance: tolerance for the FMU's integrator
        parameters: checked values that all runs share
        varied: variables that each run sets
        inputs: inputs at the points
        outputs: variables to record
    """
    interface = c_interface(description.fmi_version)
    constants = RowFormat(interface, "Set", [description.variables[name] for name in parameters])
    constants_row = constants.rows(1)
    for name, value in parameters.items():
        constants_row[name] = constants.text(value.encode()) if isinstance(value, str) else value
    varied_format = RowFormat(interface, "Set", varied)
    input_format = RowFormat(interface, "Set", [one.variable for one in inputs])
    input_rows = input_format.rows(len(points))
    for one in inputs:
        is_text = one.variable.type == "String"
        values = [input_format.text(text.encode()) for text in one.values] if is_text else one.values
        input_rows[one.variable.name] = values
    output_format = RowFormat(interface, "Get", outputs)
    functions = [0] * len(interface.functions) if fmi is None else interface.addresses(fmi)
    texts = None
    if fmi is not None and any(one.type == "String" for one in outputs):
        place = interface.place("Get", interface.types["String"])
        texts = TextGetter(interface, functions[place], output_format)
        functions[place] = texts.address
    moving = [one for one in inputs if description.interpolates_inputs and np.any(one.slopes)]
    moving_references = np.array([one.variable.value_reference for one in moving], dtype=np.uint32)
    moving_orders = np.ones(len(moving), dtype=np.int32)
    slopes = np.array([one.slopes for one in moving], dtype=np.float64).T.copy()
    program = Program(
        version=interface.version,
        functions=functions,
        times=points,
        recorded=is_recorded,
        tolerance=tolerance,
        stop_defined=int(description.takes_stop_time),
        constants=constants.groups,
        constants_row=constants_row.ctypes.data,
        varied=varied_format.groups,
        varied_stride=varied_format.dtype.itemsize,
        inputs=input_format.groups,
        inputs_rows=input_rows.ctypes.data,
        inputs_stride=input_format.dtype.itemsize,
        changed=_changed(input_format, inputs, moving, len(points)),
        moving=len(moving),
        moving_references=moving_references.ctypes.data,
        moving_orders=moving_orders.ctypes.data,
        slopes=slopes.ctypes.data,
        outputs=output_format.groups,
        outputs_stride=output_format.dtype.itemsize,
        columns=output_format.columns,
    )
    memory = (constants, constants_row, input_format, input_rows, moving_references, moving_orders, slopes)
    asked = {one.name for one in inputs_asked_for(description)}
    within = [one for one in inputs if one.variable.name in asked and np.any(one.slopes)]
    drive = Drive(points, within) if within else None
    return Preparation(program, interface, varied_format, output_format, texts, memory, drive)


def _changed(
    form: RowFormat, inputs: Sequence[InputSeries], moving: Sequence[InputSeries], points: int
) -> NDArray[np.bool_]:
    """Whether to set a group of inputs at a point, shape (points, groups).

    Unchanged inputs are not set, because an FMU may restart its integration at each new value. Inputs
    with a derivative are set at every point, because the FMU extrapolates from the value there.
    """
    changed = np.zeros((points, len(form.groups)), dtype=np.bool_)
    place = 0
    for i, group in enumerate(form.groups):
        for column in form.columns[place : place + group.size]:
            one = inputs[column]
            changed[1:, i] |= True if one in moving else one.values[1:] != one.values[:-1]
        place += group.size
    return changed
