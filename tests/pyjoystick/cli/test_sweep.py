"""``pyjoystick sweep``."""

from __future__ import annotations

from pathlib import Path

import pandas as pd
import pytest

from pyjoystick import runs
from pyjoystick.runs import Outcome, read_sweep
from tests.pyjoystick.cli.conftest import Command

GRID = """
title = "Two by two"
[fmu]
path = "Joystick"
[experiment]
duration = 0.2
[sampling]
method = "grid"
[vary."damping.C"]
values = [0.03, 0.06]
[vary.theta_start]
values = ["-20deg", "-10deg"]
[[results]]
kind = "peaks"
variable = "theta"
count = 4
[[results]]
kind = "loss"
variable = "E"
"""
SALTELLI = GRID.replace('"grid"', '"saltelli"\ncount = 16').replace('kind = "peaks"', 'kind = "final"')
SALTELLI = SALTELLI.replace("count = 4\n", "").replace(
    "values = [0.03, 0.06]", 'distribution = "uniform"\nlow = 0.03\nhigh = 0.06'
)


@pytest.fixture
def settings(tmp_path: Path) -> Path:
    path = tmp_path / "two.toml"
    path.write_text(GRID)
    return path


def _files(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.parametrize(
    ("interval", "count", "warned"),
    [(0.05, 4, True), (0.01, 4, False), (0.1, 1, True), (0.2, 5, True), (0.5, 2, True), (0.01, 1, False)],
)
def test_peaks_between_few_samples_are_warned_of(
    interval: float, count: int, warned: bool, command: Command, settings: Path
) -> None:
    longer = GRID.replace("duration = 0.2", f"duration = 1.0\noutput_interval = {interval}")
    settings.write_text(longer.replace("count = 4", f'derivative = "omega"\ncount = {count}'))
    outcome = command("sweep", "two.toml")
    assert outcome.code == 0
    assert ("peaks of theta come less than five samples after one another" in outcome.err) == warned


def test_results_go_beside_the_settings(command: Command, settings: Path, tmp_path: Path) -> None:
    outcome = command("sweep", "two.toml")
    assert outcome.code == 0
    assert outcome.out == "Two by two: 4 of 4 runs of Joystick.fmu done\n"
    assert outcome.err == "wrote two.csv\n"
    assert _files(tmp_path) == ["two.csv", "two.toml"]
    table = read_sweep(tmp_path / "two.csv")
    assert table.shape == (4, 2 + 8 + 1 + 2)
    again = command("sweep", "two.toml")
    assert (again.code, again.err) == (0, "two.csv was already complete; nothing was run\n")


def test_figures_and_another_format(command: Command, settings: Path, tmp_path: Path) -> None:
    outcome = command(
        *("sweep", "two.toml", "-o", "out/a.parquet", "--threads", "1"),
        *("--plot", "out/a.png", "--plot", "out/a.svg", "--scatter", "out/b.pdf"),
    )
    assert outcome.code == 0
    notes = outcome.err.splitlines()
    assert notes[1].startswith(
        "a figure has room for 6 results; left out: theta.peak4, theta.peak4_time, E.loss"
    )
    assert [note for note in notes if note.startswith("wrote")] == [
        *("wrote out/a.parquet", "wrote out/a.png", "wrote out/a.svg", "wrote out/b.pdf"),
    ]
    assert _files(tmp_path / "out") == ["a.parquet", "a.png", "a.svg", "b.pdf"]


def test_sobol_indices_are_printed_and_drawn(command: Command, settings: Path, tmp_path: Path) -> None:
    settings.write_text(SALTELLI)
    outcome = command("sweep", "two.toml", "--indices", "i.csv", "--plot", "i.png", "--result", "E.loss")
    assert outcome.code == 0
    lines = outcome.out.splitlines()
    assert lines[0] == "Two by two: 64 of 64 runs of Joystick.fmu done"
    assert [line.split()[0] for line in lines[3:]] == ["E.loss", "damping.C", "theta_start"]
    table = pd.read_csv(tmp_path / "i.csv")
    assert table["result"].tolist() == ["E.loss"] * 2
    assert table["total"].iloc[1] > 0.5 > table["total"].iloc[0] > 0.0
    assert (tmp_path / "i.png").read_bytes().startswith(b"\x89PNG")


FAILING = """
[fmu]
path = "{fmu}"
[experiment]
duration = 2
output_interval = 0.5
[sampling]
method = "grid"
[vary.last]
values = {last}
[[results]]
kind = "final"
variable = "y"
"""


def test_failed_runs_are_listed(command: Command, settings: Path, mixed_path: Path, tmp_path: Path) -> None:
    settings.write_text(FAILING.format(fmu=mixed_path, last=[0.1 * i for i in range(7)]))
    outcome = command("sweep", "two.toml")
    assert outcome.code == 1
    lines = outcome.out.splitlines()
    assert lines[0] == "7 of 7 runs of Mixed.fmu done, 7 failed"
    assert lines[1].startswith("  run 0: Mixed.fmu at t = 0 s: ")
    assert lines[-1] == "  and 2 more; all are in the column `message`"
    assert len(lines) == 7
    assert read_sweep(tmp_path / "two.csv")["failed"].all()


def test_some_failed_runs_are_no_failure(
    command: Command, settings: Path, mixed_path: Path, tmp_path: Path
) -> None:
    settings.write_text(FAILING.format(fmu=mixed_path, last=[0.7, 5.0]))
    outcome = command("sweep", "two.toml", "--plot", "a.png")
    assert outcome.code == 0
    assert "2 of 2 runs of Mixed.fmu done, 1 failed" in outcome.out
    assert "past the last moment 100 % of #1" in outcome.out
    assert read_sweep(tmp_path / "two.csv")["failed"].tolist() == [True, False]


def test_an_interruption_says_how_to_go_on(
    command: Command, settings: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    stopped = Outcome(Path("two.csv"), None, 3, 1, {2: "broke"}, interrupted=True, found=0)
    monkeypatch.setattr(runs, "run_sweep", lambda *arguments, **options: stopped)
    outcome = command("sweep", "two.toml")
    assert outcome.code == 130
    assert outcome.out == "Two by two: 3 of 4 runs of Joystick.fmu done, 1 failed\n  run 2: broke\n"
    assert outcome.err == "interrupted; finished runs are kept, and the same command continues from here\n"
    outcome = command("sweep", "two.toml", "--overwrite")
    assert "and the command without --overwrite continues from here" in outcome.err


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (("--indices", "i.csv"), "--indices requires the sampling method saltelli; this sweep has grid"),
        (("--result", "E.losses"), "there is no variable 'E.losses'; did you mean E.loss?"),
        (("--plot", "a.gif"), "cannot write a.gif: the name must end in .png, .pdf, .svg"),
        (
            ("--plot", "a.png", "--scatter", "a.png"),
            "cannot write a.png: another result is written there too",
        ),
        (("-o", "a.xlsx"), "cannot write a.xlsx: the name must end in .parquet or .csv"),
        (("--scheduler", "tcp://127.0.0.1:9"), "Dask scheduler tcp://127.0.0.1:9: cannot be reached"),
    ],
)
def test_wrong_input_is_one_message_and_writes_nothing(
    command: Command, settings: Path, tmp_path: Path, arguments: tuple[str, ...], message: str
) -> None:
    outcome = command("sweep", "two.toml", *arguments)
    assert (outcome.code, outcome.out) == (1, "")
    assert message in outcome.message
    assert [name for name in _files(tmp_path) if not name.endswith(".parts")] == ["two.toml"]


def test_a_mistake_in_the_settings_is_one_message(command: Command, settings: Path) -> None:
    settings.write_text(GRID.replace("damping.C", "damping.c"))
    outcome = command("sweep", "two.toml")
    assert outcome.code == 1
    assert outcome.message.startswith('two.toml: [vary."damping.c"]: there is no parameter')


@pytest.mark.parametrize("folder", ["/", "", "."])
def test_a_folder_is_no_settings_file(command: Command, folder: str) -> None:
    outcome = command("sweep", folder)
    assert outcome.code == 1
    assert "cannot be read: Is a directory" in outcome.message


def test_threads_and_a_scheduler_are_one_too_many(command: Command, settings: Path) -> None:
    outcome = command("sweep", "two.toml", "--threads", "2", "--scheduler", "tcp://127.0.0.1:9")
    assert outcome.code == 2
    assert "use --threads or --scheduler, not both" in outcome.err
