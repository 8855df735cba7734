"""Reports on a torque, in Markdown and JSON."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence

from pyjoystick.forced_motion.measures import PartMeasures, TorqueMeasures
from pyjoystick.forced_motion.work_cycle import MOVES_PER_SHIFT, Demand
from pyjoystick.model import JoystickParameters, LawName, parameter_list
from pyjoystick.support import TextTable, document_text


def measures_report(found: Mapping[LawName, TorqueMeasures]) -> str:
    """Table of the torque and its parts, for each damping law if it matters, and of the work of the hand."""
    first = next(iter(found.values()))
    parts = {"stiffness": first.parts["stiffness"], "inertia": first.parts["inertia"]}
    if "friction" in first.parts:
        parts["friction"] = first.parts["friction"]
    parts |= {f"damping, {law}": measures.parts["damping"] for law, measures in found.items()}
    parts |= {f"total, {law} damping": measures.total for law, measures in found.items()}
    header = ["torque (N m)", "highest", "lowest", "rms", "impulse (N m s)", "work (mJ)", "share"]
    rows = [_part_row(name, part) for name, part in parts.items()]
    return TextTable(header, rows).markdown() + "\n\n" + _hand_table(found)


def torque_json(
    motion: Mapping[str, object],
    joysticks: Mapping[LawName, JoystickParameters],
    found: Mapping[LawName, TorqueMeasures],
    differences: Mapping[LawName, float],
    notes: Sequence[str] = (),
) -> str:
    """The torque of a motion as JSON text, in SI units.

    Args:
        motion: description of the motion, by name
        joysticks: the joysticks by damping law
        found: their torques
        differences: differences between FMU and plain Python, relative to the largest value of the torque or
            part
        notes: notes on the motion
    """
    laws = [
        {
            "damping": law,
            "parameters": parameter_list(joysticks[law]),
            **dataclasses.asdict(one),
            "parts": [{"name": name, **dataclasses.asdict(part)} for name, part in one.parts.items()],
            "work": one.work,
            "loss": one.loss,
            "peak_force": one.peak_force,
            "difference_to_plain_python": differences[law],
        }
        for law, one in found.items()
    ]
    return document_text("torque", {"motion": motion, "laws": laws}, notes)


def demand_report(demands: Mapping[str, Demand], *, moves: int = MOVES_PER_SHIFT) -> str:
    """Percentiles of the force, work and impulse, one row per variant.

    Args:
        demands: by label
        moves: number of moves in a shift
    """
    percentages = (10.0, 50.0, 90.0, 99.0)
    rows = [
        [
            label,
            *(f"{demand.force(percentage):.2f}" for percentage in percentages),
            f"{demand.force(100.0):.2f}",
            f"{demand.torque(100.0):.2f}",
            f"{demand.positive_work:.3f}",
            f"{demand.negative_work:.3f}",
            f"{demand.work_per_shift(moves) / 1e3:.2f}",
            f"{demand.impulse_per_shift(moves) / 1e3:.0f}",
        ]
        for label, demand in demands.items()
    ]
    header = [
        "",
        *(f"F {percentage:.0f} % (N)" for percentage in percentages),
        "F max (N)",
        "T max (N m)",
        "W+ (J/move)",
        "W- (J/move)",
        "W+ (kJ/shift)",
        "impulse (kN s/shift)",
    ]
    return TextTable(header, rows).markdown()


def _part_row(name: str, part: PartMeasures) -> list[str]:
    return [
        name,
        f"{part.highest:.3f}",
        f"{part.lowest:.3f}",
        f"{part.rms:.3f}",
        f"{part.impulse:.4f}",
        f"{1e3 * part.work:.2f}",
        f"{100.0 * part.share:.1f} %",
    ]


def _hand_table(found: Mapping[LawName, TorqueMeasures]) -> str:
    rows = [
        [
            f"{law} damping",
            f"{measures.peak_force:.2f}",
            f"{1e3 * measures.positive_work:.1f}",
            f"{-1e3 * measures.negative_work:.1f}",
            f"{1e3 * measures.energy_change:.2f}",
            f"{1e3 * measures.loss:.2f}",
            f"{100.0 * measures.peak_ratio('damping'):.1f} %",
            f"{measures.peak_ratio('inertia', 'stiffness'):.2f}",
        ]
        for law, measures in found.items()
    ]
    header = [
        "hand",
        "force (N)",
        "work done (mJ)",
        "done on the hand (mJ)",
        "stored (mJ)",
        "loss (mJ)",
        "damping/total",
        "inertia/stiffness",
    ]
    return TextTable(header, rows).markdown()
