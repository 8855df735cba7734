"""The settings file: its contents, and the messages for mistakes in it."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Extremes, FmuNotFoundError, Loss, Peaks
from pyjoystick.motion import RecordError
from pyjoystick.runs import Sampling, Settings, Sweep, read_settings
from pyjoystick.runs.sweeps.variations import Levels, LogNormal, LogUniform, Normal, Uniform
from pyjoystick.support import InputFileError, PyJoystickError, SettingsError
from tests.pyjoystick.fmu.doctored import doctored
from tests.pyjoystick.runs.sweeps.conftest import SMALL, Write

SAMPLED = SMALL.replace('method = "grid"', 'method = "random"\ncount = 3')


def test_what_the_file_says_is_what_comes_out(small: Settings) -> None:
    assert small.fmu.path.name == "Joystick.fmu"
    np.testing.assert_allclose(small.time, np.arange(301) * 1e-3, rtol=1e-12)
    assert small.tolerance == 1e-8
    assert small.sampling == Sampling("grid")
    assert small.varied["damping.C"] == Levels((0.03, 0.045, 0.06))
    angles = small.varied["theta_start"]
    assert isinstance(angles, Levels)
    np.testing.assert_allclose(angles.values, np.radians([-20.0, -15.0, -10.0, -5.0]), rtol=1e-14)
    assert small.results == (Peaks("theta", 2, "omega"), Loss("E"))


def test_what_is_left_out_is_what_the_fmu_proposes(written: Write) -> None:
    text = SMALL.replace("duration = 0.3\noutput_interval = 0.001\n", "start = 1\n")
    settings = read_settings(written(text))
    assert (settings.time[0], settings.time[-1], len(settings.time)) == (1.0, 1.5, 501)
    assert settings.tolerance == settings.fmu.experiment.tolerance


@pytest.mark.parametrize(
    ("table", "variation"),
    [
        ("from = 1e-3\nto = 1e-1\ncount = 3\nspacing = 'log'", Levels((1e-3, 1e-2, 1e-1))),
        ("distribution = 'uniform'\nlow = 0.03\nhigh = 0.06", Uniform(0.03, 0.06)),
        ("distribution = 'loguniform'\nlow = 0.03\nhigh = 0.06", LogUniform(0.03, 0.06)),
        ("distribution = 'normal'\nmean = 0.05\ndeviation = 0.01", Normal(0.05, 0.01, 0.0)),
        (
            "distribution = 'normal'\nmean = 0.05\ndeviation = 0.01\nlow = 0.04\nhigh = 0.07",
            Normal(0.05, 0.01, 0.04, 0.07),
        ),
        ("distribution = 'lognormal'\nmedian = 0.05\nlog_deviation = 0.2", LogNormal(0.05, 0.2)),
    ],
)
def test_every_variation(written: Write, table: str, variation: object) -> None:
    text = SAMPLED.replace("values = [0.03, 0.045, 0.06]", table)
    found = read_settings(written(text)).varied["damping.C"]
    assert type(found) is type(variation)
    if isinstance(variation, Levels) and isinstance(found, Levels):
        np.testing.assert_allclose(found.values, variation.values, rtol=1e-14)
    else:
        assert found == variation


def test_parameters_and_inputs(written: Write, tmp_path: Path) -> None:
    settings = read_settings(written(SMALL + '[parameters]\nomega_start = "90 deg/s"\n[inputs]\nT = 0.25\n'))
    assert settings.parameters == {"omega_start": pytest.approx(math.pi / 2.0, rel=1e-15)}
    assert settings.inputs == {"T": 0.25}
    (tmp_path / "torque.csv").write_text("time (s),T (N.m)\n0,0\n1,2\n")
    text = SMALL.replace("[experiment]", '[experiment]\ninput_file = "torque.csv"')
    table = read_settings(written(text)).inputs
    assert isinstance(table, pd.DataFrame)
    assert table["T"].to_dict() == {0: 0, 1: 2}


@pytest.mark.parametrize("name", ["run", "failed", "message", "y.final"])
def test_a_parameter_with_the_name_of_another_column(
    name: str, written: Write, mixed_path: Path, tmp_path: Path
) -> None:
    fmu = doctored(
        mixed_path, tmp_path / "m.fmu", description=lambda text: text.replace('name="gain"', f'name="{name}"')
    )
    text = f"""
        [fmu]
        path = "{{fmu}}"
        [sampling]
        method = "grid"
        [vary."{name}"]
        values = [0.5, 1.0]
        [[results]]
        kind = "final"
        variable = "y"
    """
    with pytest.raises(
        SettingsError, match=rf"\[vary\] {name} = .* the name of another column of the results"
    ):
        read_settings(written(text, fmu=fmu))


def test_types_other_than_real(written: Write, mixed_path: Path) -> None:
    text = """
        [fmu]
        path = "{mixed}"
        [experiment]
        duration = 1
        output_interval = 0.1
        [sampling]
        method = "grid"
        [vary.n]
        values = [2, 4]
        [vary.inverted]
        values = [true, false]
        [[results]]
        kind = "extremes"
        variable = "steps"
    """
    settings = read_settings(written(text, mixed=mixed_path))
    assert settings.varied == {"n": Levels((2, 4)), "inverted": Levels((True, False))}
    assert settings.results == (Extremes("steps"),)
    with pytest.raises(SettingsError, match=r"\[vary.n\]: must have values = \[...\], .* type Integer"):
        read_settings(
            written(text.replace("values = [2, 4]", "from = 2\nto = 4\ncount = 3"), mixed=mixed_path)
        )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[fmu]", "[fmus]", "[]fmu: is missing"),
        ("[fmu]", "[fmu", "is not TOML: "),
        ("[experiment]", "[experiments]", "[]experiments: is not a known key (did you mean experiment?)"),
        ("duration", "durations", "[experiment] durations: is not a known key (did you mean duration?)"),
        ("duration = 0.3", "duration = 0", "[experiment] duration = 0: must be a finite number above 0 s"),
        ("duration = 0.3", "duration = '1 s'", '[experiment] duration = "1 s": must be a finite number'),
        ("= 0.001", "= 1.0", "[experiment] output_interval = 1.0: must be at most the duration, 0.3 s"),
        ("[experiment]", "[experiment]\ntolerance = 1", "tolerance = 1: must be a number from 1e-13 to 0.01"),
        ('"grid"', '"gird"', '[sampling] method = "gird": must be one of grid, random, latin-hypercube'),
        ('"grid"', '"gird"', "(did you mean grid?)"),
        ('"grid"', '"grid"\ncount = 5', "[sampling] count: is not a known key"),
        ('"grid"', '"random"', "[sampling] count: is missing"),
        ('"grid"', '"random"\ncount = 0', "[sampling] count = 0: must be a whole number, 1 or more"),
        ('"grid"', '"random"\ncount = true', "[sampling] count = true: must be a whole number, 1 or more"),
        (
            '"grid"',
            '"random"\ncount = 1e12',
            "[sampling] count = 1000000000000.0: must be a whole number, 1 or more",
        ),
        ('"grid"', '"sobol"\ncount = 12', "[sampling] count = 12: must be a power of two"),
        (
            '"grid"',
            '"random"\ncount = 1000000000000',
            "[sampling] = 1000000000000: must be 10000000 at most",
        ),
        (
            "count = 4",
            "count = 1000000000000",
            "[vary.theta_start] count = 1000000000000: must be 10000000 at",
        ),
        ("count = 2", "count = 1000000000000", "[results 1] count = 1000000000000: must be 10000 at most"),
        ("damping.C", "damping.D", "did you mean damping.C?"),
        ("theta_start", "omega", "[vary.omega]: is not a parameter or start value that can be varied"),
        (
            "0.045,",
            "-1,",
            '[vary."damping.C"] values = [0.03, -1, 0.06]: must be a finite number, 0 N.m.s/rad',
        ),
        ("0.045,", "0.03,", "must not repeat a value"),
        (
            "[0.03, 0.045, 0.06]",
            "[]",
            '[vary."damping.C"] values = []: must be a list with one entry or more',
        ),
        ("values", "value", '[vary."damping.C"]: must have values = [...], or from, to and count, or dist'),
        ('"-5deg"', '"-5 grad"', '[vary.theta_start] to = "-5 grad": must be a number in rad, or text'),
        ('"-5deg"', '"-100deg"', "[vary.theta_start] to = "),
        ('"-5deg"', '"-20deg"', "must differ from `from`"),
        ("count = 4", "count = 1", "[vary.theta_start] count = 1: must be a whole number, 2 or more"),
        ("count = 4", "count = 4\nspacing = 'log'\nlow = 1", "[vary.theta_start] low: is not a known key"),
        (
            'kind = "loss"',
            'kind = "lost"',
            '[results 2] kind = "lost": must be one of peaks, final, extremes',
        ),
        ('variable = "E"', 'variable = "e"', "[results 2] variable: there is no variable 'e'"),
        ('variable = "E"', "", "[results 2] variable: is missing"),
        ('variable = "E"', 'variable = "E"\ncount = 3', "[results 2] count: is not a known key"),
        ('"loss"\nvariable = "E"', '"peaks"\nvariable = "theta"', "has a result of this kind already"),
        ("[experiment]", "[parameters]\nq = 1\n[experiment]", "[parameters] q: there is no parameter 'q'"),
        (
            "[experiment]",
            "[parameters]\nJ = -1\n[experiment]",
            "[parameters] J = -1: must be a finite number",
        ),
        (
            "[experiment]",
            '[parameters]\n"damping.C" = 1\n[experiment]',
            "[vary] damping.C: is in [parameters] too; must be in one",
        ),
        ("[experiment]", "[inputs]\nS = 1\n[experiment]", "[inputs] S: there is no input 'S'"),
        ("values = [0.03, 0.045, 0.06]", "distribution = 'normal'", '[vary."damping.C"] mean: is missing'),
        (
            "values = [0.03, 0.045, 0.06]",
            "distribution = 'lognormal'\nmedian = 0.05\nlog_deviation = 999",
            "log_deviation = 999: must be above 0 and at most 10, a factor of 2.2e+04",
        ),
        (
            "values = [0.03, 0.045, 0.06]",
            "distribution = 'uniform'\nlow = 0.05\nhigh = 0.03",
            "high = 0.03: must be above low, 0.05 N.m.s/rad",
        ),
        (
            "values = [0.03, 0.045, 0.06]",
            "distribution = 'uniform'\nlow = 0.03\nhigh = 0.05",
            "must be levels",
        ),
        (
            "values = [0.03, 0.045, 0.06]",
            "distribution = 'normal'\nmean = 1\ndeviation = 0",
            "deviation = 0: must be a finite number above 0 N.m.s/rad",
        ),
        (
            "values = [0.03, 0.045, 0.06]",
            "distribution = 'normal'\nmean = 1\ndeviation = 1\nhigh = 0.5",
            "mean = 1: must lie from 0 to 0.5 N.m.s/rad",
        ),
    ],
)
def test_mistakes_are_named_with_their_place(written: Write, old: str, new: str, message: str) -> None:
    path = written(SMALL.replace(old, new, 1))
    with pytest.raises(SettingsError) as refused:
        read_settings(path)
    assert str(refused.value).startswith(f"{path}: ")
    assert message.removeprefix("[]") in str(refused.value)


def test_an_input_file_with_mistakes(written: Write, tmp_path: Path) -> None:
    path = written(SMALL.replace("[experiment]", '[experiment]\ninput_file = "torque.csv"'))
    with pytest.raises(RecordError, match=r"torque.csv: cannot be read: No such file"):
        read_settings(path)
    (tmp_path / "torque.csv").write_text("time,S\n0,0\n1,1\n")
    with pytest.raises(SettingsError, match=r'input_file = "torque.csv": there is no input .S.'):
        read_settings(path)
    (tmp_path / "torque.csv").write_text("time,T\n1,0\n0,1\n")
    with pytest.raises(RecordError, match=r"torque.csv, column 'time', row 3: the time runs backward"):
        read_settings(path)


def test_the_fmu_is_looked_for_beside_the_settings(written: Write, tmp_path: Path) -> None:
    path = written(SMALL.replace("{fmus}/Joystick.fmu", "nowhere.fmu"))
    with pytest.raises(FmuNotFoundError) as missing:
        read_settings(path)
    assert missing.value.fmu == str(tmp_path / "nowhere.fmu")


def test_the_documented_file_is_one(tmp_path: Path, fmus_by_name: Path) -> None:
    page = Path(__file__).parents[4] / "docs" / "sweeps.md"
    blocks = re.findall(r"```toml\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    assert len(blocks) == 1
    path = tmp_path / "documented.toml"
    path.write_text(blocks[0], encoding="utf-8")
    assert len(Sweep(read_settings(path)).design) == 1000


def test_a_file_that_cannot_be_read(tmp_path: Path) -> None:
    with pytest.raises(InputFileError, match="cannot be read"):
        read_settings(tmp_path / "none.toml")
    (tmp_path / "latin.toml").write_bytes(b"title = '\xe9'")
    with pytest.raises(InputFileError, match="is not text in UTF-8"):
        read_settings(tmp_path / "latin.toml")


def test_errors_are_errors_of_pyjoystick() -> None:
    error = SettingsError(Path("a.toml"), "fmu", "path", math.inf, "must be text", "why")
    assert isinstance(error, PyJoystickError)
    assert str(error) == "a.toml: [fmu] path = Infinity: must be text (why)"
