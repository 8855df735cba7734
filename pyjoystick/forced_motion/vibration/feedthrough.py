"""Feedthrough of several handles, for small and driven vibrations, as tables."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

from pyjoystick.forced_motion.vibration.direction import Direction
from pyjoystick.forced_motion.vibration.mounted import Hand, MountedHandle
from pyjoystick.model import JoystickParameters, parameter_list
from pyjoystick.support import FloatArray, TextTable, document_text


@dataclass(frozen=True, eq=False)
class Feedthrough:
    """Responses of handles on a vibrating base.

    Attributes:
        direction: direction of the base's vibration
        few: frequencies of the tables and of the driven motions (Hz), shape (n,)
        small: `MountedHandle.small` by the handle's name, at many frequencies including `few`
        driven: `MountedHandle.driven` by name and acceleration, such as ``hand, 5 m/s2``
    """

    direction: Direction
    few: FloatArray
    small: Mapping[str, pd.DataFrame]
    driven: Mapping[str, pd.DataFrame]


def feedthrough(
    handles: Mapping[str, MountedHandle], few: FloatArray, many: FloatArray, accelerations: Sequence[float]
) -> Feedthrough:
    """Compute the responses of some handles.

    Args:
        handles: by name, one or more, on bases that vibrate in the same direction
        few: frequencies (Hz), shape (n,)
        many: additional frequencies for small vibrations (Hz), shape (m,)
        accelerations: amplitudes of the base (`Direction.unit`)

    Raises:
        ParameterError, FmuRunError: as `MountedHandle`
    """
    lines = np.union1d(few, many)
    direction = next(iter(handles.values())).direction
    return Feedthrough(
        direction,
        few,
        {name: handle.small(lines) for name, handle in handles.items()},
        {
            f"{name}, {size:g} {direction.unit}": handle.driven(few, size)
            for size in accelerations
            for name, handle in handles.items()
        },
    )


def feedthrough_report(found: Feedthrough) -> str:
    """Two tables in Markdown: the angle in degrees per base acceleration, and the motion in space."""
    series = {name: table.reindex(found.few) for name, table in found.small.items()} | dict(found.driven)
    return "\n\n".join(
        TextTable(
            [heading, *series],
            [
                [f"{frequency:.3g}", *(_cell(factor * table[column].iloc[i]) for table in series.values())]
                for i, frequency in enumerate(found.few)
            ],
        ).markdown()
        for heading, column, factor in (
            (f"Hz: angle (deg per {found.direction.unit})", "gain", float(np.degrees(1.0))),
            (f"Hz: {found.direction.seen} over base", "transmissibility", 1.0),
        )
    )


def _cell(value: float) -> str:
    return "not with its period" if np.isnan(value) else f"{value:.3g}"


def feedthrough_json(
    found: Feedthrough, joystick: JoystickParameters, held: float, hand: Hand, notes: Sequence[str] = ()
) -> str:
    """All responses as JSON text, in SI units.

    Args:
        found: the responses
        joystick: the joystick, without the hand
        held: angle at which the handle is held (rad)
        hand: the hand of the series named so
        notes: notes on the responses
    """
    content = {
        "direction": found.direction.value,
        "theta": held,
        "hand": dataclasses.asdict(hand),
        "parameters": parameter_list(joystick),
        "responses": feedthrough_table(found).to_dict("records"),
    }
    return document_text("vibration", content, notes)


def feedthrough_table(found: Feedthrough) -> pd.DataFrame:
    """All responses concatenated: ``series``, ``frequency`` and the columns of each, in SI units."""
    parts = [
        table.reset_index().assign(series=name)
        for name, table in (*found.small.items(), *found.driven.items())
    ]
    whole = pd.concat(parts, ignore_index=True)
    return whole[["series", *whole.columns.drop("series")]]
