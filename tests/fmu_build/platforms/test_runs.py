"""The joystick FMUs on other platforms give the same results as here, run by a small importer in C."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from collections.abc import Callable
from functools import cache
from importlib import resources
from pathlib import Path

import fmpy
import numpy as np
import pytest

from fmu_build import FmiVersion
from fmu_build.packaging.binaries import compile_library
from fmu_build.packaging.platforms import PLATFORMS, Platform, host_platform
from pyjoystick.fmu import MODELS
from pyjoystick.model import NOMINAL, simulate

from .emulators import Runner, runner_for
from .libraries import library_in

pytestmark = [
    pytest.mark.xdist_group("platforms"),
    pytest.mark.skipif(host_platform() is None, reason="FMUs cannot be built for this machine"),
]

_IMPORTER = Path(__file__).with_name("importer")
_STRICT = ("-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1", "-ffp-contract=off")
# Of the FMUs' own flags those for which zig compiles the C library of a platform anew, which takes a minute
# for Windows.
_AS_FMUS = ("-mcpu=baseline", "-fomit-frame-pointer", "-s")
_HOST = host_platform() or PLATFORMS["x86_64-linux"]
_FOREIGN = [PLATFORMS[name] for name in ("aarch64-linux", "x86_64-windows") if PLATFORMS[name] != _HOST]
_TIME = np.linspace(0.0, 1.5, 301)
# The systems' tangents and powers differ in the last bit. What comes of it is a small share of the error of
# the integration: at the usual 1e-8 it is 4e-13 rad.
_TOLERANCE = 1e-10
_LIMITS = {"theta": 1e-12, "omega": 1e-12}
# Those that are steep functions of the motion, such as the springs' force and the damping near the middle.
_LIMIT_OF_OTHERS = 2e-11


@pytest.fixture(scope="session", params=_FOREIGN, ids=lambda platform: platform.name)
def foreign(request: pytest.FixtureRequest) -> Platform:
    """A platform that is not this machine's."""
    platform: Platform = request.param
    return platform


@pytest.fixture(scope="session")
def runner(foreign: Platform, tmp_path_factory: pytest.TempPathFactory) -> Runner:
    """What runs its programs."""
    found = runner_for(foreign, tmp_path_factory.mktemp(foreign.name))
    if isinstance(found, str):
        pytest.skip(found)
    return found


Importer = Callable[[Platform, FmiVersion, str], Path]


@pytest.fixture(scope="session")
def importer(tmp_path_factory: pytest.TempPathFactory) -> Importer:
    """The program for a platform, a version of FMI and an FMI type, compiled once."""

    @cache
    def compiled(platform: Platform, fmi_version: FmiVersion, fmi_type: str) -> Path:
        folder = tmp_path_factory.mktemp("importer")
        headers = str(resources.files("fmpy") / "c-code")
        command = [sys.executable, "-m", "ziglang", "cc", "-target", platform.target, *_STRICT, *_AS_FMUS]
        command += [f"-DFMI_VERSION={fmi_version[0]}", "-isystem", headers, "-o", "importer.exe"]
        sources = [str(_IMPORTER / file) for file in ("importer.c", f"{fmi_type}.c")]
        subprocess.run([*command, *sources], check=True, cwd=folder)
        return folder / "importer.exe"

    return compiled


def _inputs(name: str) -> dict[str, np.ndarray]:
    """A push of half a second that is let go, or a motion with both its derivatives."""
    if name.startswith("JoystickInverse"):
        turn = 4 * np.pi
        theta = 0.3 * np.sin(turn * _TIME)
        return {"theta": theta, "omega": 0.3 * turn * np.cos(turn * _TIME), "alpha": -(turn**2) * theta}
    return {"T": np.where((_TIME > 0.1) & (_TIME < 0.6), -2.0, 0.0)}


def _run(runner: Runner, program: Path, library: bytes, fmu: Path) -> dict[str, np.ndarray]:
    """The real outputs at every communication point."""
    description = fmpy.read_model_description(str(fmu))
    inputs = _inputs(fmu.stem)
    outputs = [
        v.name
        for v in description.modelVariables
        if v.causality == "output" and v.type in ("Real", "Float64")
    ]
    reference = {v.name: str(v.valueReference) for v in description.modelVariables}
    (program.parent / "library.dll").write_bytes(library)
    settings = [description.guid or description.instantiationToken, repr(_TOLERANCE), repr(float(_TIME[-1]))]
    settings += [str(description.numberOfContinuousStates), str(description.numberOfEventIndicators)]
    points = np.column_stack([_TIME, *inputs.values()])
    printed = runner.run(
        program,
        ["./library.dll", *settings, str(len(inputs)), *(reference[name] for name in [*inputs, *outputs])],
        "".join(" ".join(map(repr, row)) + "\n" for row in points.tolist()),
    )
    table = np.array([[float(value) for value in line.split()] for line in printed.splitlines()])
    np.testing.assert_array_equal(table[:, 0], _TIME)
    return dict(zip(outputs, table[:, 1:].T, strict=True))


def _check(here: dict[str, np.ndarray], there: dict[str, np.ndarray]) -> None:
    assert sum(np.ptp(values) > 0.0 for values in here.values()) >= 4  # it moves
    for name, values in here.items():
        limit = _LIMITS.get(name, _LIMIT_OF_OTHERS) * np.abs(values).max()
        assert np.abs(there[name] - values).max() <= limit, name


@pytest.mark.parametrize("fmi_type", ["co_simulation", "model_exchange"])
def test_the_fmu_for_all_platforms(
    fmi_type: str, fmu: Path, fmi_version: FmiVersion, foreign: Platform, runner: Runner, importer: Importer
) -> None:
    here, there = (
        _run(runs, importer(platform, fmi_version, fmi_type), library_in(fmu, platform, fmi_version), fmu)
        for runs, platform in ((Runner(), _HOST), (runner, foreign))
    )
    _check(here, there)
    torque = _inputs("Joystick")["T"]
    expected = simulate(
        NOMINAL,
        time=_TIME,
        theta_start=0.0,
        torque=lambda time: float(torque[np.searchsorted(_TIME, time, side="right") - 1]),
        torque_breakpoints=_TIME[1:][np.diff(torque) != 0.0],
    )
    np.testing.assert_allclose(there["theta"], expected.theta, rtol=0, atol=1e-9)


@pytest.mark.parametrize(
    "name", [name for name in MODELS if name.startswith("Joystick") and name != "Joystick"]
)
def test_the_other_joysticks_from_their_sources(
    name: str, joystick_fmus: Path, foreign: Platform, runner: Runner, importer: Importer
) -> None:
    fmu = joystick_fmus / f"{name}.fmu"
    with zipfile.ZipFile(fmu) as archive:
        sources = {n[8:]: archive.read(n) for n in archive.namelist() if n.startswith("sources/")}
    here = _run(Runner(), importer(_HOST, "2.0", "co_simulation"), library_in(fmu, _HOST, "2.0"), fmu)
    library, _log = compile_library(sources, name, foreign)
    _check(here, _run(runner, importer(foreign, "2.0", "co_simulation"), library, fmu))
