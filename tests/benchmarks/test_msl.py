"""The comparison with MSL reference results, and its table, tested with synthetic results."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from typer.testing import CliRunner

from benchmarks.msl import __main__ as command
from benchmarks.msl.comparison import Reference, largest_error, read_reference
from benchmarks.msl.example import try_example

_MODEL = """model Decay
  Real x(start = 2, fixed = true);
  discrete Real step(start = 0, fixed = true);
equation
  der(x) = -x;
  when time > 0.5 then
    step = 1;
  end when;
end Decay;
"""


def _reference(folder: Path, scale: float = 1.0) -> Path:
    """Write the closed form as a reference result, with the event at 0.5 s in two rows."""
    folder.mkdir(parents=True)
    time = np.sort([*np.linspace(0, 1, 21), 0.5])
    step = np.arange(22) > 10
    rows = [f"{t},{2 * scale * np.exp(-t)},{float(s)}" for t, s in zip(time, step, strict=True)]
    (folder / f"{folder.name}.csv").write_text("\n".join(['"time","x","step"', *rows]) + "\n")
    (folder / "comparisonSignals.txt").write_text("time\nx\nstep\nmissing\n")
    return folder


def test_a_reference_result_as_published(tmp_path: Path) -> None:
    reference = read_reference(_reference(tmp_path / "Decay"))
    assert reference.signals == ("x", "step")
    assert reference.values.shape == (22, 2)
    assert len(reference.instants) == 21


@pytest.mark.parametrize(
    ("values", "error"),
    [
        ([0, 1, 1, 3], 0.0),  # before the jump
        ([0, 1, 3, 3], 0.0),  # after it
        ([0, 1, 4, 3], 1 / 3),
        ([0, 1, 2, 2.4], 0.2),
        ([0, 1, 1, np.nan], np.inf),
    ],
)
def test_a_jump_may_lie_on_either_side(values: list[float], error: float) -> None:
    reference = Reference(np.array([0.0, 1, 2, 2, 3]), np.array([[0.0], [1], [1], [3], [3]]), ("x",))
    found, name = largest_error(reference, pd.DataFrame({"x": values}, index=reference.instants))
    assert found == pytest.approx(error, abs=1e-5)
    assert name == "x"


@pytest.mark.parametrize(("off", "right"), [(1e-11, True), (1e-8, False)])
def test_a_constant_signal_is_compared_with_its_size(off: float, right: bool) -> None:
    reference = Reference(np.array([0.0, 1]), np.zeros((2, 1)), ("x",))
    error, _ = largest_error(reference, pd.DataFrame({"x": [0.0, off]}))
    assert (error <= 1e-4) is right


@pytest.mark.parametrize(("scale", "verdict"), [(1.0, "right"), (1.0003, "near"), (1.01, "differs")])
def test_verdicts(tmp_path: Path, scale: float, verdict: str) -> None:
    (tmp_path / "Decay.mo").write_text(_MODEL)
    reference = _reference(tmp_path / "reference" / "Decay", scale)
    assert try_example("Decay", tmp_path / "Decay.mo", reference).verdict == verdict


def test_the_command_prints_every_outcome(tmp_path: Path) -> None:
    """In processes of their own: a refused example, one whose reference is damaged; without paths."""
    library = tmp_path / "Modelica"
    library.mkdir()
    (library / "package.mo").write_text("package Modelica\nend Modelica;\n")
    reference = tmp_path / "reference"
    _reference(reference / "Blocks" / "Examples" / "Refused")
    damaged = _reference(reference / "Blocks" / "Examples" / "Damaged")
    (damaged / "Damaged.csv").write_text("nothing\n")
    (_reference(reference / "Blocks" / "Examples" / "Without") / "Without.csv").unlink()
    done = CliRunner().invoke(
        command.app, ["--library", str(library), "--reference", str(reference)], catch_exceptions=False
    )
    assert done.exit_code == 0
    assert "| Blocks.Examples.Damaged | crash | exit code 1: ValueError" in done.stdout
    assert "| Blocks.Examples.Refused | refused | there is no model" in done.stdout
    assert "Without" not in done.stdout
    assert str(tmp_path) not in done.stdout
    assert done.stdout.startswith("1 crash, 1 refused\n") or done.stdout.startswith("1 refused, 1 crash\n")


def test_an_example_that_takes_too_long(tmp_path: Path) -> None:
    outcome = command._in_a_process("M", tmp_path, tmp_path, 0.01)
    assert (outcome.verdict, outcome.detail) == ("too long", "more than 0.01 s")
