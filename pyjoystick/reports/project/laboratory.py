"""Content of a project's ``laboratory.toml``."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from pyjoystick import laboratory, model, motion

#: File that makes a folder a project.
LABORATORY_FILE: Final = "laboratory.toml"


@dataclass(frozen=True, slots=True, kw_only=True)
class CurveSource:
    """File of the load-deflection curve of one side, and how to read it.

    Attributes:
        file: as written in ``laboratory.toml``, relative to the project
        columns, units: headings and their units, as for `read_load_curve`
        layout: layout of the file, where it is not detected
        travel_noise, force_noise: standard deviations of one sample (m, N); if None, from the scatter of the
            samples
        friction: whether half the hysteresis is attributed to dry friction along the plungers
    """

    file: str
    columns: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    layout: motion.Layout = field(default_factory=motion.Layout)
    travel_noise: float | None = None
    force_noise: float | None = None
    friction: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class SwingSource:
    """A swing test, recorded or timed with a stopwatch.

    Attributes:
        file: record of the swing; empty for stopwatch readings
        times: stopwatch readings (s)
        swings: number of full swings per reading
        amplitude, end_amplitude: amplitudes at the start and at the end of a reading (rad)
        reaction_time: standard uncertainty common to all readings (s); if None, a default
    """

    file: str = ""
    times: tuple[float, ...] = ()
    swings: int = 1
    amplitude: laboratory.Measured | None = None
    end_amplitude: laboratory.Measured | None = None
    reaction_time: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class MarkerSource:
    """Marker files that are read in the same way.

    Attributes:
        files: names or patterns, relative to the project
        setup: how the angle is computed from the markers
        radius_uncertainty: standard uncertainty of the radius in `setup` (m)
    """

    files: tuple[str, ...]
    setup: laboratory.MarkerSetup
    radius_uncertainty: float = 0.0


@dataclass(frozen=True, slots=True, kw_only=True)
class TableSource:
    """Tables of time and angle that are read in the same way; see `read_log` for the attributes."""

    files: tuple[str, ...]
    columns: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    layout: motion.Layout = field(default_factory=motion.Layout)
    scales: Mapping[str, motion.Scale] = field(default_factory=dict)
    rate: float | None = None
    start: float | None = None
    end: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class AccelerometerSource:
    """An accelerometer that recorded the same motion as a record.

    Attributes:
        file: file with its samples, relative to the project
        record: name of the record, which is the name of the motion's file without the suffix
        setup: where the accelerometer is mounted and how its file is read
    """

    file: str
    record: str
    setup: laboratory.AccelerometerSetup


@dataclass(frozen=True, slots=True, kw_only=True)
class FitChoice:
    """Choice of the fit to the records.

    Attributes:
        law: damping law of the standard fit
        file: file with the settings of another fit, relative to the project; empty for the standard fit
        known: measured parameters that the fit may change within their uncertainties, by FMU names or
            patterns; see `identification.known_values`
        even_if_doubtful: whether the results of a fit are used although it failed a check
    """

    law: model.LawName = "constant"
    file: str = ""
    known: tuple[str, ...] = ()
    even_if_doubtful: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class FmuChoice:
    """Choice of exported files; see `pyjoystick.reports.export_fmus`."""

    name: str | None = None
    versions: tuple[int, ...] = (2,)
    platforms: tuple[str, ...] = ()
    modelica: bool = False
    json: bool = False
    ssp: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Laboratory:
    """Files and settings of a laboratory, as stated in ``laboratory.toml``.

    Attributes:
        path: path of ``laboratory.toml``
        title: title of the joystick
        base: parameter file with the values that are not measured
        base_file: its name, relative to the project; empty for the paper's joystick
        asks: whether implausible values are refused
        given: values that ``laboratory.toml`` itself states
        parts: file with the table of parts; empty if there is none
        swing: swing test; None if there is none
        curves: load-deflection curves by side
        markers, tables: recorded motions, as markers or as tables of time and angle
        accelerometers: accelerometers that recorded some of these motions
        fit: how the records are fitted
        scale: relative standard uncertainty of the angle's scale; if None, that of the markers' radius
        time_base: relative standard uncertainty of the records' clock
        force_scale: relative standard uncertainty of the load cell's scale
        release_angle: release angle of the runs shown by error budget and report (rad)
        fmus: what is exported
    """

    path: Path
    title: str
    base: model.ParameterFile
    base_file: str
    asks: bool
    given: laboratory.MeasuredValues
    parts: str
    swing: SwingSource | None
    curves: Mapping[model.Side, CurveSource]
    markers: tuple[MarkerSource, ...]
    tables: tuple[TableSource, ...]
    accelerometers: tuple[AccelerometerSource, ...]
    fit: FitChoice
    scale: float | None
    time_base: float
    force_scale: float
    release_angle: float
    fmus: FmuChoice

    @property
    def root(self) -> Path:
        """Folder of the project."""
        return self.path.parent

    def angle_scale(self) -> float:
        """Return the relative standard uncertainty of the angle's scale; the largest of all radii if None."""
        if self.scale is not None:
            return self.scale
        return max(
            (one.radius_uncertainty / one.setup.radius for one in self.markers if one.setup.radius),
            default=0.0,
        )


def plain(value: Any) -> Any:
    """Convert settings to JSON types, for comparison with those of an earlier run."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {one.name: plain(getattr(value, one.name)) for one in dataclasses.fields(value)}
    if isinstance(value, Mapping):
        return {str(key): plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [plain(one) for one in value]
    return value if value is None or isinstance(value, str | int | float | bool) else str(value)
