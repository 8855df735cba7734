"""The schema of parameter files."""

from __future__ import annotations

import dataclasses

from pyjoystick import model
from pyjoystick.project.editor_schemas.blocks import FLAG, NUMBER, TEXT, Schema, array, table


def parameter_schema() -> Schema:
    """The schema of a parameter file."""

    def numbers(keys: tuple[str, ...], optional: tuple[str, ...] = ()) -> Schema:
        found = {name: one for key in keys for name, one in ((key, NUMBER), (f"u_{key}", NUMBER))}
        return table(tuple(one for one in keys if one not in optional), **found, source=TEXT)

    segments = array(NUMBER, 4, 4)
    side = table(("x", "k"), x=segments, k=segments, u_x=segments, u_k=segments, source=TEXT)
    laws = {
        name: numbers(tuple(one.name for one in dataclasses.fields(law)), ("eps_theta", "eps_omega"))
        for name, law in model.PAPER.laws.items()
    }
    tables = {name: numbers(keys, ("pivot_to_top",)) for name, keys in model.PLAIN_TABLES.items()}
    damping = table(("law",), law={"enum": list(laws)}, **laws)
    friction = tuple(name.removeprefix("friction.") for name in model.FRICTION_NAMES)
    stops = tuple(name.removeprefix("stops.") for name in model.STOP_NAMES)
    required = (*model.PLAIN_TABLES, *model.SIDES, "damping")
    return table(
        required,
        title=TEXT,
        implausible=FLAG,
        **tables,
        **dict.fromkeys(model.SIDES, side),
        damping=damping,
        friction=numbers(friction, friction),
        stops=numbers(stops, stops),
    )
