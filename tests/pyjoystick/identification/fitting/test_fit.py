"""The fit as a whole: progress, Ctrl-C, several noise levels, counters."""

from __future__ import annotations

import dataclasses
import json
import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Fmu, Plan
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    RELEASE,
    Fit,
    FitInterruptedError,
    FitSettings,
    Free,
    Measurement,
    Noise,
    Uncertainty,
    as_json,
    fit,
    read_fit,
    report,
    summary,
)
from pyjoystick.model import NOMINAL
from pyjoystick.motion import RecordError, read_repeats
from pyjoystick.support import InputFileError, ParameterError
from tests.pyjoystick.identification.fitting.made import releases

NOISE = math.radians(0.1)
QUICK = dataclasses.replace(CONSTANT_DAMPING, uncertainty=Uncertainty(profiles=()))


@pytest.fixture
def with_bootstrap(fmus_by_name: Path) -> Fit:
    settings = dataclasses.replace(QUICK, uncertainty=Uncertainty(bootstrap=3))
    return fit(releases(NOMINAL, 2, noise=NOISE), settings)


def test_what_is_done_is_told(fmus_by_name: Path) -> None:
    told: list[tuple[str, int, int]] = []
    settings = dataclasses.replace(QUICK, uncertainty=Uncertainty(bootstrap=2))
    fit(releases(NOMINAL, noise=NOISE), settings, on_progress=lambda *news: told.append(news))
    assert list(dict.fromkeys(told)) == [
        ("searching", 0, 1),
        ("searching", 1, 1),
        ("estimating the noise", 0, 1),
        ("profiles", 0, 1),
        ("profiles", 1, 1),
        ("bootstrap", 1, 2),
        ("bootstrap", 2, 2),
    ]


def test_runs_are_counted(fmus_by_name: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    counted = 0
    run, batch = Plan.run, Plan.run_batch

    def counting(self: Plan, row: object) -> object:
        nonlocal counted
        counted += 1
        return run(self, row)  # type: ignore[arg-type]

    def counting_batch(self: Plan, rows: list[object], **options: object) -> object:
        nonlocal counted
        counted += len(rows)
        return batch(self, rows, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(Plan, "run", counting)
    monkeypatch.setattr(Plan, "run_batch", counting_batch)
    found = fit(releases(NOMINAL, 2, noise=NOISE), CONSTANT_DAMPING)
    assert found.runs == counted > 0


def test_ctrl_c_before_there_is_a_result(fmus_by_name: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def stopped(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Plan, "run", stopped)
    with pytest.raises(FitInterruptedError, match="stopped before it had a result"):
        fit(releases(NOMINAL), QUICK)


def test_ctrl_c_after_the_search_keeps_what_was_found(
    fmus_by_name: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = Plan.run
    stage = ""

    def stopped(self: Plan, row: object) -> object:
        if stage == "profiles":
            raise KeyboardInterrupt
        return run(self, row)  # type: ignore[arg-type]

    def tell(name: str, _done: int, _total: int) -> None:
        nonlocal stage
        stage = name

    monkeypatch.setattr(Plan, "run", stopped)
    found = fit(releases(NOMINAL, noise=NOISE), CONSTANT_DAMPING, on_progress=tell)
    assert found.interrupted
    assert not found.profiles
    assert found.value("damping.C") == pytest.approx(0.045, rel=0.01)
    assert "Stopped before it was complete." in summary(found)
    assert json.loads(as_json(found))["interrupted"] is True


def test_each_record_may_have_a_noise_of_its_own(fmus_by_name: Path) -> None:
    """The quieter record counts for more, so that the answer is better than with one level for both."""
    records = [releases(NOMINAL, 1, noise=NOISE)[0], releases(NOMINAL, 2, noise=5.0 * NOISE, seed=2)[1]]
    together, apart = (
        fit(records, dataclasses.replace(QUICK, noise=Noise(per_record=per_record)))
        for per_record in (False, True)
    )
    levels = [one.sigma["theta"] for one in apart.records]
    assert levels == pytest.approx([NOISE, 5.0 * NOISE], rel=0.2)
    assert together.records[0].sigma == together.records[1].sigma
    assert apart.error("damping.C") < 0.5 * together.error("damping.C")


def test_lost_samples_are_no_loss_of_the_fit(fmus_by_name: Path, tmp_path: Path) -> None:
    """A fifth of the frames, and one gap that hides a whole swing; C moves by no more than its error.

    The error grows with the root of the samples that are left.
    """
    random = np.random.default_rng(5)
    whole = releases(NOMINAL, 3, noise=NOISE)
    paths = []
    for one in whole:
        kept = random.random(len(one.time)) > 0.2
        kept &= (one.time < 0.6) | (one.time > 0.75)
        kept[:8] = True
        table = np.column_stack((one.time, one.theta))[kept]
        path = tmp_path / f"{one.name}.csv"
        np.savetxt(path, table, delimiter=",", header="time (s),theta (rad)", comments="")
        paths.append(path)
    with pytest.raises(RecordError, match="in which a peak may hide"):
        read_repeats(paths)
    found = fit(read_repeats(paths, counted=False), CONSTANT_DAMPING)
    assert found.trusted, [check for check in found.checks if not check.passed]
    before = fit(whole, CONSTANT_DAMPING)
    # Beyond four standard errors once in 16,000 fits; the seeds are fixed.
    assert abs(found.value("damping.C") - NOMINAL.to_names()["damping.C"]) < 4.0 * found.error("damping.C")
    assert before.error("damping.C") < found.error("damping.C") < 1.5 * before.error("damping.C")


@pytest.mark.parametrize(("since", "part"), [(1e6, 1e-4), (1.7e9, 0.02)])
def test_the_zero_of_the_clock_says_nothing(since: float, part: float, fmus_by_name: Path) -> None:
    """A clock that has run for twelve days or since 1970, and one that begins with the record.

    Times are rounded to 1e-10 and 2e-7 s, the release is known to 1e-4 s.
    """
    records = releases(NOMINAL, 2, noise=NOISE)
    late = [dataclasses.replace(one, time=one.time + since) for one in records]
    settings = dataclasses.replace(QUICK, free=(Free("J"), *QUICK.free))
    at_zero, later = fit(records, settings), fit(late, settings)
    assert later.trusted, [check for check in later.checks if not check.passed]
    for name in ("J", "damping.C", "release_time [run 1]"):
        error, moved = at_zero.error(name), since * name.startswith("release_time")
        assert later.value(name) - moved == pytest.approx(at_zero.value(name), abs=part * error)
        assert later.error(name) == pytest.approx(error, rel=part)
    assert later.identifiability.condition == pytest.approx(at_zero.identifiability.condition, rel=part)
    shown = next(line for line in report(later).splitlines() if "release_time [run 1]" in line)
    instant = later.value("release_time [run 1]")
    assert abs(float(shown.split("|")[3]) - instant) < 0.1 * later.error("release_time [run 1]")


def test_two_outputs_have_a_noise_each(fmus_by_name: Path) -> None:
    """The velocity is measured too, in its own unit."""
    (record,) = releases(NOMINAL, noise=NOISE)
    clean = releases(NOMINAL)[0]
    omega = np.gradient(clean.theta, clean.time)
    measured = Measurement("both", record.time, {"theta": record.theta, "omega": omega})
    settings = dataclasses.replace(QUICK, outputs=("theta", "omega"), free=(QUICK.free[0], RELEASE[0]))
    settings = dataclasses.replace(settings, fixed={"release_time": 0.1})
    sigma = fit([measured], settings).records[0].sigma
    assert sigma["theta"] == pytest.approx(NOISE, rel=0.25)
    # Differences over two frames round off the corners of the velocity.
    assert sigma["omega"] > 10.0 * sigma["theta"]


def test_a_column_drives_an_input(fmus_by_name: Path) -> None:
    time = np.linspace(0.0, 1.0, 41)
    with Fmu("Joystick") as joystick:
        drive = 0.5 * np.sin(9.0 * time)
        inputs = pd.DataFrame({"T": drive}, index=time)
        table = joystick.run(time, inputs=inputs, outputs=["theta"])
    measured = Measurement("driven", time, {"theta": table["theta"].to_numpy(), "T": drive})
    settings = FitSettings(
        fmu="Joystick", free=(Free("J", start=0.013),), inputs=("T",), uncertainty=Uncertainty(profiles=())
    )
    found = fit([measured], settings)
    assert found.value("J") == pytest.approx(NOMINAL.J, rel=1e-6)


def test_values_by_their_label(with_bootstrap: Fit) -> None:
    assert with_bootstrap.shared() == {"damping.C": with_bootstrap.value("damping.C")}
    low, high = with_bootstrap.interval("damping.C")
    assert (low, high) == with_bootstrap.profiles[0].interval
    low, high = with_bootstrap.interval("theta_start [run 0]")
    assert low < with_bootstrap.value("theta_start [run 0]") < high
    with pytest.raises(KeyError, match=r"'C' is not among damping\.C"):
        with_bootstrap.value("C")


def test_the_report_has_everything(with_bootstrap: Fit) -> None:
    text = report(with_bootstrap, "Two records")
    assert text.startswith("# Two records\n\nEvery check passed.\n")
    header = next(line for line in text.splitlines() if line.startswith("| parameter"))
    for column in (
        "unit",
        "value",
        "standard error",
        "95 % interval",
        "95 % by profile",
        "95 % by bootstrap",
    ):
        assert column in header
    for words in ("Standard deviation of the noise (estimated", "AICc ", "BIC ", "Bootstrap over records: 3"):
        assert words in text
    assert f"{with_bootstrap.runs} runs of the FMU in {with_bootstrap.seconds:.2f} s." in text


def test_the_report_says_how_far_a_profile_goes(with_bootstrap: Fit) -> None:
    one = with_bootstrap.profiles[0]
    column = report(with_bootstrap).split("95 % by profile")[0].splitlines()[-1].count("|")
    for profile, expected in (
        (dataclasses.replace(one, interval=(0.04, math.inf)), "0.04 to unbounded"),
        (dataclasses.replace(one, interval=(-math.inf, 0.05)), "unbounded to 0.05"),
        (dataclasses.replace(one, converged=False), "not followed"),
    ):
        text = report(dataclasses.replace(with_bootstrap, profiles={0: profile}))
        row, *others = (
            line for line in text.splitlines() if line.startswith(("| damping.C", "| theta_start"))
        )
        assert row.split("|")[column].strip() == expected
        assert all(line.split("|")[column].strip() == "" for line in others)


def test_a_profile_that_was_not_followed_is_no_interval(with_bootstrap: Fit, tmp_path: Path) -> None:
    lost = {
        place: dataclasses.replace(one, converged=False) for place, one in with_bootstrap.profiles.items()
    }
    file = tmp_path / "fit.json"
    for found, expected in (
        (with_bootstrap, with_bootstrap.profiles[0].interval),
        (dataclasses.replace(with_bootstrap, profiles=lost), with_bootstrap.intervals[0]),
    ):
        file.write_text(as_json(found), "utf-8")
        assert read_fit(file).values[0].interval == pytest.approx(tuple(expected))
    assert with_bootstrap.profiles[0].interval != pytest.approx(tuple(with_bootstrap.intervals[0]))


def test_json_has_every_number_and_no_nan(with_bootstrap: Fit) -> None:
    found = json.loads(as_json(with_bootstrap), parse_constant=lambda name: pytest.fail(name))
    damping = found["parameters"][0]
    assert damping["value"] == with_bootstrap.value("damping.C")
    assert len(damping["bootstrap_interval"]) == 2
    assert damping["bootstrap_error"] > 0.0
    assert damping["profile"]["at_bound"] == [False, False]
    assert damping["profile"]["followed"]
    assert len(found["records"][0]["data"]) == len(with_bootstrap.records[0].data)
    open_one = fit(
        releases(NOMINAL),
        dataclasses.replace(QUICK, free=(Free("m"), Free("h"), *QUICK.free)),
    )
    assert json.loads(as_json(open_one))["parameters"][0]["standard_error"] is None
    assert "not determined" in summary(open_one)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((pd.DataFrame({"theta": [0.1]}), QUICK), "an object of type DataFrame: must be a list of Records"),
        ((releases(NOMINAL)[0], QUICK), "records = an object of type Record: must be a list"),
        (([pd.DataFrame({"theta": [0.1]})], QUICK), "of type DataFrame among them: must be .* Measurement"),
        ((releases(NOMINAL), None), "settings = an object of type NoneType: must be FitSettings"),
    ],
)
def test_arguments_of_other_types_are_named(arguments: tuple[object, object], message: str) -> None:
    with pytest.raises(ParameterError, match=message):
        fit(*arguments)  # type: ignore[arg-type]


def test_an_fmu_by_name_is_not_an_open_one() -> None:
    with pytest.raises(ParameterError, match="fmu = Joystick: must be an open Fmu"):
        fit(releases(NOMINAL), QUICK, fmu="Joystick")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"standard_error": -1e-4}, "value, standard error and interval of damping.C contradict"),
        ({"standard_error": True}, "true is not a number"),
        ({"value": 1e30}, "value, standard error and interval of damping.C contradict"),
        ({"value": True}, "true is not a number"),
    ],
)
def test_a_fit_that_contradicts_itself_is_not_read(
    change: dict[str, object], message: str, with_bootstrap: Fit, tmp_path: Path
) -> None:
    content = json.loads(as_json(with_bootstrap))
    next(one for one in content["parameters"] if one["name"] == "damping.C").update(change)
    file = tmp_path / "fit.json"
    file.write_text(json.dumps(content), "utf-8")
    with pytest.raises(InputFileError, match=message):
        read_fit(file)
