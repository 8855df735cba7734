"""The settings of a fit as a TOML file; docs/fitting.md describes it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from pyjoystick.fmu import MODELS, FmuDescription, Value, Variable, find_fmu
from pyjoystick.identification.fitting.settings import (
    RELEASE_TIME,
    FitSettings,
    Free,
    Noise,
    Search,
    Uncertainty,
    with_values,
)
from pyjoystick.runs import difference_of, fmu_of, joystick_values, number_of, value_of
from pyjoystick.support import ParameterError, SettingsError, Table, UnknownVariableError, read_toml


def read_fit_settings(
    path: str | PathLike[str] | Table, find: Callable[[str], Path] = find_fmu
) -> FitSettings:
    """Read the settings of a fit.

    Args:
        path: the TOML file; a path of an FMU in it is relative to its folder
        find: from the name or path of an FMU to its file

    Raises:
        InputFileError: the file cannot be read
        SettingsError: something in it is not allowed; the message names the table and the key
        FmuNotFoundError, FmuFileError: there is no such FMU, or it is broken
    """
    root = read_toml(path)
    table = root.table("fmu", required=True)
    fmu = fmu_of(table, find)
    name = table.text("path")
    given: dict[str, Any] = {
        "fmu": name if name in MODELS else str(fmu.path),
        "fixed": _fixed(root.table("parameters"), fmu),
        "free": _free(root.table("free", required=True), fmu),
        "ties": _texts(root.table("ties")),
        "noise": _noise(root.table("noise"), fmu),
        **_compared(root.table("compare")),
    }
    if "tolerance" in table:
        given["tolerance"] = table.number("tolerance")
    values = joystick_values(table, fmu)
    given["search"] = _made(root.table("search"), Search, tuples=("stages", "exchanges"))
    given["uncertainty"] = _made(root.table("uncertainty"), Uncertainty, tuples=("profiles",))
    root.finish()
    try:
        return with_values(FitSettings(**given), values)
    except ParameterError as error:
        raise SettingsError(root.path, "", "", None, str(error)) from None


def _fixed(table: Table, fmu: FmuDescription) -> dict[str, Value]:
    values: dict[str, Value] = {}
    for name, given in table.items():
        with table.at(name):
            values[name] = (
                table.number(name) if name == RELEASE_TIME else value_of(_variable(fmu, name), given)
            )
    return values


def _free(table: Table, fmu: FmuDescription) -> tuple[Free, ...]:
    found = []
    for name, inner in table.subtables():
        numbers = {
            key: _amount(inner, key, name, fmu) for key in ("start", "minimum", "maximum") if key in inner
        }
        with inner.at():
            found.append(Free(name, **numbers, per_record=inner.flag("per_record")))
    return tuple(found)


def _amount(table: Table, key: str, name: str, fmu: FmuDescription) -> float:
    """A number, or for a parameter of the FMU text with a unit."""
    if name not in fmu.variables:
        return table.number(key)
    with table.at(key):
        return number_of(fmu.variables[name], table.value(key))


def _texts(table: Table) -> dict[str, str]:
    return {name: table.text(name) for name, _ in table.items()}


def _noise(table: Table, fmu: FmuDescription) -> Noise:
    inner = table.table("sigma")
    sigma = {}
    for name, given in inner.items():
        with inner.at(name):
            sigma[name] = difference_of(_variable(fmu, name), given)
    with table.at():
        return Noise(sigma, table.flag("per_record"))


def _compared(table: Table) -> dict[str, Any]:
    found: dict[str, Any] = {}
    if "what" in table:
        found["comparison"] = table.choice("what", ("trajectory", "peaks"))
    for key in ("outputs", "inputs"):
        if key in table:
            found[key] = tuple(table.words(key))
    if "peaks" in table:
        found["peaks"] = table.integer("peaks", 2)
    if "derivatives" in table:
        found["derivatives"] = _texts(table.table("derivatives"))
    return found


def _made(table: Table, kind: type[Any], *, tuples: tuple[str, ...]) -> Any:
    """A dataclass from a table whose keys are its fields."""
    given: dict[str, Any] = {}
    for one in dataclasses.fields(kind):
        value = table.optional(one.name)
        if value is None:
            continue
        if one.name in tuples and not isinstance(value, list):
            raise table.error(one.name, "must be a list")
        given[one.name] = _tuples(value) if one.name in tuples else value
    with table.at():
        return kind(**given)


def _tuples(value: Any) -> Any:
    """Lists as tuples, those inside too."""
    return tuple(_tuples(one) for one in value) if isinstance(value, list) else value


def _variable(fmu: FmuDescription, name: str) -> Variable:
    if name not in fmu.variables:
        raise UnknownVariableError(name, fmu.variables)
    return fmu.variables[name]


def reads_releases(settings: FitSettings) -> bool:
    """Whether the records are free oscillations of the joystick, and not tables of any variables."""
    return set(settings.outputs) <= {"theta", "omega"} and not settings.inputs


def as_document(settings: FitSettings) -> Mapping[str, Any]:
    """The settings as plain data, for a report."""
    return dataclasses.asdict(settings)
