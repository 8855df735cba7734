"""Speed of reading laboratory files: markers, compared with other readers, and a long accelerometer record.

    python -m benchmarks.imports

Markers: 60 s of 20 markers at 240 Hz are read, and the angle is computed and filtered as in `pyjoystick
import markers`; reading alone is compared with ezc3d, c3d and pandas, alternately. Accelerometer: ten million
samples at 1800 Hz in one file, of which 4 s are kept; each method runs in a separate process, and its memory
is the peak minus that before reading.
"""

from __future__ import annotations

import math
import multiprocessing
import statistics
import tempfile
import time
import warnings
from collections.abc import Callable, Mapping
from functools import partial
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Annotated, Final

import c3d
import ezc3d
import numpy as np
import pandas as pd
import typer

from benchmarks.memory import memory_of_process, reset_peak
from benchmarks.report import machine
from pyjoystick.laboratory import (
    BASE,
    TOP,
    Chain,
    measure_angle,
    read_accelerometer,
    read_markers,
    synthetic_markers,
)
from pyjoystick.support import FloatArray, TextTable

RATE: Final = 240.0
DURATION: Final = 60.0
MARKERS: Final = 20
SAMPLING: Final = 1800.0
#: The part of the accelerometer's record that is kept (s).
WINDOW: Final = (10.0, 14.0)


def main(
    rounds: Annotated[int, typer.Option(min=1, help="How often each file is read.")] = 5,
    samples: Annotated[int, typer.Option(min=1_000_000, help="Of the accelerometer.")] = 10_000_000,
) -> None:
    """Time the imports; print Markdown."""
    with tempfile.TemporaryDirectory(prefix="benchmarks-") as folder:
        typer.echo(f"{machine()}\n\n{markers_table(Path(folder), rounds)}\n")
        typer.echo(accelerometer_table(Path(folder), samples))


def markers_table(folder: Path, rounds: int) -> str:
    """The three kinds of files with markers."""
    names, time_, positions = _markers()
    files = _marker_files(folder, names, time_, positions)
    libraries: Mapping[str, Mapping[str, Callable[[Path], object]]] = {
        "C3D": {"ezc3d": _by_ezc3d, "c3d": _by_c3d},
        "Nexus CSV": {"pandas": partial(_by_pandas, skip=4)},
        "plain CSV": {"pandas": _by_pandas},
    }
    rows = []
    for kind, file in files.items():
        ways: dict[str, Callable[[Path], object]] = {"import": _import, "reading": read_markers}
        ways.update(libraries[kind])
        times = _in_turns({name: partial(way, file) for name, way in ways.items()}, rounds)
        own = times["reading"]
        ratios = [f"{name} {_ratio(times[name], own):.2g}" for name in libraries[kind]]
        medians = [f"{statistics.median(times[name]):.3f}" for name in ("import", "reading")]
        rows.append([kind, f"{file.stat().st_size / 1e6:.1f}", *medians, ", ".join(ratios)])
    header = [
        "60 s, 240 Hz, 20 markers",
        "MB",
        "import (s)",
        "its reading (s)",
        "other readers, times as long",
    ]
    return TextTable(header, rows).markdown()


def accelerometer_table(folder: Path, samples: int) -> str:
    """A long record as .npy and CSV, read in pieces and by libraries in one go."""
    npy, text = folder / "long.npy", folder / "long.csv"
    values = np.sin(np.arange(samples) / 50.0).astype(np.float32)
    np.save(npy, values)
    with text.open("w", encoding="utf-8") as file:
        file.write("time (s),acceleration (m/s2)\n")
        for first in range(0, samples, 500_000):
            rows = np.arange(first, min(first + 500_000, samples))
            piece = pd.DataFrame({"time": rows / SAMPLING, "value": values[rows]})
            piece.to_csv(file, header=False, index=False, float_format="%.9g")
    ways: Mapping[str, tuple[Path, Callable[[], object]]] = {
        ".npy, pyjoystick": (
            npy,
            partial(read_accelerometer, npy, window=WINDOW, unit="m/s2", rate=SAMPLING),
        ),
        ".npy, NumPy": (npy, partial(np.load, npy)),
        "CSV, pyjoystick": (text, partial(read_accelerometer, text, window=WINDOW)),
        "CSV, pandas": (text, partial(_by_pandas, text)),
    }
    rows_ = []
    for name, (path, way) in ways.items():
        seconds, memory = _alone(way)
        size = path.stat().st_size / 1e6
        rows_.append(
            [name, f"{size:.0f}", f"{seconds:.2f}", f"{samples / seconds / 1e6:.1f}", f"{memory:.0f}"]
        )
    header = [f"{samples / 1e6:g} million samples", "MB", "seconds", "million samples/s", "more memory (MiB)"]
    return TextTable(header, rows_).markdown()


def _markers() -> tuple[list[str], FloatArray, FloatArray]:
    """Return names, time (s) and positions (m): a release every 4 s, and additional markers."""
    time_ = np.arange(round(DURATION * RATE)) / RATE
    within = time_ % 4.0
    theta = -0.3 * np.exp(-2.2 * within) * np.cos(4.0 * np.pi * within)
    random = np.random.default_rng(1)
    seen = synthetic_markers(time_, theta, random=random)
    others = random.normal(0.0, 0.3, (len(time_), MARKERS - len(seen.names), 3))
    names = [*seen.names, *(f"M{i}" for i in range(others.shape[1]))]
    return names, time_, np.concatenate((seen.positions, others), axis=1)


def _marker_files(
    folder: Path, names: list[str], time_: FloatArray, positions: FloatArray
) -> dict[str, Path]:
    millimetres = 1e3 * positions
    file = ezc3d.c3d()
    point = file["parameters"]["POINT"]
    point["RATE"]["value"], point["UNITS"]["value"], point["LABELS"]["value"] = [RATE], ["mm"], names
    places = np.ones((4, *millimetres.shape[1::-1]))
    places[:3] = millimetres.transpose(2, 1, 0)
    file["data"]["points"] = places
    paths = {"C3D": folder / "a.c3d", "Nexus CSV": folder / "nexus.csv", "plain CSV": folder / "plain.csv"}
    file.write(str(paths["C3D"]))
    flat = pd.DataFrame(millimetres.reshape(len(time_), -1))
    head = ["Trajectories", f"{RATE:g}", "," + "".join(f",Joystick:{name},," for name in names)]
    head += ["Frame,Sub Frame" + ",X,Y,Z" * len(names), "," + ",mm" * flat.shape[1], ""]
    frames = flat.copy()
    frames.insert(0, "frame", np.arange(1, len(time_) + 1))
    frames.insert(1, "sub", 0)
    body = frames.to_csv(header=False, index=False, float_format="%.6g")
    paths["Nexus CSV"].write_text("\n".join(head) + body, encoding="utf-8")
    flat.columns = pd.Index([f"{name} {axis} (mm)" for name in names for axis in "xyz"])
    flat.insert(0, "time (s)", time_)
    flat.to_csv(paths["plain CSV"], index=False, float_format="%.9g")
    return paths


def _import(path: Path) -> None:
    found = measure_angle(read_markers(path), top=TOP, base=BASE, forward="x")
    Chain().run(found.time, found.theta)


def _by_ezc3d(path: Path) -> object:
    return ezc3d.c3d(str(path))["data"]["points"]


def _by_c3d(path: Path) -> object:
    with path.open("rb") as file, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of parameters that it misses
        return np.array([points.copy() for _, points, _ in c3d.Reader(file).read_frames()])


def _by_pandas(path: Path, skip: int = 0) -> object:
    return pd.read_csv(path, skiprows=skip)


def _in_turns(ways: Mapping[str, Callable[[], object]], rounds: int) -> dict[str, list[float]]:
    """Return the seconds of each method per round; all run in every round, after a warm-up round."""
    times: dict[str, list[float]] = {name: [] for name in ways}
    for count in range(rounds + 1):
        for name, way in ways.items():
            begun = time.perf_counter()
            way()
            if count:
                times[name].append(time.perf_counter() - begun)
    return times


def _ratio(times: list[float], others: list[float]) -> float:
    """Return the median over the rounds of the ratio of times."""
    return statistics.median(a / b for a, b in zip(times, others, strict=True))


def _alone(way: Callable[[], object]) -> tuple[float, float]:
    """Return seconds and additional memory (MiB) of a call in a separate process."""
    context = multiprocessing.get_context("spawn")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_measured, args=(way, sender))
    process.start()
    seconds, memory = receiver.recv()
    process.join()
    return float(seconds), float(memory)


def _measured(way: Callable[[], object], sender: Connection) -> None:
    before = memory_of_process("VmRSS")
    reset_peak()
    begun = time.perf_counter()
    way()
    seconds = time.perf_counter() - begun
    after = memory_of_process("VmHWM")
    sender.send((seconds, math.nan if before is None or after is None else after - before))


if __name__ == "__main__":
    typer.run(main)
