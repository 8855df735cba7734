"""Contents of the live page for a joystick."""

from __future__ import annotations

import math
import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from pyjoystick import model
from pyjoystick.identification import guess_release
from pyjoystick.motion import Record

if TYPE_CHECKING:
    from fmu_build.explore import Settings

_ASSETS: Final = Path(__file__).with_name("assets")
#: Largest number of samples of all records together, at 18 bytes each: the page stays below 250 kB.
_MOST_SAMPLES: Final = 800
#: A number that no file contains.
_MARK: Final = -12345.5
#: Handle length to draw if the parameter file has none, in proportion to the paper's joystick.
_TOP_TO_CENTER: Final = model.PIVOT_TO_TOP / model.NOMINAL.h
_STOP: Final = model.STOP_ANGLE
#: Ranges of sliders (SI units), if a fifth to five times the start value is not useful.
_RANGES: Final = {
    "theta_start": (-_STOP, _STOP),
    "omega_start": (-10.0, 10.0),
    "T": (-3.0, 3.0),
    "damping.C": (0.0, 0.2),
    "damping.alpha": (0.0, 1.0),
    "friction.T_c": (0.0, 0.3),
    "friction.T_s": (0.0, 0.3),
    "friction.F_c": (0.0, 5.0),
    "friction.omega_s": (0.0, 2.0),
    "theta_ref": (-_STOP, _STOP),
    "omega_ref": (-10.0, 10.0),
    "grip": (0.0, 1.0),
    "hand.K": (0.0, 100.0),
    "hand.D": (0.0, 3.0),
}
#: The same for parameters of the FMU with stops.
_MOUNTED_RANGES: Final = {
    "stops.theta_stop": (0.0, 1.5 * _STOP),
    "stops.K": (100.0, 5000.0),
    "stops.D": (0.0, 5.0),
    "a_base": (-20.0, 20.0),
    "a_base_z": (-20.0, 20.0),
    "alpha_base": (-50.0, 50.0),
}
_FIRST: Final = ("theta_start", "damping.C", "damping.alpha", "friction.T_c", "friction.F_c", "T")
_SPRINGS: Final = tuple(f"{side}.{kind}Spring" for side in model.SIDES for kind in ("return", "balance"))


def joystick_page(
    fmu: Path,
    file: model.ParameterFile,
    joystick: model.JoystickParameters,
    start: float,
    *,
    records: Sequence[Record] = (),
    title: str = "",
) -> str:
    """Make the page of a joystick as HTML.

    Args:
        fmu: the FMU named by `held_fmu`, of FMI 2
        file: the parameter file, which the page can save with modified values
        joystick: initial values of the page
        start: release angle (rad)
        records: measured free oscillations, drawn over the simulated ones
        title: heading; by default that of the file

    Raises:
        BuildError: the FMU cannot be used, see `fmu_build.explore.explore_page`
    """
    from fmu_build.explore import Addition, explore_page  # slow to load

    places = _places(file, joystick)
    data = {
        "top": file.pivot_to_top or _TOP_TO_CENTER * joystick.h,
        "stop": _STOP,
        "toml": _editable_text(file, joystick, places),
        "places": places,
        "records": [_record(record, max(_MOST_SAMPLES // len(records), 1)) for record in records],
    }
    settings = page_settings(joystick, start, title or file.title)
    return explore_page(fmu, settings, Addition(_ASSETS, "joystick", data))


def held_fmu(joystick: model.JoystickParameters) -> str:
    """Name of the FMU for a joystick in a hand, with its damping law and stops."""
    name = "MountedJoystick" if joystick.stops else "HeldJoystick"
    return name + ("" if isinstance(joystick.damping, model.ConstantDamping) else "PowerLaw")


def page_settings(joystick: model.JoystickParameters, start: float, title: str) -> Settings:
    """Settings of the page for a joystick released at an angle (rad)."""
    from fmu_build.explore import Preset, Settings
    from fmu_build.explore.ranges import Range
    from fmu_build.explore.settings import PlotChoice

    values = joystick.to_names()
    ranges = _RANGES | (_MOUNTED_RANGES if joystick.stops else {})
    absent = {name for name in _RANGES if name.startswith("damping.") and name not in values}
    hidden = absent | {name for name in model.FRICTION_NAMES if name not in values}
    half = {f"{spring}.F_0": 0.5 * values[f"{spring}.F_0"] for spring in _SPRINGS}
    presets = [
        Preset("20° release", {"theta_start": -_STOP}),
        Preset("5° release", {"theta_start": -math.radians(5.0)}),
        Preset("Half the preload", half),
        Preset("No preload", dict.fromkeys(half, 0.0)),
    ]
    if "damping.C" in values:
        presets.append(Preset("Undamped", {"damping.C": 0.0}))
    more = [name for name, part in (("M_f", joystick.friction), ("M_stop", joystick.stops)) if part]
    moments = ("M_s", "M_d", "M_g", *more, "T", "T_hand")
    return Settings(
        title=title,
        first=tuple(name for name in _FIRST if name not in hidden),
        ranges={name: Range(*ends) for name, ends in ranges.items() if name not in absent},
        values={**values, "theta_start": start},
        input_tables=False,
        plots=(
            PlotChoice(("theta",)),
            PlotChoice(("omega",), "theta"),
            PlotChoice(("f_x",), "x"),
            PlotChoice(("M_s",), "theta"),
            PlotChoice(("E",)),
            PlotChoice(moments),
        ),
        presets=tuple(presets),
    )


def _places(file: model.ParameterFile, joystick: model.JoystickParameters) -> Mapping[str, str]:
    """FMU names by place in the parameter file, for values that are stored unconverted."""
    values = model.fmu_values(file, model.law_name(joystick.damping))
    places = {f"{value.table}.{value.place}": value.name for value in values if value.place.isidentifier()}
    # The page has friction for every joystick.
    return places | {name: name for name in model.FRICTION_NAMES}


def _editable_text(
    file: model.ParameterFile, joystick: model.JoystickParameters, places: Mapping[str, str]
) -> str:
    """The file with the joystick's values, in a form that the page can edit line by line.

    If the TOML file is in another form (indented keys, inline tables, multi-line lists), the page gets
    the values as this package writes them, without its comments.
    """
    text = model.updated_text(file, joystick)
    wanted = [*places, *(f"{side}.{key}" for side in model.SIDES for key in ("x", "k"))]
    if _is_editable(text, wanted):
        return text
    return model.updated_text(model.PAPER, joystick, title=file.title)


def _is_editable(text: str, places: Sequence[str]) -> bool:
    """Whether assets/toml.js would change these values, and nothing else."""
    table, lines, changed = "", [], set()
    for line in text.split("\n"):
        head = re.match(r"\[([^\]]+)\]", line)
        table = head[1] if head else table
        key = re.match(r"(\w+)(\s*=\s*)", line, re.ASCII)
        if key and f"{table}.{key[1]}" in places:
            changed.add(f"{table}.{key[1]}")
            line = f"{key[0]}{_MARK}"
        lines.append(line)
    try:
        found, before = tomllib.loads("\n".join(lines)), tomllib.loads(text)
    except tomllib.TOMLDecodeError:
        return False
    return all(_value(found, one) == _MARK for one in places if _value(before, one) is not None) and all(
        _value(before, one) is not None for one in changed
    )


def _value(content: Any, place: str) -> Any:
    for key in place.split("."):
        content = content.get(key) if isinstance(content, dict) else None
    return content


def _record(record: Record, most: int) -> dict[str, Any]:
    """Time and angle from the release, which may be late; thinned to at most `most` samples."""
    release = guess_release(record.time, record.theta)
    late = record.time >= release.time
    every = math.ceil(int(late.sum()) / most)
    return {
        "name": record.name,
        "start": round(release.angle, 7),
        "time": [round(float(time - release.time), 6) for time in record.time[late][::every]],
        "theta": [round(float(angle), 6) for angle in record.theta[late][::every]],
    }
