"""Contents of a parameter file by parameter names of the FMU."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

from pyjoystick.model.parameters.file import PLAIN_TABLES, SIDES, LawName, ParameterFile
from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.support import TextTable, document_text

#: Places of the parameters of a side's two springs in its load-deflection curve (Table 1).
_SPRINGS: Final = {
    "returnSpring.k_s": "k[1]",
    "returnSpring.k_h": "k[0] - k[1]",
    "returnSpring.F_0": "(k[0] - k[1])*(x[1] - x[0])",
    "returnSpring.x_0": "x[0]",
    "balanceSpring.k_s": "k[3] - k[1]",
    "balanceSpring.k_h": "k[2] - k[3]",
    "balanceSpring.F_0": "(k[2] - k[3])*(x[3] - x[2])",
    "balanceSpring.x_0": "x[2]",
}
_UNITS: Final = {
    "J": "kg.m2",
    "m": "kg",
    "h": "m",
    "g": "m/s2",
    "a": "m",
    "b": "m",
    "k_s": "N/m",
    "k_h": "N/m",
    "F_0": "N",
    "x_0": "m",
    **{f"damping.{name}": "N.m.s/rad" for name in ("C", "A_pos", "A_neg", "B")},
    **{f"damping.{name}": "1" for name in ("alpha", "n_pos", "n_neg", "m")},
    **dict.fromkeys(("friction.T_c", "friction.T_s"), "N.m"),
    "friction.F_c": "N",
    "friction.omega_s": "rad/s",
    "stops.theta_stop": "rad",
    "stops.K": "N.m/rad",
    "stops.D": "N.m.s/rad",
    "damping.eps_theta": "rad",
    "damping.eps_omega": "rad/s",
}


@dataclass(frozen=True, slots=True, kw_only=True)
class FmuValue:
    """One parameter of the FMU.

    Attributes:
        name: name in the FMU, such as ``forward.returnSpring.k_h``
        value: in SI units
        unit: in Modelica's notation
        table: its table in the parameter file
        place: the key in that table, or the formula if computed from several: ``k[0] - k[1]``
        uncertainty: standard uncertainty (SI units); None if the file gives none, or if the value is
            computed from several, whose correlations the file does not contain
        source: source of the value according to the file; may be empty
    """

    name: str
    value: float
    unit: str
    table: str
    place: str
    uncertainty: float | None
    source: str


def fmu_values(file: ParameterFile, law: LawName | None = None) -> tuple[FmuValue, ...]:
    """All parameters of a file by their FMU names, with the damping law of the file or another one of it.

    Raises:
        SettingsError: the file has no numbers of that law
    """
    law = law or file.law
    values = file.with_law(law).to_names()
    return tuple(
        FmuValue(
            name=name,
            value=values[name],
            unit=_unit(name),
            table=table,
            place=place,
            uncertainty=file.uncertainties.get(f"{table}.{place}"),
            source=file.sources.get(table, ""),
        )
        for name, table, place in _places(tuple(values), law)
    )


def parameter_list(joystick: JoystickParameters) -> list[dict[str, str | float]]:
    """Name in the FMU, value and unit of each parameter, for documents."""
    return [
        {"name": name, "value": value, "unit": _unit(name)} for name, value in joystick.to_names().items()
    ]


def values_json(file: ParameterFile, law: LawName | None = None, notes: Sequence[str] = ()) -> str:
    """The parameters by their FMU names as the document of ``pyjoystick parameters``.

    Args:
        file: the parameters
        law: damping law; that of the file by default
        notes: what was noted on them

    Raises:
        SettingsError: the file has no numbers of that law
    """
    parameters = [
        {
            "name": one.name,
            "value": one.value,
            "unit": one.unit,
            "standard_uncertainty": one.uncertainty,
            "source": one.source,
            "from": f"{one.table}: {one.place}",
        }
        for one in fmu_values(file, law)
    ]
    content = {"title": file.title, "damping": law or file.law, "parameters": parameters}
    return document_text("parameters", content, notes)


def fmu_value_table(values: tuple[FmuValue, ...]) -> TextTable:
    """The same as rows of text: name in the FMU, place in the parameter file, value, uncertainty, unit."""
    rows = [
        [
            v.name,
            f"{v.table}: {v.place}",
            f"{v.value:.9g}",
            "" if v.uncertainty is None else f"{v.uncertainty:.2g}",
            v.unit,
        ]
        for v in values
    ]
    return TextTable(("in the FMU", "in the parameter file", "value", "standard uncertainty", "unit"), rows)


def _unit(name: str) -> str:
    return _UNITS.get(name) or _UNITS[name.rpartition(".")[2]]


def _places(names: tuple[str, ...], law: LawName) -> Iterator[tuple[str, str, str]]:
    """The table and the place in it of every name."""
    tables = {key: table for table, keys in PLAIN_TABLES.items() for key in keys}
    for name in names:
        first, _, rest = name.partition(".")
        if first in SIDES:
            yield name, first, _SPRINGS[rest]
        elif first == "damping":
            yield name, f"damping.{law}", rest
        elif first in ("friction", "stops"):
            yield name, first, rest
        else:
            yield name, tables[name], name
