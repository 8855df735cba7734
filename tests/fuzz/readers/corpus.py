"""Valid files of every kind, written by the synthetic laboratory and the project itself."""

from __future__ import annotations

import contextlib
import io
import runpy
import shutil
from pathlib import Path
from typing import Final

import numpy as np
import pandas as pd
from scipy.io import savemat

from pyjoystick import Fmu
from pyjoystick.cli import main
from pyjoystick.runs import Sweep, operator_and_joystick, read_settings, run_sweep, write_ssp
from pyjoystick.runs.sweeps.parts import Parts
from pyjoystick.runs.sweeps.runner import run_locally
from tests.pyjoystick.fmu import awkward, echo

ROOT: Final = Path(__file__).parents[3]
_MARKERS: Final = ("--top", "TOP", "--base", "BASE1", "BASE2", "--radius", "0.266")
_FIT: Final = """[fmu]
path = "Joystick.fmu"
parameters = "joystick.toml"

[free]
"damping.C" = { start = 0.045, lower = 0.0, upper = 1.0 }
theta_start = { per_record = true }
release_time = { per_record = true }
"""
_SWEEP: Final = """[fmu]
path = "Joystick.fmu"

[experiment]
duration = 0.2
output_interval = 0.001

[parameters]
J = 0.012

[sampling]
method = "saltelli"
count = 4
seed = 7

[vary."damping.C"]
distribution = "uniform"
low = 0.03
high = 0.06

[vary.theta_start]
distribution = "normal"
mean = "-20deg"
deviation = "1deg"

[[results]]
kind = "peaks"
variable = "theta"
derivative = "omega"
count = 2

[[results]]
kind = "extremes"
variable = "omega"
"""


def make(folder: Path, fmus: Path) -> None:
    """Write the files.

    Args:
        folder: for the files; it is made
        fmus: with the FMUs of the project
    """
    laboratory = runpy.run_path(str(ROOT / "scenarios" / "data" / "make_synthetic_laboratory.py"))
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        laboratory["main"](folder)
        with contextlib.chdir(folder):
            _files(fmus)


def _files(fmus: Path) -> None:
    for name in ("Joystick", "Operator"):
        shutil.copy(fmus / f"{name}.fmu", ".")
    _thin(Path("synthetic_forward.csv"), 8)
    _thin(Path("synthetic_acceleration_1.csv"), 3)
    for arguments in (
        ("parameters", "--output", "joystick.toml"),
        (
            "import",
            "markers",
            "synthetic_trial_1.c3d",
            *_MARKERS,
            "-o",
            "trial_1.csv",
            "--motion",
            "motion.csv",
        ),
        ("import", "markers", "synthetic_trial_2.c3d", *_MARKERS, "-o", "trial_2.csv"),
    ):
        assert main(arguments) == 0, arguments
    np.save("acceleration.npy", np.loadtxt("synthetic_acceleration_1.csv", delimiter=",", skiprows=2)[:, 1])
    Path("fit.toml").write_text(_FIT, encoding="utf-8")
    Path("sweep.toml").write_text(_SWEEP, encoding="utf-8")
    Path("inputs.csv").write_text("time (s),T (N.m)\n0,0\n0.1,0.5\n0.2,0.1\n", encoding="utf-8")
    _driven(Path("driven.csv"), Path("push.csv"))
    assert main(("new", "project", "--example")) == 0
    _foreign()
    _plain_markers(Path("plain.csv"))
    _logs(Path("trial_1.csv"))
    system = operator_and_joystick(joystick={"J": 0.012})
    write_ssp(system, "joystick.ssp")
    sweep = Sweep(read_settings(Path("sweep.toml")))
    for suffix in (".csv", ".parquet"):
        run_sweep(sweep, Path(f"done{suffix}"))
    _half_done(Path("half.csv"), sweep)


def _thin(path: Path, every: int) -> None:
    """Leave every so many rows of a table, so that a case takes little time."""
    head, rows = (lines := path.read_text(encoding="utf-8").splitlines(keepends=True))[:2], lines[2:]
    path.write_text("".join(head + rows[::every]), encoding="utf-8")


def _driven(record: Path, push: Path) -> None:
    """A torque, and a short record of what it does, with the noise of a sensor."""
    time = np.linspace(0.0, 0.6, 121)
    torque = pd.DataFrame({"T": 2.5 * np.sin(2 * np.pi * time / 0.4)}, index=time)
    with Fmu("Joystick.fmu") as fmu:
        motion = fmu.run(time, parameters={"theta_start": 0.0}, inputs=torque, outputs=["theta"])
    noise = np.random.default_rng(5).normal(0.0, 0.02, len(time))
    table = pd.DataFrame(
        {
            "time (s)": time,
            "theta (deg)": np.degrees(motion["theta"].to_numpy()) + noise,
            "T (N.m)": torque["T"],
        }
    )
    table.round(5).to_csv(record, index=False)
    table[["time (s)", "T (N.m)"]].round(5).to_csv(push, index=False)


def _foreign() -> None:
    """FMUs of other makers, as far as anyone can tell: of FMI 3 with all of its types, and of FMI 2."""
    for name in ("echo", "awkward"):
        Path(name).mkdir()
    shutil.move(echo.build(3, Path("echo")), "Echo.fmu")
    awkward.build(2, Path("Awkward.fmu"), awkward.compile_library(2, Path("awkward")))


def _plain_markers(path: Path) -> None:
    """Markers as a table."""
    heading = ",".join(
        ["time (s)", *(f"{name} {axis} (mm)" for name in ("TOP", "BASE1", "BASE2") for axis in "xyz")]
    )
    lines = [heading]
    for line in Path("synthetic_trial_3.csv").read_text(encoding="utf-8").splitlines()[5:]:
        frame, _, *cells = line.split(",")
        lines.append(",".join([f"{int(frame) / 60.0:.6f}", *cells]))
    path.write_text("\n".join([*lines, ""]), encoding="utf-8")


def _logs(record: Path) -> None:
    """A record as the tables of other programs."""
    table = pd.read_csv(record, comment="#")
    table.to_csv("log.csv", sep=";", decimal=",", index=False)
    table.to_excel("log.xlsx", index=False)
    table.to_excel("log.ods", index=False, engine="odf")
    table.to_parquet("log.parquet", index=False)
    savemat("log.mat", {"log": {name.split()[0]: table[name].to_numpy() for name in table}})


def _half_done(target: Path, sweep: Sweep) -> None:
    """A sweep that was interrupted: its folder of parts."""
    parts = Parts(target)
    with parts.opened(sweep.identity):
        parts.save(next(run_locally(sweep, np.arange(5), 1, lambda _: None)))
        parts.save(next(run_locally(sweep, np.arange(8, 11), 1, lambda _: None)))
