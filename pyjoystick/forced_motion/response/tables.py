"""Tables of the response: branches point by point, special points, attractors."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Final

import pandas as pd

from pyjoystick.forced_motion.periodic.solutions import PeriodicSolution
from pyjoystick.forced_motion.response.attractors import Basins, PeriodicAttractor, UnsettledMotion
from pyjoystick.forced_motion.response.branches import Response, ResponseBranch
from pyjoystick.forced_motion.response.shaken import FREQUENCY, TORQUE, ShakenJoystick
from pyjoystick.model import parameter_list
from pyjoystick.support import DEFAULT_TOLERANCE, TextTable, document_text

_UNITS: Final = {FREQUENCY: "Hz", TORQUE: "N m"}


def with_unit(name: str) -> str:
    """Name of a free parameter, with the unit if it belongs to the torque."""
    return f"{name} ({_UNITS[name]})" if name in _UNITS else name


def branch_table(response: Response) -> pd.DataFrame:
    """Every solution of every branch, in order, in SI units.

    Returns:
        the columns ``branch`` (from 1 on), ``periods`` (of the torque), the free parameter by its name,
        ``theta`` and ``omega`` at the beginning of the period, ``theta_max``, ``theta_min``, ``amplitude``
        (half of their distance), real and imaginary parts of the two Floquet multipliers
        (``multiplier1``, ``multiplier1_imag`` ...), ``stable``; ``derivatives``, which are ``exact`` or
        ``differences``; and of these the ``error`` of the monodromy matrix as estimated, in units of the
        scales of the states
    """
    rows = [
        {"branch": number, **_row(response.shaken.with_periods(branch.periods), branch, one)}
        for number, branch in enumerate(response.branches, 1)
        for one in branch.solutions
    ]
    return pd.DataFrame(rows)


def _row(shaken: ShakenJoystick, branch: ResponseBranch, solution: PeriodicSolution) -> dict[str, Any]:
    high, low = shaken.orbit(solution.state, solution.parameter).extremes
    first, second = solution.multipliers
    return {
        "periods": branch.periods,
        shaken.free: solution.parameter,
        "theta": solution.state[0],
        "omega": solution.state[1],
        "theta_max": high,
        "theta_min": low,
        "amplitude": 0.5 * (high - low),
        "multiplier1": first.real,
        "multiplier1_imag": first.imag,
        "multiplier2": second.real,
        "multiplier2_imag": second.imag,
        "stable": solution.is_stable,
        "derivatives": _derivatives(solution),
        "error": solution.map.error,
    }


def _derivatives(solution: PeriodicSolution) -> str:
    return "exact" if solution.map.error is None else "differences"


def special_table(response: Response) -> pd.DataFrame:
    """Folds, period doublings and grazings: ``branch``, ``kind``, the free parameter, ``amplitude`` (rad)."""
    rows = [
        {
            "branch": number,
            "kind": point.kind,
            response.shaken.free: point.solution.parameter,
            "amplitude": response.shaken.with_periods(branch.periods)
            .orbit(point.solution.state, point.solution.parameter)
            .amplitude,
        }
        for number, branch in enumerate(response.branches, 1)
        for point in branch.special
    ]
    return pd.DataFrame(rows, columns=["branch", "kind", response.shaken.free, "amplitude"])


def attractor_report(found: Basins, shaken: ShakenJoystick) -> str:
    """Attractors in Markdown: the share of releases that lead there, and until when runs can be trusted."""
    rows = []
    for number, one in enumerate(found.attractors):
        share = f"{100.0 * found.share(number):.0f} %"
        largest = f"{math.degrees(one.largest):.4g}"
        if isinstance(one, PeriodicAttractor):
            periods = f"{one.periods} T" if one.periods > 1 else "T"
            exponent = one.solution.exponents(one.periods / shaken.shaking.frequency)[0].real
            rows.append([f"periodic, {periods}", largest, share, f"{exponent:.5g}", "the end"])
        else:
            rows.append([_name(one), largest, share, *_unsettled_cells(one)])
    header = ["motion", "largest angle (deg)", "of the releases", "largest exponent (1/s)", "trusted until"]
    return TextTable(header, rows).markdown()


def _name(motion: UnsettledMotion) -> str:
    if not motion.exponent.is_chaotic:
        return "not settled"
    return "chaotic for a while" if motion.exponent.settled else "chaotic"


def _unsettled_cells(motion: UnsettledMotion) -> tuple[str, str]:
    exponent = motion.exponent
    until = f"{motion.trusted:.2g} s" if math.isfinite(motion.trusted) else "the end"
    return f"{exponent.value:.3g} +- {exponent.error:.1g}", until


def branch_report(response: Response) -> str:
    """Branches in Markdown, followed by their special points; grazings are only counted."""
    free = response.shaken.free
    rows, special = [], []
    for number, branch in enumerate(response.branches, 1):
        values = [one.parameter for one in branch.solutions]
        stable = sum(one.is_stable for one in branch.solutions)
        grazings = [point for point in branch.special if point.kind.startswith("grazing")]
        rows.append(
            [
                str(number),
                str(branch.periods),
                f"{min(values):.5g} to {max(values):.5g}",
                f"{stable} of {len(values)}",
                str(len(grazings)),
                " / ".join(dict.fromkeys(branch.ends)),
            ]
        )
        special += [
            [str(number), point.kind, f"{point.solution.parameter:.7g}"]
            for point in branch.special
            if point not in grazings
        ]
    header = ["branch", "periods", with_unit(free), "stable points", "grazings", "ends"]
    text = TextTable(header, rows).markdown()
    if special:
        text += "\n\n" + TextTable(["branch", "what", with_unit(free)], special).markdown()
    return text


def response_json(
    shaken: ShakenJoystick, found: Basins, response: Response | None, notes: Sequence[str] = ()
) -> str:
    """All results as JSON text, in SI units."""
    document: dict[str, Any] = {
        "torque": shaken.shaking.torque,
        "frequency": shaken.shaking.frequency,
        "parameters": parameter_list(shaken.joystick),
        "releases": [
            {"theta": theta, "omega": omega, "attractor": label}
            for omega, labels in zip(found.omega, found.labels, strict=True)
            for theta, label in zip(found.theta, labels, strict=True)
        ],
        "attractors": [_attractor(one, shaken) for one in found.attractors],
    }
    if response is not None:
        document["free"] = response.shaken.free
        document["limits"] = response.limits
        document["branches"] = [
            {"branch": number, "periods": one.periods, "ends": one.ends, "reasons": one.reasons}
            for number, one in enumerate(response.branches, 1)
        ]
        document["points"] = branch_table(response).to_dict("records")
        document["special"] = special_table(response).to_dict("records")
    return document_text("response", document, notes)


def _attractor(one: PeriodicAttractor | UnsettledMotion, shaken: ShakenJoystick) -> dict[str, Any]:
    if isinstance(one, UnsettledMotion):
        return {
            "kind": _name(one),
            "largest": one.largest,
            "exponent": one.exponent.value,
            "exponent_error": one.exponent.error,
            "settled": one.exponent.settled,
            "tolerance": DEFAULT_TOLERANCE,
            "trusted_until": one.trusted,
            "section": one.section,
        }
    exponents = one.solution.exponents(one.periods / shaken.shaking.frequency)
    return {
        "kind": "periodic",
        "periods": one.periods,
        "largest": one.largest,
        "state": one.solution.state,
        "multipliers": [[value.real, value.imag] for value in one.solution.multipliers],
        "exponents": [[value.real, value.imag] for value in exponents],
        "derivatives": _derivatives(one.solution),
        "error": one.solution.map.error,
    }
