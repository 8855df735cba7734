"""Inputs of a model's default experiment, from a table next to the Modelica source.

For class ``Joystick.Joystick`` of the library PreloadedSprings, the table is
``Resources/Inputs/Joystick/Joystick.csv`` in the library's folder. The header contains ``time`` and the names
of inputs. Each further row contains a time in seconds and the values of the inputs from that time until the
time of the next row.
"""

from __future__ import annotations

import csv
import math
from collections.abc import Collection
from pathlib import Path

from fmu_build.support.description import InputStep
from fmu_build.support.errors import ModelicaError


def input_steps_file(library: Path, model: str) -> Path:
    """Return the path for the table of a class; `library` is a package folder or a Modelica file."""
    folder = library if library.is_dir() else library.parent
    *packages, name = model.split(".")
    return folder.joinpath("Resources", "Inputs", *packages[1:], f"{name}.csv")


def read_input_steps(file: Path, inputs: Collection[str]) -> tuple[InputStep, ...]:
    """Read the rows of the table; a missing file counts as empty.

    Raises `ModelicaError` with file, line and value if a name is not in `inputs`, a cell is not a finite
    number or the times do not increase.
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
