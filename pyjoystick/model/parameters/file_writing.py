"""Writing a parameter file: changed values are replaced; comments and everything else are kept."""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from pyjoystick.model.parameters.file import (
    IMPLAUSIBLE,
    PAPER,
    PLAIN_TABLES,
    SIDES,
    ParameterFile,
    law_name,
    read_parameter_file,
)
from pyjoystick.model.parameters.joystick import JoystickParameters
from pyjoystick.model.parameters.plausible import ImplausibleError, require_plausible
from pyjoystick.support import SettingsError, UnknownParameterError, not_negative, replacing

if TYPE_CHECKING:
    from tomlkit.items import Table
    from tomlkit.toml_document import TOMLDocument


_ELEMENT: Final = re.compile(r"(?P<place>.*)\[(?P<index>\d+)\]")

#: Values by table and key; a list for the keys x and k.
_Values = Mapping[tuple[str, str], float | list[float]]


def write_parameters(
    path: str | PathLike[str],
    joystick: JoystickParameters,
    *,
    pivot_to_top: float | None = None,
    title: str | None = None,
    uncertainties: Mapping[str, float] | None = None,
    sources: Mapping[str, str] | None = None,
) -> None:
    """Write a joystick to a parameter file.

    An existing file is updated: its comments, unchanged values and the parameters of the other damping law
    are kept. A new file starts as a copy of the paper's. If a number changes, its old uncertainty and the old
    source of its table are removed, unless new ones are given. If a number is implausible, ``implausible =
    true`` is added.

    Args:
        path: the file
        joystick: the new values; the curves are equal up to rounding, everything else exactly
        pivot_to_top: distance from the pivot to the top of the handle (m); if None, it is kept
        title: title for reports; if None, it is kept, or is the name of a new file
        uncertainties: standard uncertainties (SI units) by place, as in `ParameterFile.uncertainties`; those
            of a list must be given for all of its numbers
        sources: sources of the numbers, by table, as in `ParameterFile.sources`

    Raises:
        UnknownParameterError: an uncertainty or a source of something that is not in the file
        ParameterError: an uncertainty is not finite or below 0
        InputFileError, SettingsError: the existing file is invalid, or would be; it is left unchanged
        OutputFileError: the file cannot be written
    """
    target = Path(path)
    exists = target.exists()
    text = updated_text(
        read_parameter_file(target) if exists else PAPER,
        joystick,
        pivot_to_top=pivot_to_top,
        title=target.stem if title is None and not exists else title,
        uncertainties=uncertainties,
        sources=sources,
    )
    with replacing(target) as temporary:
        temporary.write_text(text, encoding="utf-8", newline="\n")
        try:
            read_parameter_file(temporary)
        except SettingsError as error:
            raise dataclasses.replace(error, path=target) from None


def updated_text(
    before: ParameterFile,
    joystick: JoystickParameters,
    *,
    pivot_to_top: float | None = None,
    title: str | None = None,
    uncertainties: Mapping[str, float] | None = None,
    sources: Mapping[str, str] | None = None,
) -> str:
    """The text of a parameter file after a change, as `write_parameters` describes it.

    Raises:
        UnknownParameterError: an uncertainty or a source of something that is not in the file
        ParameterError: an uncertainty is not finite or below 0
    """
    # Import it here, because it loads more slowly than everything else in this package.
    import tomlkit

    document = tomlkit.parse(before.path.read_text(encoding="utf-8"))
    if title is not None:
        document["title"] = title
    law = law_name(joystick.damping)
    damping = _table(document, "damping")
    if damping["law"] != law:
        damping["law"] = law
    if law not in before.laws:
        damping[law] = tomlkit.table()
    wanted = _values(joystick, before)
    for name in _DEFAULTS:
        optional = _optional_values(name, joystick, document, uncertainties or {})
        if optional and name not in document:
            document[name] = tomlkit.table()
        wanted |= optional
    top = before.pivot_to_top if pivot_to_top is None else float(pivot_to_top)
    if top is not None:
        wanted["geometry", "pivot_to_top"] = top
    if _is_implausible(joystick, top):
        document[IMPLAUSIBLE] = True
    changed = _set_values(document, wanted, _grouped(uncertainties or {}, wanted))
    _set_sources(document, changed, sources or {})
    return tomlkit.dumps(document)


def _is_implausible(joystick: JoystickParameters, pivot_to_top: float | None) -> bool:
    """Whether the file needs ``implausible = true`` to be read again."""
    numbers = [*joystick.to_names().items(), ("pivot_to_top", pivot_to_top or 0.0)]
    for curve in (joystick.forward.to_table(), joystick.backward.to_table()):
        numbers += [("k", value) for value in curve.k]
    try:
        for name, value in numbers:
            require_plausible(name, value)
    except ImplausibleError:
        return True
    return False


def _values(
    joystick: JoystickParameters, before: ParameterFile
) -> dict[tuple[str, str], float | list[float]]:
    """New contents of the file; an unchanged curve is kept as written."""
    values: dict[tuple[str, str], float | list[float]] = {}
    for table, keys in PLAIN_TABLES.items():
        values |= {(table, key): getattr(joystick, key) for key in keys if key != "pivot_to_top"}
    for side in SIDES:
        same = getattr(joystick, side) == getattr(before.joystick, side)
        curve = before.curves[side] if same else getattr(joystick, side).to_table()
        values |= {(side, "x"): list(curve.x), (side, "k"): list(curve.k)}
    name = f"damping.{law_name(joystick.damping)}"
    return values | {(name, key): value for key, value in dataclasses.asdict(joystick.damping).items()}


#: Values that missing optional tables stand for.
_DEFAULTS: Final = {name: dataclasses.asdict(getattr(PAPER.joystick, name)) for name in ("friction", "stops")}


def _optional_values(
    name: str, joystick: JoystickParameters, document: TOMLDocument, uncertainties: Mapping[str, float]
) -> dict[tuple[str, str], float | list[float]]:
    """What the file will say of friction or stops: what is there already, no default, or uncertain."""
    there = document.get(name, {})
    return {
        (name, key): value
        for key, value in dataclasses.asdict(getattr(joystick, name)).items()
        if value != _DEFAULTS[name][key] or key in there or f"{name}.{key}" in uncertainties
    }


def _grouped(uncertainties: Mapping[str, float], values: _Values) -> dict[tuple[str, str], Any]:
    """Uncertainties by table and key, grouped for lists."""
    grouped: dict[tuple[str, str], Any] = {}
    places = {f"{table}.{key}": (table, key) for table, key in values}
    for name, value in uncertainties.items():
        element = _ELEMENT.fullmatch(name)
        place = places.get(element["place"] if element else name)
        size = len(found) if place and isinstance(found := values[place], list) else 0
        if place is None or bool(element) != bool(size) or (element and int(element["index"]) >= size):
            raise UnknownParameterError(name, places)
        number = not_negative(f"uncertainty of {name}", value)
        if element:
            grouped.setdefault(place, {})[int(element["index"])] = number
        else:
            grouped[place] = number
    for place, numbers in grouped.items():
        if isinstance(numbers, dict):
            for i in range(len(values[place])):  # type: ignore[arg-type]  # only lists have elements
                if i not in numbers:
                    raise UnknownParameterError(f"{'.'.join(place)}[{i}]", uncertainties)
            grouped[place] = [numbers[i] for i in sorted(numbers)]
    return grouped


#: Comments on values that stand in no older file.
_COMMENTS: Final = {
    ("friction", "T_c"): "Coulomb friction moment at the pivot (N m)",
    ("friction", "F_c"): "Coulomb friction force along the plunger (N)",
    ("friction", "T_s"): "static friction moment at the pivot (N m)",
    ("friction", "omega_s"): "Stribeck velocity (rad/s)",
    ("stops", "theta_stop"): "angle of the stops, to either side (rad)",
    ("stops", "K"): "stiffness of a stop about the pivot (N m/rad)",
    ("stops", "D"): "damping of a stop about the pivot (N m s/rad)",
}


def _set_values(
    document: TOMLDocument, values: _Values, uncertain: Mapping[tuple[str, str], Any]
) -> set[str]:
    """Set values that differ; returns the names of the tables in which a number changed."""
    changed = set()
    for (name, key), value in values.items():
        table = _table(document, name)
        if key not in table or table[key].unwrap() != value:
            is_new = key not in table
            table[key] = value
            if is_new and (name, key) in _COMMENTS:
                table[key].comment(_COMMENTS[name, key])
            changed.add(name)
            if f"u_{key}" in table:
                del table[f"u_{key}"]
        if (name, key) in uncertain:
            table[f"u_{key}"] = uncertain[name, key]
    return changed


def _set_sources(document: TOMLDocument, changed: set[str], sources: Mapping[str, str]) -> None:
    for name in changed - set(sources):
        if "source" in _table(document, name):
            del _table(document, name)["source"]
    for name, source in sources.items():
        _table(document, name)["source"] = source


def _table(document: TOMLDocument, name: str) -> Table:
    """The table [name] of the document, such as [damping.constant]."""
    found: Any = document
    for part in name.split("."):
        if part not in found:
            raise UnknownParameterError(name, document)
        found = found[part]
    return found  # type: ignore[no-any-return]  # documents are not annotated below their tables


#: Digits of a standard error, and digits of a value beyond the first one of its standard error.
_DIGITS = 2


def rounded(value: float, error: float) -> float:
    """Round a value to a hundredth of its standard error or better; unchanged if there is no error."""
    if not 0.0 < error < math.inf:
        return value
    return round(value, _DIGITS - math.floor(math.log10(error)))


def rounded_error(error: float) -> float:
    """Round a standard error to two digits."""
    return float(f"{error:.{_DIGITS}g}")
