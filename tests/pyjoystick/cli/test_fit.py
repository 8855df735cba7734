"""``pyjoystick fit``."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.identification import FitInterruptedError
from pyjoystick.model import NOMINAL, PAPER, ConstantDamping, read_parameter_file, simulate, write_parameters
from tests.pyjoystick.cli.conftest import Command
from tests.pyjoystick.fmu.doctored import doctored

DATA = Path(__file__).parents[3] / "scenarios" / "data"
RECORDS = sorted(str(path) for path in DATA.glob("synthetic_constant_*.csv"))

SETTINGS = """
[fmu]
path = "Joystick"

[free]
"damping.C" = { start = 0.06, minimum = 0.0, maximum = 0.5 }
theta_start = { per_record = true }
release_time = { per_record = true }

[noise]
sigma = { theta = "0.1deg" }

[search]
starts = 3

[uncertainty]
profiles = []
bootstrap = 4
resampling = "residuals"
"""


@pytest.mark.usefixtures("fmus_by_name")
def test_report_and_files(command: Command, tmp_path: Path) -> None:
    outcome = command("fit", *RECORDS[:2], "--output", str(tmp_path / "out"))
    assert outcome.code == 0, outcome.err
    assert "runs of the FMU in" in outcome.out
    found = json.loads((tmp_path / "out" / "fit.json").read_text(encoding="utf-8"))
    assert "numpy" in found["made_with"]
    damping = found["parameters"][0]
    assert damping["name"] == "damping.C"
    low, high = damping["profile"]["interval"]
    assert low < damping["value"] < high
    assert damping["value"] == pytest.approx(0.045, rel=0.01)
    written = {path.name for path in (tmp_path / "out").iterdir()}
    assert written == {
        "fit.md", "fit.json", "records.png", "residuals.png", "correlation.png", "profiles.png"
    }  # fmt: skip


def test_an_fmu_whose_angle_is_in_degrees(command: Command, fmus_by_name: Path, tmp_path: Path) -> None:
    def in_degrees(text: str) -> str:
        return re.sub(r'(name="theta"[^>]*>\s*<Real[^>]*) unit="rad"', r'\1 unit="deg"', text)

    doctored(fmus_by_name / "Joystick.fmu", tmp_path / "deg.fmu", description=in_degrees)
    (tmp_path / "fit.toml").write_text(SETTINGS.replace('"Joystick"', '"deg.fmu"'), encoding="utf-8")
    told = command("fit", RECORDS[0], "--settings", "fit.toml").message
    assert told.endswith("deg.fmu: declares theta in deg; that of a joystick is in rad")


@pytest.mark.usefixtures("fmus_by_name")
def test_a_driven_record(command: Command, tmp_path: Path) -> None:
    outcome = command("fit", str(DATA / "synthetic_driven_1.csv"), "--driven", "-o", str(tmp_path / "out"))
    assert outcome.code == 0, outcome.out
    found = json.loads((tmp_path / "out" / "fit.json").read_text(encoding="utf-8"))
    values = {one["name"]: one["value"] for one in found["parameters"]}
    truth = json.loads((DATA / "synthetic_driven_truth.json").read_text(encoding="utf-8"))
    # Some standard errors: the record knows all three better than this.
    assert values["damping.C"] == pytest.approx(truth["parameters"]["damping.C"], rel=2e-3)
    assert values["J"] == pytest.approx(truth["parameters"]["J"], rel=2e-3)
    assert values["delay"] == pytest.approx(truth["delay"], abs=1e-4)


@pytest.mark.usefixtures("fmus_by_name")
def test_a_torque_that_no_joystick_withstands(command: Command, tmp_path: Path) -> None:
    """Its runs would take minutes, and no fit of them means anything."""
    text = (DATA / "synthetic_driven_1.csv").read_text(encoding="utf-8")
    file = tmp_path / "damaged.csv"
    file.write_text("\n".join([*text.splitlines()[:-1], "9.0,0.0,1000", ""]), encoding="utf-8")
    outcome = command("fit", str(file), "--driven")
    assert outcome.code == 1
    assert "column 'T': reaches 1000 N.m; a joystick takes up to 200 N.m" in outcome.message


@pytest.mark.parametrize("option", ["--driven", "--friction"])
def test_settings_say_themselves_what_options_choose(command: Command, tmp_path: Path, option: str) -> None:
    outcome = command("fit", RECORDS[0], "--settings", str(tmp_path / "fit.toml"), option)
    assert outcome.code == 2
    assert option in outcome.err


@pytest.mark.usefixtures("fmus_by_name")
def test_settings_from_a_file(command: Command, tmp_path: Path) -> None:
    path = tmp_path / "fit.toml"
    path.write_text(SETTINGS, encoding="utf-8")
    outcome = command("fit", RECORDS[0], "--settings", str(path))
    assert outcome.code == 0, outcome.err
    assert "3 searches ended in" in outcome.out
    assert "Bootstrap over residuals: 4 fits" in outcome.out


@pytest.mark.usefixtures("fmus_by_name")
def test_doubtful_fit(command: Command) -> None:
    """A constant coefficient on motion made with the power law."""
    outcome = command("fit", str(DATA / "synthetic_power_law_1.csv"))
    assert outcome.code == 3
    assert "NOT TO BE TRUSTED: whiteness" in outcome.out
    assert "do not trust this fit: it failed whiteness" in outcome.err


@pytest.mark.usefixtures("fmus_by_name")
@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('"damping.C" = {', '"damping.c" = {', "damping.c"),
        ("maximum = 0.5", "maximum = -1.0", "damping.C"),
        ('sigma = { theta = "0.1deg" }', "sigma = { omega = 0.1 }", "omega"),
        ('resampling = "residuals"', 'resampling = "days"', "'records' or 'residuals'"),
        ("starts = 3", "start = 3", "did you mean starts?"),
        ('path = "Joystick"', 'path = "Joystik.fmu"', "Joystik.fmu"),
    ],
)
def test_settings_that_are_refused(
    command: Command, tmp_path: Path, old: str, new: str, message: str
) -> None:
    path = tmp_path / "fit.toml"
    path.write_text(SETTINGS.replace(old, new), encoding="utf-8")
    outcome = command("fit", RECORDS[0], "--settings", str(path))
    assert outcome.code == 1
    assert message in outcome.err
    assert "Traceback" not in outcome.err


def test_settings_and_damping_exclude_each_other(command: Command, tmp_path: Path) -> None:
    outcome = command("fit", RECORDS[0], "--settings", str(tmp_path / "x.toml"), "--damping", "constant")
    assert outcome.code == 2


@pytest.fixture
def joystick(tmp_path: Path) -> Path:
    """A parameter file with another mass than the paper's, as measured somewhere, and a comment."""
    text = PAPER.path.read_text(encoding="utf-8").replace("m = 0.87 ", "m = 0.871 # weighed:")
    assert "weighed" in text
    path = tmp_path / "joystick.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_result_goes_into_the_parameter_file(command: Command, joystick: Path) -> None:
    outcome = command("fit", *RECORDS[:2], "--parameters", str(joystick), "--update")
    assert outcome.code == 0, outcome.err
    assert outcome.err.splitlines()[-1] == f"wrote [damping.constant] of {joystick}"
    found = read_parameter_file(joystick)
    assert isinstance(found.joystick.damping, ConstantDamping)
    error = found.uncertainties["damping.constant.C"]
    assert 1e-5 < error < 1e-4
    assert abs(found.joystick.damping.C - 0.045) < 5.0 * error
    assert found.sources["damping.constant"] == "fit to synthetic_constant_1.csv, synthetic_constant_2.csv"
    assert found.joystick.m == 0.871
    assert "# weighed" in joystick.read_text(encoding="utf-8")


def test_a_new_file_begins_as_the_paper_s(command: Command, tmp_path: Path) -> None:
    path = tmp_path / "new.toml"
    outcome = command("fit", RECORDS[0], "--parameters", str(path), "--update")
    assert outcome.code == 0, outcome.err
    assert "is new: all other values are the paper's" in outcome.err
    assert read_parameter_file(path).joystick.J == PAPER.joystick.J


def test_a_doubtful_fit_leaves_the_file_alone_unless_told(command: Command, joystick: Path) -> None:
    before = joystick.read_bytes()
    arguments = ("fit", str(DATA / "synthetic_power_law_1.csv"), "--parameters", str(joystick), "--update")
    outcome = command(*arguments)
    assert outcome.code == 3
    assert "joystick.toml is unchanged; --even-if-doubtful saves" in outcome.err
    assert joystick.read_bytes() == before
    outcome = command(*arguments, "--even-if-doubtful")
    assert outcome.code == 3
    source = read_parameter_file(joystick).sources["damping.constant"]
    assert source == "fit to synthetic_power_law_1.csv; doubtful: whiteness, missing physics"


def test_wrong_usage_of_update(command: Command, joystick: Path, tmp_path: Path) -> None:
    assert command("fit", RECORDS[0], "--update").code == 2
    assert command("fit", RECORDS[0], "--parameters", str(joystick), "--even-if-doubtful").code == 2
    settings = tmp_path / "fit.toml"
    release = SETTINGS.replace('"damping.C" = { start = 0.06, minimum = 0.0, maximum = 0.5 }', "")
    settings.write_text(release, encoding="utf-8")
    outcome = command("fit", RECORDS[0], "-p", str(joystick), "--settings", str(settings), "--update")
    assert outcome.code == 1
    assert outcome.message == "the joystick: none of its parameters is fitted, so there is nothing to save"


def test_a_folder_that_cannot_be_is_found_out_before_the_fit(command: Command, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("kept", encoding="utf-8")
    outcome = command("fit", RECORDS[0], "--output", "file")
    assert (outcome.code, outcome.out) == (1, "")
    assert outcome.message.startswith("cannot write file/fit.md: ")


def test_a_figure_of_an_earlier_fit_is_named(command: Command, tmp_path: Path) -> None:
    (tmp_path / "fit.toml").write_text(SETTINGS.replace("bootstrap = 4", ""), encoding="utf-8")
    (tmp_path / "profiles.png").write_text("kept", encoding="utf-8")
    outcome = command("fit", RECORDS[0], "--settings", "fit.toml", "--output", str(tmp_path))
    assert outcome.code == 0, outcome.err
    assert "profiles.png belongs to an earlier fit" in outcome.err
    assert (tmp_path / "profiles.png").read_text(encoding="utf-8") == "kept"


@pytest.mark.parametrize("stage", ["searching", "profiles"])
def test_ctrl_c(
    command: Command, joystick: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, stage: str
) -> None:
    """Without a result it ends; after the search what was found is printed, but no joystick is written."""

    def stopped(*_: object, **__: object) -> None:
        raise KeyboardInterrupt if stage == "searching" else FitInterruptedError

    place = {
        "searching": "pyjoystick.fmu.Plan.run",
        "profiles": "pyjoystick.identification.fitting.solution.profile.search",
    }
    monkeypatch.setattr(place[stage], stopped)
    before = joystick.read_bytes()
    outcome = command("fit", RECORDS[0], "-p", str(joystick), "--update", "--output", "out")
    assert outcome.code == 130, outcome.err
    assert joystick.read_bytes() == before
    if stage == "searching":
        assert (outcome.out, outcome.message) == ("", "the fit was stopped before it had a result")
    else:
        assert "Stopped before it was complete." in outcome.out
        assert "joystick.toml is unchanged" in outcome.err
        assert (tmp_path / "out" / "fit.json").exists()


@pytest.mark.usefixtures("fmus_by_name")
def test_releases_from_both_sides(command: Command, tmp_path: Path) -> None:
    """Two sides where they are meant; a sign that is wrong does not get through either."""
    time = np.arange(91) / 60.0
    random = np.random.default_rng(1)
    files = []
    for degrees in (-20.0, 12.0):
        theta = simulate(NOMINAL, time=time, theta_start=np.radians(degrees)).theta
        files.append(tmp_path / f"{degrees:g}.csv")
        noisy = np.degrees(theta) + random.normal(0.0, 0.1, len(time))
        lines = [f"{t!r},{one!r}" for t, one in zip(time.tolist(), noisy.tolist(), strict=True)]
        files[-1].write_text("\n".join(["time (s),theta (deg)", *lines]))
    assert "--both-sides" in command("fit", *map(str, files)).message
    outcome = command("fit", *map(str, files), "--both-sides")
    assert outcome.code == 0, outcome.err
    assert float(outcome.out.split("| damping.C")[1].split("|")[2]) == pytest.approx(0.045, rel=0.02)
    text = files[1].read_text().splitlines()
    turned = [line.replace(",", ",-").replace("--", "") for line in text[1:]]
    files[1].write_text("\n".join([text[0], *turned]))
    refused = command("fit", *map(str, files), "--both-sides")
    assert refused.code == 3
    assert "do not trust this fit" in refused.err


@pytest.mark.usefixtures("fmus_by_name")
def test_dry_friction_is_fitted_saved_and_then_known(command: Command, tmp_path: Path) -> None:
    joystick = tmp_path / "joystick.toml"
    truth = NOMINAL.replace({"friction.T_c": 0.02})
    time, random, files = np.arange(121) / 60.0, np.random.default_rng(2), []
    for degrees in (-20.0, -8.0):
        theta = simulate(truth, time=time, theta_start=np.radians(degrees)).theta
        files.append(tmp_path / f"{degrees:g}.csv")
        noisy = np.degrees(theta) + random.normal(0.0, 0.05, len(time))
        lines = [f"{t!r},{one!r}" for t, one in zip(time.tolist(), noisy.tolist(), strict=True)]
        files[-1].write_text("\n".join(["time (s),theta (deg)", *lines]))
    outcome = command("fit", *map(str, files), "--friction", "-p", str(joystick), "--update")
    assert outcome.code == 0, outcome.err
    found = read_parameter_file(joystick)
    error = found.uncertainties["friction.T_c"]
    assert 0.0 < error < 1e-3
    assert abs(found.joystick.friction.T_c - 0.02) < 4.0 * error
    again = command("fit", *map(str, files), "-p", str(joystick))
    assert again.code == 0, again.err
    assert "friction" not in again.out.partition("|")[2].partition("\n\n")[0]
    twice = command("fit", *map(str, files), "--friction", "-p", str(joystick), "--known", "friction.T_c")
    assert twice.code == 2
    assert "records must not count twice" in twice.err


@pytest.mark.usefixtures("fmus_by_name")
def test_the_scale_of_the_load_cell(command: Command, tmp_path: Path) -> None:
    joystick = tmp_path / "joystick.toml"
    write_parameters(joystick, NOMINAL)
    outcome = command("fit", RECORDS[0], "-p", str(joystick), "--force-scale", "0.005", "--update")
    assert outcome.code == 0, outcome.err
    assert "Counted as measured beforehand: force_scale 1 +- 0.005" in outcome.out
    found = read_parameter_file(joystick)
    assert found.sources["forward"] == f"fit to {Path(RECORDS[0]).name}"
    assert found.uncertainties["forward.k[1]"] < 0.005 * found.curves["forward"].k[1]
    for scale, words in (("0.5", "--force-scale force_scale = 0.5"), ("0", "force_scale.uncertainty = 0")):
        assert words in command("fit", RECORDS[0], "-p", str(joystick), "--force-scale", scale).err
    assert "needs --parameters" in command("fit", RECORDS[0], "--force-scale", "0.005").err


@pytest.mark.usefixtures("fmus_by_name")
def test_peaks_that_the_fmu_does_not_have(command: Command, tmp_path: Path) -> None:
    settings = tmp_path / "peaks.toml"
    settings.write_text(
        '[fmu]\npath = "Joystick"\n[compare]\nwhat = "peaks"\noutputs = ["theta"]\n'
        '[compare.derivatives]\ntheta = "f_x"\n[free]\n"damping.C" = { start = 0.04 }\n',
        encoding="utf-8",
    )
    outcome = command("fit", RECORDS[0], "--settings", str(settings))
    assert outcome.code == 1
    assert "internal error" not in outcome.err
    assert "start values: the FMU shows nothing there to compare the records with" in outcome.message
