"""The yardstick is correct and as accurate as stated; results and ratios are computed correctly."""

from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import replace
from itertools import cycle
from pathlib import Path

import numpy as np
import pytest

from benchmarks import batches
from benchmarks.batches import BatchRow, measure_batches
from benchmarks.build import UnpackedFmu, compile_programs, unpack
from benchmarks.c_programs import fmu_loop, hand_written
from benchmarks.contender import Contender, as_accurate
from benchmarks.equation_of_motion import right_hand_side
from benchmarks.errors import BenchmarkError
from benchmarks.measurement import Row, measure
from benchmarks.python_runs import compiled_run, fmpy_run, reference_run, scipy_run
from benchmarks.report import as_json, as_markdown
from benchmarks.task import INTERVALS, PARAMETERS, RELEASE, Law, reference_theta, sample_times
from pyjoystick.fmu import Fmu, Plan
from pyjoystick.model import simulate

LAW: Law = "constant"


@pytest.fixture(scope="module")
def programs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    return compile_programs(tmp_path_factory.mktemp("programs"))


@pytest.fixture(scope="module")
def fmu(joystick_fmus: Path, tmp_path_factory: pytest.TempPathFactory) -> UnpackedFmu:
    return unpack(joystick_fmus / "Joystick.fmu", tmp_path_factory.mktemp("fmu"))


@pytest.mark.parametrize("law", ["constant", "power-law"])
def test_yardstick_converges_to_reference(programs: dict[str, Path], law: Law, tmp_path: Path) -> None:
    coarse, fine, finest = (
        hand_written(programs["joystick"], law, tolerance, tmp_path).error()
        for tolerance in (1e-8, 1e-10, 1e-12)
    )
    assert finest < 1e-9
    assert finest < 0.05 * fine < 0.05**2 * coarse


def test_yardstick_samples_omega_and_alpha(programs: dict[str, Path], tmp_path: Path) -> None:
    samples = tmp_path / "samples.txt"
    command = [programs["joystick"], LAW, "1e-12", f"{RELEASE!r}", "1", "1", samples]
    result = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    theta, omega, alpha = np.loadtxt(samples).T
    assert (result["theta_final"], result["theta_max"]) == (theta[-1], theta.max())
    truth = simulate(PARAMETERS[LAW], time=sample_times(INTERVALS), theta_start=RELEASE)
    np.testing.assert_allclose(omega, truth.omega, rtol=0.0, atol=1e-7)
    # The steepest spring turns an error of 1e-10 rad into one of 1e-5 rad/s2.
    np.testing.assert_allclose(alpha, truth.alpha, rtol=0.0, atol=1e-4)


def test_bare_loop_and_fmpy_give_same_result(
    programs: dict[str, Path], fmu: UnpackedFmu, joystick_fmus: Path, tmp_path: Path
) -> None:
    loop = fmu_loop(programs["fmu_loop"], fmu, LAW, 1e-8, tmp_path)
    fmpy = fmpy_run(fmu, LAW, "CoSimulation", 1e-8)
    np.testing.assert_allclose(loop.theta(RELEASE), fmpy.theta(RELEASE), rtol=0.0, atol=1e-12)
    assert loop.error() < 1e-7
    with Fmu(joystick_fmus / "Joystick.fmu") as opened:
        compiled = compiled_run(opened, LAW, 1e-8)
        np.testing.assert_allclose(compiled.theta(RELEASE), fmpy.theta(RELEASE), rtol=0.0, atol=1e-12)
        assert compiled.seconds() > 0.0
    assert loop.evaluations is not None
    assert loop.evaluations > 1000


def test_timed_runs_must_repeat_checked_ones(tmp_path: Path) -> None:
    program = tmp_path / "program"
    # Its last theta is the number of batches: 1 where it is checked, more where it is timed.
    program.write_text(
        f"""#!{sys.executable}
import json, sys
batches = int(sys.argv[4])
open(sys.argv[-1], "w").write(f"0 0 0\\n{{batches}} 0 0\\n")
print(json.dumps(dict(seconds=1.0, theta_final=batches, theta_max=batches, evaluations=0)))
"""
    )
    program.chmod(0o755)
    contender = hand_written(program, LAW, 1e-8, tmp_path)
    with pytest.raises(BenchmarkError, match="other results than the checked ones"):
        contender.seconds()


def test_library_that_does_not_load(programs: dict[str, Path], fmu: UnpackedFmu, tmp_path: Path) -> None:
    broken = tmp_path / "broken.so"
    broken.write_bytes(b"no library")
    damaged = replace(fmu, counting_library=broken)
    with pytest.raises(BenchmarkError, match="fmu_loop failed"):
        fmu_loop(programs["fmu_loop"], damaged, LAW, 1e-8, tmp_path)


def test_reference_row_counts_evaluations() -> None:
    row = reference_run(LAW)
    assert row.evaluations is not None
    assert 12 * 500 < row.evaluations < 100_000
    assert row.error() < 1e-10


@pytest.mark.parametrize("law", ["constant", "power-law"])
def test_equation_for_scipy_is_that_of_the_reference(law: Law) -> None:
    truth = simulate(PARAMETERS[law], time=sample_times(INTERVALS), theta_start=RELEASE)
    derivatives = [
        right_hand_side(PARAMETERS[law])(0.0, state) for state in np.column_stack([truth.theta, truth.omega])
    ]
    np.testing.assert_allclose(derivatives, np.column_stack([truth.omega, truth.alpha]), rtol=1e-9, atol=1e-9)


def test_scipy_row_converges_and_counts_evaluations() -> None:
    coarse, fine = scipy_run(LAW, 1e-7), scipy_run(LAW, 1e-10)
    assert fine.error() < 0.1 * coarse.error() < 1e-4
    assert fine.evaluations is not None
    assert fine.evaluations > 1000


def test_batches(joystick_fmus: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name, runs in (("RUNS", 30), ("FEW_RUNS", 20), ("MANY_RUNS", 40)):
        monkeypatch.setattr(batches, name, runs)
    rounds: list[int] = []
    rows = measure_batches(joystick_fmus / "Joystick.fmu", 2, lambda: rounds.append(1))
    assert len(rounds) == 2
    assert [(row.runs, row.threads) for row in rows] == [(30, 1), (30, 2), (20, 2), (40, 2)]
    assert all(row.rate > 0.0 for row in rows)
    assert rows[1].speedup is not None
    assert rows[3].memory is None or rows[3].memory < 100.0


def test_a_failing_batch_stops_the_benchmark(joystick_fmus: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refusing(fmu: Fmu) -> Plan:
        names = ("theta_start", "forward.balanceSpring.x_0")
        return fmu.plan([0.0, 0.1], varied=names, outputs=("theta", "omega", "alpha"))

    monkeypatch.setattr(batches, "prepared", refusing)
    monkeypatch.setattr(batches, "random_joysticks", lambda runs: np.zeros((runs, 2)))
    with pytest.raises(BenchmarkError, match="a run of the batch failed: "):
        measure_batches(joystick_fmus / "Joystick.fmu", 2, lambda: None)


def _fake(tolerance: float, seconds: list[float]) -> Contender:
    times = cycle(seconds)
    return Contender(
        name=f"fake {tolerance}",
        law=LAW,
        tolerance=tolerance,
        theta=lambda release: reference_theta(LAW, release) + 10.0 * tolerance,
        seconds=lambda: next(times),
        evaluations=None,
    )


def test_loosest_tolerance_that_is_accurate_enough() -> None:
    found = as_accurate(lambda tolerance: _fake(tolerance, [1.0]), 1e-9, 1e-7, 10.0)
    assert found.tolerance == pytest.approx(1e-11)


def test_unreachable_accuracy_is_not_claimed() -> None:
    found = as_accurate(lambda tolerance: _fake(tolerance, [1.0]), 0.0, 1e-7, 10.0)
    assert found.error() > 0.0


def test_ratios_are_taken_within_a_round() -> None:
    rounds = []
    contenders = [
        _fake(1e-9, [1.0, 10.0, 2.0]),
        _fake(2e-9, [3.0, 30.0, 6.0]),
        _fake(1e-9, [6.0, 60.0, 12.0]),
    ]
    rows = measure(contenders, 3, lambda: rounds.append(1))
    assert len(rounds) == 3
    assert [row.ratio for row in rows] == [1.0, 3.0, 6.0]
    assert [row.ratio_to_second for row in rows] == [1.0 / 3.0, 1.0, 2.0]
    assert [row.ratio_to_third for row in rows] == [1.0 / 6.0, 0.5, 1.0]
    assert rows[1].ratio_spread == (3.0, 3.0)
    assert rows[1].milliseconds == 6000.0
    assert rows[1].error == pytest.approx(2e-8, rel=1e-6)


ROW = Row("a run", 1e-8, 0.25, 2.0, (1.9, 2.1), 0.5, 0.4, 3e-9, None)
BATCH = BatchRow(1000, 2, 1800.4, 1.9, (1.85, 1.95))


def test_table() -> None:
    lines = as_markdown({LAW: [ROW]}, [BATCH, BatchRow(10, 2, 1700.0, memory=0.31)]).splitlines()
    assert lines[0] == "## Damping law: constant"
    assert lines[4] == "| a run | 1.0e-08 | 0.25 | 3.0e-09 |  | 2 (1.9 to 2.1) | 0.5 | 0.4 |"
    assert lines[-2:] == ["| 1000 | 2 | 1800 | 1.9 (1.85 to 1.95) |  |", "| 10 | 2 | 1700 |  | 0.31 |"]


def test_json() -> None:
    document = json.loads(as_json({LAW: [ROW]}, [BATCH]))
    assert document["laws"][LAW][0]["ratio"] == 2.0
    assert document["laws"][LAW][0]["evaluations"] is None
    assert document["batches"][0]["speedup"] == 1.9


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "usage:"),
        (["linear", "1e-8", "0.1", "1", "1"], "usage:"),
        (["constant", "1e-8x", "0.1", "1", "1"], 'TOLERANCE: "1e-8x" is not a finite number'),
        (["constant", "1e-8", "nan", "1", "1"], 'THETA_START: "nan" is not a finite number'),
        (["constant", "1e-8", "0.1", "0", "1"], 'BATCHES: "0" is not a whole number of at least 1'),
        (["constant", "1e-8", "0.1", "1", "-1"], 'RUNS: "-1" is not a whole number'),
        (["constant", "1e-8", "0.1", "1", "1", "/missing/file"], "cannot write /missing/file"),
    ],
)
def test_program_refuses_bad_arguments(programs: dict[str, Path], arguments: list[str], message: str) -> None:
    done = subprocess.run([programs["joystick"], *arguments], capture_output=True, text=True, check=False)
    assert done.returncode != 0
    assert message in done.stderr


def test_missing_fmu(tmp_path: Path) -> None:
    with pytest.raises(BenchmarkError, match="`make fmu` builds it"):
        unpack(tmp_path / "missing.fmu", tmp_path)


def test_file_that_is_no_fmu(tmp_path: Path) -> None:
    file = tmp_path / "text.fmu"
    file.write_text("text")
    with pytest.raises(BenchmarkError, match="not an FMU that can be read"):
        unpack(file, tmp_path)
