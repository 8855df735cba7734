"""The sections of a report on a joystick, each a function of the study: figures, tables and text."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.forced_motion import ForwardAndReturn, Samples, measure, plot_torque, torque_by_reference
from pyjoystick.laboratory import cubic_fits, plot_load_deflection
from pyjoystick.model import (
    NOMINAL,
    PIVOT_TO_TOP,
    STOP_ANGLE,
    JoystickParameters,
    NoOscillationError,
    PowerLawDamping,
    body_table,
    damping_table,
    decaying_periods,
    exponent,
    friction_table,
    period_table,
    plot_periods,
    segment_table,
    spring_table,
    stops_table,
)
from pyjoystick.motion import periods
from pyjoystick.reports.dissipation import (
    damping_jumps,
    equivalent_damping,
    mean_damping,
    plateaus,
    plot_damping_function,
    plot_energy,
)
from pyjoystick.reports.html_report.known_digits import row_cells
from pyjoystick.reports.html_report.page import Section, figure, paragraph
from pyjoystick.reports.html_report.study import Study
from pyjoystick.support import LAWS, FloatArray, TextTable, plot_motion

_DEG: Final = math.degrees(1.0)
_PEAKS: Final = 10
_SHOWN: Final = (0.5, 1.0, 2.0, 5.0, 10.0, 20.0)  # deg
_DRAWN: Final = np.geomspace(0.2, 20.8, 160)  # deg
_STROKES: Final = (0.12, 0.3, 0.5)  # s


def parameter_section(study: Study) -> Section:
    """All parameters of the joystick."""
    joystick = study.joystick
    return Section(
        "Parameters",
        [
            body_table(joystick, study.pivot_to_top).html("Inertia and geometry."),
            segment_table(joystick).html("Load-deflection curves: stiffness k_i from travel x_i on."),
            spring_table(joystick).html("The restrained preloaded springs that give these curves."),
            damping_table(joystick.damping).html(f"Damping law: {study.law}."),
            *([friction_table(joystick.friction).html("Dry friction.")] if joystick.friction else []),
            *([stops_table(joystick.stops).html("Mechanical stops.")] if joystick.stops else []),
        ],
    )


def spring_section(study: Study) -> Section:
    """The load-deflection curves."""
    fits = cubic_fits(study.joystick, STOP_ANGLE)
    ends = ", ".join(f"{side} {fit.force[-1]:.0f} N" for side, fit in fits.items())
    alt = (
        "Force over travel on both sides: steep up to the preload of the return spring, then gradual, steep "
        f"again where the balance spring comes in; at 20 degrees {ends}."
    )
    caption = "Force of the actuators over their travel up to 20 degrees, and cubic polynomials fitted to it."
    return Section("Springs", [figure(plot_load_deflection(fits), caption, alt=alt)])


def oscillation_section(study: Study) -> Section:
    """The free oscillation and its peaks."""
    angle = math.degrees(study.release_angle)
    shown = study.peaks.head(_PEAKS)
    table, known = _peak_table(study), study.uncertainties(_peak_table)
    rows = [
        [
            str(i + 1),
            *row_cells(table, known, i, (".4f", 1.0), ("+.3f", _DEG), (".1f", 1e3)),
        ]
        for i in range(len(shown))
    ]
    off = float(np.max(np.abs(study.run["theta"].to_numpy() - study.trajectory.theta)))
    label = f"{study.law} damping"
    drawn = plot_motion({label: study.run}, styles={label: LAWS[study.law] | {"linestyle": "-"}})
    alt = (
        f"Displacement, velocity and acceleration over time after a release at {angle:g} degrees; "
        f"{len(study.peaks)} peaks."
    )
    header = ("peak", "time (s)", "displacement (deg)", "period around it (ms)")
    return Section(
        "Free oscillation",
        [
            figure(drawn, f"Released from rest at {angle:g} degrees.", alt=alt),
            paragraph(
                f"Simulated by the FMU; the reference in plain Python differs by at most {off:.0e} rad."
            ),
            TextTable(header, rows).html(f"The first peaks of the displacement{_digits(study)}."),
        ],
    )


def period_section(study: Study) -> Section:
    """Undamped periods over amplitudes, compared with those of the free oscillation."""
    side = math.copysign(1.0, study.release_angle)
    numbers = _periods(study.joystick, side * np.radians(_SHOWN))

    def lengths(of: Study) -> FloatArray:
        return _periods(of.joystick, side * np.radians(_SHOWN))[["period"]].to_numpy(dtype=np.float64)

    curve = _periods(study.joystick, side * np.radians(_DRAWN))
    if len(curve) < 3:
        return Section(
            "Period and amplitude", [paragraph("This joystick does not oscillate through the middle.")]
        )
    table, known = lengths(study), study.uncertainties(lengths)
    rows = [
        [
            f"{release * _DEG:g}",
            *row_cells(table, known, i, (".2f", 1e3)),
            *(f"{100.0 * part:.0f}" for part in parts),
            f"{np.interp(amplitude, curve['amplitude'], exponent(curve)):+.2f}",
        ]
        for i, (release, amplitude, *parts) in enumerate(
            _rows(numbers, "release", "amplitude", "clearance", "steep", "soft")
        )
    ]
    header = ("release (deg)", "period (ms)", "in clearance (%)", "in steep (%)", "in soft (%)", "power")
    decaying = {"this free oscillation": (decaying_periods(study.peaks), LAWS[study.law]["color"])}
    shortest = curve.iloc[int(np.argmin(curve["period"]))]
    words = (
        "Without damping, from the energy: where the preload is nearly all of the force the period "
        "goes with the "
        "square root of the amplitude, the power 0.5; a linear spring would have the power 0. The shortest "
        f"period, {1e3 * shortest['period']:.1f} ms, is that of {shortest['amplitude'] * _DEG:.2f} degrees."
    )
    alt = (
        f"Period over amplitude: shortest {1e3 * shortest['period']:.0f} ms; below it the parts of "
        "the period by segment."
    )
    return Section(
        "Period and amplitude",
        [
            paragraph(words),
            figure(plot_periods(curve, decaying), "Undamped period, and where its time goes.", alt=alt),
            TextTable(header, rows).html(
                f"Undamped periods, and parts of the period by kind of segment{_digits(study)}."
            ),
        ],
    )


def energy_section(study: Study) -> Section:
    """Energy over time with its plateaus."""
    run = study.trajectory
    rests = plateaus(run).head(_PEAKS)
    table = np.array(_rows(rests, "time", "theta", "energy", "swing_lost"))
    known = study.uncertainties(_energy_table)
    shown = (".4f", 1.0), ("+.2f", _DEG), (".1f", 1e3), (".1f", 1e3)
    rows = [row_cells(table, known, i, *shown) for i in range(len(table))]
    header = ("turns at (s)", "angle (deg)", "energy (mJ)", "lost in the swing before (mJ)")
    alt = (
        f"The energy falls in steps from {1e3 * run.E[0]:.0f} mJ to {1e3 * run.E[-1]:.1f} mJ; "
        "plateaus around the turning points."
    )
    caption = "Energy of the free oscillation, and the power that the damping takes."
    return Section(
        "Energy",
        [
            figure(plot_energy(run, rests), caption, alt=alt),
            TextTable(header, rows).html(f"The steps of the energy{_digits(study)}."),
        ],
    )


def damping_section(study: Study) -> Section:
    """The damping coefficient over time, and equivalent constants."""
    run = study.trajectory
    if not isinstance(study.joystick.damping, PowerLawDamping):
        words = (
            "The damping coefficient is constant." if study.moved else f"Constant: {run.C[0]:g} N m s/rad."
        )
        return Section("Damping over time", [paragraph(words)])
    mean, equivalent = mean_damping(run), equivalent_damping(run)
    largest = damping_jumps(run)["jump"].max()
    constant = NOMINAL.to_names()["damping.C"]
    words = (
        f"The mean over time is {mean:.4f} N m s/rad; a constant {equivalent:.4f} takes as much "
        "energy along this "
        f"motion. The largest jump between samples is {largest:.3f} N m s/rad."
    )
    drawn = plot_damping_function(run, constant=constant, equivalent=equivalent)
    alt = f"The damping coefficient over time, with spikes where angle or velocity is zero; mean {mean:.3f}."
    return Section(
        "Damping over time", [paragraph(words), figure(drawn, "Damping function, eq. (11).", alt=alt)]
    )


def torque_section(study: Study) -> Section:
    """The torque of a stroke and its return, and its dependence on the stroke time."""
    joystick, pivot_to_handle = study.joystick, study.pivot_to_top or PIVOT_TO_TOP
    rows = []
    for rise in _STROKES:
        samples = Samples.of(joystick, _stroke(rise))
        found = measure(
            joystick, samples, torque_by_reference(joystick, samples), pivot_to_handle=pivot_to_handle
        )
        shares = (100.0 * found.peak_ratio(part) for part in ("stiffness", "inertia", "damping"))
        cells = (f"{found.total.peak:.2f}", f"{found.peak_force:.1f}", *(f"{share:.0f}" for share in shares))
        rows.append([f"{rise:g}", *cells, f"{1e3 * found.loss:.0f}"])
    samples = Samples.evenly(_stroke(_STROKES[0]), 5e-4)
    shown = torque_by_reference(joystick, samples, pivot_to_handle=pivot_to_handle)
    header = (
        "stroke (s)",
        "torque (N m)",
        "force (N)",
        "stiffness (%)",
        "inertia (%)",
        "damping (%)",
        "loss (mJ)",
    )
    handle = f"{pivot_to_handle:g} m" + ("" if study.pivot_to_top else ", that of the paper's joystick")
    caption = f"Torque, eq. (13), for a minimum-jerk motion to 18 degrees in {_STROKES[0]:g} s and back."
    alt = f"Stiffness, damping, inertia and total torque over time; the total has a peak of {rows[0][1]} N m."
    return Section(
        "Torque",
        [
            figure(plot_torque({study.law: shown}), caption, alt=alt),
            TextTable(header, rows).html(
                "Peaks over a motion to 18 degrees and back, force at the top of the handle "
                f"({handle}), peaks of the parts over the peak of the torque, and energy lost.",
            ),
        ],
    )


#: In the order of the page.
SECTIONS: Final[Mapping[str, Callable[[Study], Section]]] = {
    "parameters": parameter_section,
    "springs": spring_section,
    "free oscillation": oscillation_section,
    "periods": period_section,
    "energy": energy_section,
    "damping": damping_section,
    "torque": torque_section,
}


def _digits(study: Study) -> str:
    return ", to the digits that the uncertainties of the parameters leave" if study.moved else ""


def _peak_table(study: Study) -> FloatArray:
    """Time (s), angle (rad) and period (s) of the first peaks, shape (peaks, 3); NaN where there is none."""
    table = np.full((_PEAKS, 3), np.nan)
    shown = study.peaks.head(_PEAKS)
    spans = periods(study.peaks, release_time=0.0)["period"].to_numpy()[: len(shown)]
    table[: len(shown), :2] = shown[["time", "value"]]
    table[: len(spans), 2] = spans
    return table


def _energy_table(study: Study) -> FloatArray:
    """Time (s), angle (rad), energy (J) and loss of the swing before (J) by peak, shape (peaks, 4)."""
    times, angles, _ = _peak_table(study).T
    time = study.run.index.to_numpy(dtype=np.float64)
    energy = np.interp(times, time, study.run["E"].to_numpy(dtype=np.float64))
    lost = -np.diff(energy, prepend=float(study.run["E"].iloc[0]))
    return np.column_stack((times, angles, energy, lost))


def _periods(joystick: JoystickParameters, releases: np.ndarray) -> pd.DataFrame:
    """Table of the releases from which the joystick oscillates."""
    tables = []
    for release in releases:
        try:
            tables.append(period_table(joystick, [float(release)]))
        except NoOscillationError:
            continue
    return pd.concat(tables, ignore_index=True) if tables else pd.DataFrame()


def _rows(content: pd.DataFrame, *columns: str) -> list[list[float]]:
    """Some columns, by row."""
    found: list[list[float]] = content[list(columns)].to_numpy(dtype=np.float64).tolist()
    return found


def _stroke(rise: float) -> ForwardAndReturn:
    return ForwardAndReturn(amplitude=math.radians(18.0), rise=rise, rest=0.1)
