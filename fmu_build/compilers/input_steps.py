"""What drives a model's default experiment: a table beside the Modelica source.

``Resources/Inputs/Joystick/Joystick.csv`` in the folder of the library PreloadedSprings is that of its class
``Joystick.Joystick``. The first row has ``time`` and the names of inputs; every other row has a time in
seconds and the values that the inputs have from then on, until the next row.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Collection
from pathlib import Path

from fmu_build.support.description import InputStep
from fmu_build.support.errors import ModelicaError


def input_steps_file(library: Path, model: str) -> Path:
    """Where the table of a class is, if there is one; `library` is a package folder or a Modelica file."""
    folder = library if library.is_dir() else library.parent
    *packages, name = model.split(".")
    return folder.joinpath("Resources", "Inputs", *packages[1:], f"{name}.csv")


def read_input_steps(file: Path, inputs: Collection[str]) -> tuple[InputStep, ...]:
    """The table's rows, none where there is no such file.

    Raises `ModelicaError` naming file, line and value where a name is none of `inputs`, a cell is no finite
    number or the times do not rise.
    """
    if not file.is_file():
        return ()
    try:
        (_, header), *rows = enumerate(csv.reader(file.read_text("utf-8").splitlines()), start=1)
    except ValueError as error:
        raise ModelicaError(f"{file}: no readable table: {error}") from error
    unknown = [name for name in header[1:] if name not in inputs]
    if header[:1] != ["time"] or unknown or len(set(header)) != len(header):
        raise ModelicaError(
            f"{file}:1: the columns are {', '.join(header)}; "
            f"allowed are time and then inputs, each once: {', '.join(inputs) or 'there are none'}"
        )
    steps: list[InputStep] = []
    for line, row in rows:
        time, *values = _numbers(row, len(header), f"{file}:{line}")
        if steps and time <= steps[-1].time:
            raise ModelicaError(f"{file}:{line}: the time {time:g} does not come after {steps[-1].time:g}")
        steps.append(InputStep(time, dict(zip(header[1:], values, strict=True))))
    return tuple(steps)


def _numbers(row: list[str], columns: int, place: str) -> list[float]:
    if len(row) != columns:
        raise ModelicaError(f"{place}: {len(row)} values, but {columns} columns")
    numbers = []
    for text in row:
        try:
            number = float(text)
        except ValueError:
            number = math.nan
        if not math.isfinite(number):
            raise ModelicaError(f"{place}: {text!r} is not a finite number")
        numbers.append(number)
    return numbers
