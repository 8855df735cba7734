"""What the file ``laboratory.toml`` of a project says."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final

from pyjoystick import laboratory, model, motion

#: The file that makes a folder a project.
FILE: Final = "laboratory.toml"


@dataclass(frozen=True, slots=True, kw_only=True)
class CurveSource:
    """The load-deflection curve of one side.

    Attributes:
        file: as written in ``laboratory.toml``, relative to the project
        columns, units: headings and their units, as for `read_load_curve`
        layout: the form of the file, where that is to be given
        travel_noise, force_noise: standard deviations of one sample (m, N); from their scatter if not given
        friction: whether half the hysteresis is the dry friction along the plungers
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
    """A swing test: a recorded one, or readings of a stopwatch.

    Attributes:
        file: the recorded swing; empty where there are readings
        times: readings (s)
        swings: number of full swings in a reading
        amplitude, end_amplitude: at the start and the end of a reading (rad)
        reaction_time: standard uncertainty common to all readings (s)
    """

    file: str = ""
    times: tuple[float, ...] = ()
    swings: int = 1
    amplitude: laboratory.Measured | None = None
    end_amplitude: laboratory.Measured | None = None
    reaction_time: float | None = None


@dataclass(frozen=True, slots=True, kw_only=True)
class MarkerSource:
    """Files of markers that are read in the same way.

    Attributes:
        files: names or patterns, relative to the project
        setup: how the angle is found
        radius_uncertainty: standard uncertainty of its radius (m)
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
    """An accelerometer.

    Attributes:
        file: its samples, relative to the project
        record: name of the record of the same motion: that of its file without the suffix
        setup: where it sits and how the file is read
    """

    file: str
    record: str
    setup: laboratory.AccelerometerSetup


@dataclass(frozen=True, slots=True, kw_only=True)
class FitChoice:
    """How the records are fitted.

    Attributes:
        law: damping law of the standard fits
        file: settings of another fit, relative to the project; empty for the standard one
        even_if_doubtful: whether results go on that failed a check
    """

    law: model.LawName = "constant"
    file: str = ""
    even_if_doubtful: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class FmuChoice:
    """What is exported; see `pyjoystick.reports.export_fmus`."""

    name: str | None = None
    versions: tuple[int, ...] = (2,)
    platforms: tuple[str, ...] = ()
    modelica: bool = False
    json: bool = False
    ssp: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Laboratory:
    """A laboratory's files and what they are.

    Attributes:
        path: ``laboratory.toml``
        title: of the joystick
        base: has the values that are not measured
        base_file: its file, relative to the project; empty for the paper's joystick
        asks: whether numbers that no joystick has are refused
        given: values that the file itself states
        parts: table of the parts; empty where there is none
        swing: swing test
        curves: load-deflection curves by side
        markers, tables: motions
        accelerometers: beside motions
        fit: how the motions are fitted
        scale: relative standard uncertainty of the scale of the angle; that of the markers' radius where None
        time_base: relative standard uncertainty of the clock of the records
        release_angle: of the runs that error budget and report show (rad)
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
    release_angle: float
    fmus: FmuChoice

    @property
    def root(self) -> Path:
        """The folder of the project."""
        return self.path.parent

    def angle_scale(self) -> float:
        """The relative standard uncertainty of the scale of the angle, the largest of all markers' radii."""
        if self.scale is not None:
            return self.scale
        return max(
            (one.radius_uncertainty / one.setup.radius for one in self.markers if one.setup.radius),
            default=0.0,
        )


def plain(value: Any) -> Any:
    """Settings as JSON has them, to be compared with those of an earlier run."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {one.name: plain(getattr(value, one.name)) for one in dataclasses.fields(value)}
    if isinstance(value, Mapping):
        return {str(key): plain(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [plain(one) for one in value]
    return value if value is None or isinstance(value, str | int | float | bool) else str(value)
