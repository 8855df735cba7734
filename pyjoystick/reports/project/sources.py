"""Sources of a joystick's parameters, grouped by the tables of its parameter file."""

from __future__ import annotations

from collections.abc import Mapping

from pyjoystick import laboratory, model


def table_of(name: str, joystick: model.JoystickParameters) -> str:
    """Return the table of a parameter file that contains the parameter with this FMU name."""
    first, _, rest = name.partition(".")
    if first == "damping":
        return f"damping.{model.law_name(joystick.damping)}"
    return first if rest else laboratory.PLACES[name].partition(".")[0]


def spring_names(joystick: model.JoystickParameters, side: str) -> tuple[str, ...]:
    """Return the FMU names of the parameters of a side's springs."""
    return tuple(name for name in joystick.to_names() if name.startswith(f"{side}."))


def table_sources(
    sources: Mapping[str, str], joystick: model.JoystickParameters, base: model.ParameterFile
) -> dict[str, str]:
    """Return the sources by table, such as ``m, h: parts.csv; J: fit to trial.csv``.

    Args:
        sources: sources of parameters, by FMU name
        joystick: joystick with these parameters
        base: parameter file with the sources of all others
    """
    grouped: dict[str, dict[str, list[str]]] = {}
    # Not a parameter of the motion, but in the same table as some that are.
    top = ("pivot_to_top",) if base.pivot_to_top is not None else ()
    for name in dict.fromkeys((*joystick.to_names(), *top, *sources)):
        table = table_of(name, joystick)
        source = sources.get(name, base.sources.get(table, "not stated"))
        grouped.setdefault(table, {}).setdefault(source, []).append(name.removeprefix(f"{table}."))
    touched = {table_of(name, joystick) for name in sources}
    return {
        table: next(iter(found))
        if len(found) == 1
        else "; ".join(f"{', '.join(names)}: {source}" for source, names in found.items())
        for table, found in grouped.items()
        if table in touched
    }
