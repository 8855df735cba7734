"""The settings of a fit as a TOML file; docs/fitting.md describes it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Set
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple

from pyjoystick.fmu import MODELS, FmuDescription, Value, Variable, find_fmu
from pyjoystick.identification.fitting.problem.instrument import INSTRUMENT, RELEASE_TIME, ZERO_OFFSET
from pyjoystick.identification.fitting.problem.known_values import with_values
from pyjoystick.identification.fitting.problem.settings import FitSettings, Free, Noise, Search, Uncertainty
from pyjoystick.identification.fitting.problem.ties import Ties, names_in
from pyjoystick.identification.fitting.problem.variables import require_known
from pyjoystick.runs import difference_of, fmu_of, joystick_values, number_of, value_of
from pyjoystick.support import ParameterError, SettingsError, Table, UnknownVariableError, read_toml


def read_fit_settings(
    path: str | PathLike[str] | Table, find: Callable[[str], Path] = find_fmu
) -> FitSettings:
    """Read the settings of a fit.

    Args:
        path: the TOML file; FMU paths in it are relative to its folder
        find: function that returns the file for the name or path of an FMU

    Raises:
        InputFileError: the file cannot be read
        SettingsError: a setting is not allowed; the message names the table and the key
        FmuNotFoundError, FmuFileError: there is no such FMU, or it is broken
    """
    root = read_toml(path)
    table = root.table("fmu", required=True)
    fmu = fmu_of(table, find)
    name, values = table.text("path"), joystick_values(table, fmu)
    compared = _compared(root.table("compare"), fmu)
    ties = root.table("ties").texts()
    measured = _Measured(fmu, compared.get("outputs", ("theta",))[0])
    given: dict[str, Any] = {
        "fmu": name if name in MODELS else str(fmu.path),
        "fixed": _fixed(root.table("parameters"), measured),
        "free": _free(root.table("free", required=True), measured, names_in(ties.values())),
        "ties": ties,
        "noise": _noise(root.table("noise"), fmu),
        **compared,
    }
    with root.table("ties").at():
        Ties([one.name for one in given["free"] if one.name not in INSTRUMENT], ties, fmu)
    if RELEASE_TIME in {one.name for one in given["free"]} and ZERO_OFFSET not in given["fixed"]:
        given["free"] = _with_zero_offset(given["free"])
    if "tolerance" in table:
        given["tolerance"] = table.number("tolerance")
    given["search"] = _made(root.table("search"), Search, tuples=("stages", "exchanges", "scan"))
    given["uncertainty"] = _made(root.table("uncertainty"), Uncertainty, tuples=("profiles",))
    root.finish()
    try:
        return with_values(FitSettings(**given), values)
    except ParameterError as error:
        raise SettingsError(root.path, "", "", None, str(error)) from None


class _Measured(NamedTuple):
    """The FMU, and the output that the instrument's zero and scale apply to."""

    fmu: FmuDescription
    output: str

    def amount(self, table: Table, key: str, name: str) -> float:
        """A number in the unit of a parameter, or text with a unit if the parameter has one."""
        if name == ZERO_OFFSET:
            with table.at(key):
                return number_of(_variable(self.fmu, self.output), table.value(key))
        if name not in self.fmu.variables:
            return table.number(key)
        with table.at(key):
            return number_of(self.fmu.variables[name], table.value(key))

    def difference(self, table: Table, key: str, name: str) -> float:
        """As `amount`, but for a difference, where a temperature has no offset."""
        if name not in self.fmu.variables:
            return self.amount(table, key, name)
        with table.at(key):
            return difference_of(self.fmu.variables[name], table.value(key))


def _fixed(table: Table, measured: _Measured) -> dict[str, Value]:
    values: dict[str, Value] = {}
    for name, given in table.items():
        with table.at(name):
            values[name] = (
                measured.amount(table, name, name)
                if name in INSTRUMENT
                else value_of(_variable(measured.fmu, name), given)
            )
    return values


def _free(table: Table, measured: _Measured, in_ties: Set[str]) -> tuple[Free, ...]:
    found = []
    for name, inner in table.subtables():
        numbers = {
            key: measured.amount(inner, key, name) for key in ("start", "minimum", "maximum") if key in inner
        }
        if "uncertainty" in inner:
            numbers["uncertainty"] = measured.difference(inner, "uncertainty", name)
        with inner.at():
            found.append(Free(name, **numbers, per_record=inner.flag("per_record")))
            require_known(found[-1], measured.fmu, in_ties)
    return tuple(found)


def _with_zero_offset(free: tuple[Free, ...]) -> tuple[Free, ...]:
    """The free parameters of a release; adds a zero for each record unless they mention it."""
    named = any(one.name == ZERO_OFFSET for one in free)
    return free if named else (*free, Free(ZERO_OFFSET, per_record=True))


def _noise(table: Table, fmu: FmuDescription) -> Noise:
    inner = table.table("sigma")
    sigma = {}
    for name, given in inner.items():
        with inner.at(name):
            sigma[name] = difference_of(_variable(fmu, name), given)
    with table.at():
        colored, robust = (table.flag(key, default=True) for key in ("colored", "robust"))
        return Noise(sigma, table.flag("per_record"), colored, robust)


def _compared(table: Table, fmu: FmuDescription) -> dict[str, Any]:
    found: dict[str, Any] = {}
    if "what" in table:
        found["comparison"] = table.choice("what", ("trajectory", "peaks"))
    for key in ("outputs", "inputs"):
        if key in table:
            found[key] = tuple(table.words(key))
            with table.at(key):
                for name in found[key]:
                    _variable(fmu, name)
    if "peaks" in table:
        found["peaks"] = table.integer("peaks", 2)
    if "derivatives" in table:
        found["derivatives"] = table.table("derivatives").texts()
    return found


def _made(table: Table, kind: type[Any], *, tuples: tuple[str, ...]) -> Any:
    """Make a dataclass from a table whose keys are its fields."""
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
    """Convert lists to tuples, recursively."""
    return tuple(_tuples(one) for one in value) if isinstance(value, list) else value


def _variable(fmu: FmuDescription, name: str) -> Variable:
    if name not in fmu.variables:
        raise UnknownVariableError(name, fmu.variables)
    return fmu.variables[name]


def reads_releases(settings: FitSettings) -> bool:
    """Whether the records are free oscillations of the joystick rather than tables of any variables."""
    return set(settings.outputs) <= {"theta", "omega"} and not settings.inputs


def is_driven(settings: FitSettings) -> bool:
    """Whether the records are motions of a joystick and the torque that drives it."""
    return set(settings.outputs) <= {"theta", "omega"} and set(settings.inputs) == {"T"}


def as_document(settings: FitSettings) -> Mapping[str, Any]:
    """The settings as plain data, for reports."""
    return dataclasses.asdict(settings)
