"""The settings of a fit as a TOML file; docs/fitting.md describes it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from pyjoystick.fmu import MODELS, FmuDescription, Value, Variable, find_fmu, read_description
from pyjoystick.identification.fitting.settings import (
    RELEASE_TIME,
    FitSettings,
    Free,
    Noise,
    Search,
    Uncertainty,
    with_values,
)
from pyjoystick.runs import difference_of, number_of, value_of, values_from_joystick_file
from pyjoystick.support import (
    ParameterError,
    SettingsError,
    Table,
    UnknownNameError,
    UnknownVariableError,
    read_toml,
)

_FREE_KEYS = ("start", "minimum", "maximum")


def read_fit_settings(path: Path, find: Callable[[str], Path] = find_fmu) -> FitSettings:
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
    fmu = root.table("fmu", required=True)
    name = fmu.text("path")
    file = find(name if name in MODELS else str(path.parent / name))
    description = read_description(file)
    given: dict[str, Any] = {
        "fmu": name if name in MODELS else str(file),
        "fixed": _fixed(root.table("parameters"), description),
        "free": _free(root.table("free", required=True), description),
        "ties": _ties(root.table("ties")),
        "noise": _noise(root.table("noise"), description),
        **_compared(root.table("compare")),
    }
    values = values_from_joystick_file(fmu, description)
    if "tolerance" in fmu:
        given["tolerance"] = fmu.number("tolerance")
    fmu.optional("tolerance")
    given["search"] = _made(root.table("search"), Search, tuples=("stages", "exchanges"))
    given["uncertainty"] = _made(root.table("uncertainty"), Uncertainty, tuples=("profiles",))
    fmu.finish()
    root.finish()
    try:
        return with_values(FitSettings(**given), values)
    except ParameterError as error:
        raise SettingsError(path, "", "", None, str(error)) from None


def _fixed(table: Table, fmu: FmuDescription) -> dict[str, Value]:
    values: dict[str, Value] = {}
    for name, given in table.items():
        with _placed(table, name):
            values[name] = (
                table.number(name) if name == RELEASE_TIME else value_of(_variable(fmu, name), given)
            )
    return values


def _free(table: Table, fmu: FmuDescription) -> tuple[Free, ...]:
    found = []
    for name in dict(table.items()):
        inner = table.table(name)
        numbers = {key: _amount(inner, key, name, fmu) for key in _FREE_KEYS if key in inner}
        for key in _FREE_KEYS:
            inner.optional(key)
        per_record = _flag(inner, "per_record")
        inner.finish()
        with _placed(inner):
            found.append(Free(name, **numbers, per_record=per_record))
    return tuple(found)


def _amount(table: Table, key: str, name: str, fmu: FmuDescription) -> float:
    """A number, or for a parameter of the FMU text with a unit."""
    if name not in fmu.variables:
        return table.number(key)
    with _placed(table, key):
        return number_of(fmu.variables[name], table.content[key])


def _flag(table: Table, key: str) -> bool:
    given = table.optional(key)
    if given is not None and not isinstance(given, bool):
        raise table.error(key, "must be true or false")
    return bool(given)


def _ties(table: Table) -> dict[str, str]:
    return {name: table.text(name) for name, _ in table.items()}


def _noise(table: Table, fmu: FmuDescription) -> Noise:
    inner = table.table("sigma")
    sigma = {}
    for name, given in inner.items():
        with _placed(inner, name):
            sigma[name] = difference_of(_variable(fmu, name), given)
    per_record = _flag(table, "per_record")
    table.finish()
    with _placed(table):
        return Noise(sigma, per_record)


def _compared(table: Table) -> dict[str, Any]:
    found: dict[str, Any] = {}
    if "what" in table:
        found["comparison"] = table.choice("what", ("trajectory", "peaks"))
    for key in ("outputs", "inputs"):
        if key in table:
            found[key] = tuple(_words(table, key))
    if "peaks" in table:
        found["peaks"] = table.integer("peaks", 2)
    if "derivatives" in table:
        inner = table.table("derivatives")
        found["derivatives"] = {name: inner.text(name) for name, _ in inner.items()}
    for key in ("what", "outputs", "inputs", "peaks", "derivatives"):
        table.optional(key)
    table.finish()
    return found


def _words(table: Table, key: str) -> list[str]:
    words = table.entries(key)
    if not all(isinstance(word, str) for word in words):
        raise table.error(key, "must be a list of names")
    return words


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
    table.finish()
    with _placed(table):
        return kind(**given)


def _tuples(value: Any) -> Any:
    """Lists as tuples, those inside too."""
    return tuple(_tuples(one) for one in value) if isinstance(value, list) else value


def _variable(fmu: FmuDescription, name: str) -> Variable:
    if name not in fmu.variables:
        raise UnknownVariableError(name, fmu.variables)
    return fmu.variables[name]


@contextmanager
def _placed(table: Table, key: str = "") -> Iterator[None]:
    """What is refused inside is named with its place in the file; where no key is given, by its own name."""
    try:
        yield
    except ParameterError as error:
        field = error.field.rpartition(".")[2]
        raise table.refused(key or (field if field in table else ""), error) from None
    except UnknownNameError as error:
        raise table.refused(key, error) from None


def reads_releases(settings: FitSettings) -> bool:
    """Whether the records are free oscillations of the joystick, and not tables of any variables."""
    return set(settings.outputs) <= {"theta", "omega"} and not settings.inputs


def as_document(settings: FitSettings) -> Mapping[str, Any]:
    """The settings as plain data, for a report."""
    return dataclasses.asdict(settings)
