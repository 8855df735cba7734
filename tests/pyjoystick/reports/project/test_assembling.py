"""The steps of a project, derived from laboratory.toml and the files present."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.fmu import FmuNotFoundError
from pyjoystick.model import NOMINAL, write_parameters
from pyjoystick.reports import EXAMPLE_LABORATORY, new_project, plan_project, read_laboratory
from pyjoystick.reports.project.assembling import Assembly, assemble
from pyjoystick.support import SettingsError

MARKERS = '[[markers]]\nfiles = {}\ntop = "T"\nbase = ["A", "B"]\n'


def _none(name: str) -> Path:
    raise FmuNotFoundError(name, "")


def _assembly(folder: Path, text: str, *files: str) -> Assembly:
    for name in files:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text("content", encoding="utf-8")
    (folder / "laboratory.toml").write_text(text, encoding="utf-8")
    return assemble(read_laboratory(folder / "laboratory.toml"), _none)


def _names(found: Assembly) -> list[str]:
    return [one.name for one in found.steps]


def test_a_new_project_has_nothing_to_do_and_says_what_is_missing(tmp_path: Path) -> None:
    new_project(tmp_path / "new")
    plan = plan_project(tmp_path / "new", find=_none)
    assert {one.plan for one in plan} == {"missing"}
    assert "data/forward.csv does not exist, though laboratory.toml names it" in {one.why for one in plan}


def test_only_what_there_are_files_for_is_done(tmp_path: Path) -> None:
    found = _assembly(tmp_path, '[parts]\nfile = "parts.csv"\n[swing]\nfile = "no.csv"', "parts.csv")
    assert _names(found) == ["parts", "joystick before the fit", "joystick", "FMUs", "report"]
    missing = {one.name: one.reason for one in found.missing}
    assert missing["swing"] == "no.csv does not exist, though laboratory.toml names it"
    assert missing["load curve forward"] == "laboratory.toml has no [load_curve.forward]"
    assert missing["records"] == "laboratory.toml has neither [[markers]] nor [[record]]"
    assert "the damping is taken from the paper's joystick" in found.notes
    assert "the springs of the forward side are taken from the paper's joystick" in found.notes


def test_the_example_has_all_steps(tmp_path: Path) -> None:
    lab = EXAMPLE_LABORATORY.read_text(encoding="utf-8")
    names = [f"data/synthetic_{name}.csv" for name in ("forward", "backward", "parts", "swing")]
    names += [f"data/synthetic_{name}.csv" for name in ("trial_1", "trial_2", "trial_4", "acceleration_1")]
    found = _assembly(tmp_path, lab, *names)
    assert not found.missing
    assert not found.notes
    assert len(found.steps) == 15
    inputs = {one.name: set(one.inputs) for one in found.steps}
    # A motion hangs on the springs of the side that the joystick leans to, and on nothing else.
    trial = {"data/synthetic_trial_1.csv", "results/load_curves/forward.json"}
    assert inputs["record synthetic_trial_1"] == trial
    assert inputs["swing"] == {"data/synthetic_swing.csv", "results/parts.json"}
    files = {f"data/synthetic_{name}.csv" for name in ("forward", "backward", "parts", "swing")}
    results = {f"results/{name}" for name in ("joystick.toml", "fit/fit.json", "budget/budget.json")}
    assert inputs["report"] == files | results


def test_patterns_find_files_in_order_and_each_once(tmp_path: Path) -> None:
    text = MARKERS.format('["m/*.c3d", "m/b.c3d", "n/**/*.csv", "none*"]')
    found = _assembly(tmp_path, text, "m/b.c3d", "m/a.c3d", "n/deep/c.csv")
    assert [name for name in _names(found) if name.startswith("record")] == [
        "record a",
        "record b",
        "record c",
    ]
    assert [one.reason for one in found.missing if one.name == "records"] == ["no file matches none*"]


def test_a_fit_of_one_s_own_has_no_budget_and_no_peaks(tmp_path: Path) -> None:
    text = MARKERS.format('"a.c3d"') + '[fit]\nsettings = "fit.toml"'
    found = _assembly(tmp_path, text, "a.c3d", "fit.toml")
    assert "error budget" not in _names(found)
    assert "peaks" not in _names(found)
    assert "fit.toml" in next(one.inputs for one in found.steps if one.name == "fit")


@pytest.mark.parametrize(
    "text", ['parameters = "base.toml"', '[load_curve.forward]\nfile = "b.csv"\nfriction = true']
)
def test_a_joystick_that_rubs_watches_the_fmus_that_run_it(text: str, tmp_path: Path) -> None:
    asked: list[str] = []

    def find(name: str) -> Path:
        asked.append(name)
        return _none(name)

    write_parameters(tmp_path / "base.toml", NOMINAL.replace({"friction.T_c": 0.01}))
    (tmp_path / "laboratory.toml").write_text(f'{text}\n[[record]]\nfiles = "a.csv"', encoding="utf-8")
    (tmp_path / "a.csv").touch()
    (tmp_path / "b.csv").touch()
    assemble(read_laboratory(tmp_path / "laboratory.toml"), find)
    assert set(asked) == {"JoystickFriction", "JoystickFrictionPowerLaw"}


def test_no_fmus_where_none_are_wanted(tmp_path: Path) -> None:
    found = _assembly(tmp_path, '[parts]\nfile = "p.csv"\n[fmus]\nfmi = []', "p.csv")
    assert "FMUs" not in _names(found)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            MARKERS.format('["x/a.c3d", "y/A.csv"]'),
            "two files have this name, x/a.c3d and y/A.csv: rename one",
        ),
        (
            MARKERS.format('"x/a.c3d"') + '[[accelerometer]]\nfile = "b.csv"\nrecord = "b"\ndistance = 0.2',
            'record = "b": must be the name of a motion: a',
        ),
    ],
)
def test_names_must_lead_to_one_file(text: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(SettingsError) as caught:
        _assembly(tmp_path, text, "x/a.c3d", "y/A.csv", "b.csv")
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("[body]\nm = 0.8\n[geometry]\na = 0.025", ["center of mass", "moment of inertia", "geometry (b)"]),
        ("[body]\nm = 0.8\nh = 0.08\nJ = 0.01", ["geometry (a, b)"]),
        ("[body]\nm = 0.8\nh = 0.08\n[[record]]\nfiles = 'r.csv'", ["geometry (a, b)"]),
        (
            "[body]\nm = 0.8\nh = 0.08\n[[record]]\nfiles = 'r.csv'\n[fit]\nlaw = 'power-law'",
            ["moment of inertia", "geometry (a, b)"],
        ),
        (
            "[body]\nm = 0.8\nh = 0.08\n[[record]]\nfiles = 'r.csv'\n[fit]\nsettings = 'fit.toml'",
            ["moment of inertia", "geometry (a, b)"],
        ),
    ],
)
def test_every_number_of_the_paper_is_named(text: str, names: list[str], tmp_path: Path) -> None:
    """J of the constant law is fitted; eq. (11) is fitted with J as it is known."""
    (tmp_path / "fit.toml").write_text('[free]\n"damping.C" = {}\n', encoding="utf-8")
    (tmp_path / "r.csv").touch()
    notes = _assembly(tmp_path, text).notes
    base = "is taken from the paper's joystick"
    names = [*names, "length of the handle (pivot_to_top), with which the report computes forces,"]
    assert [note for note in notes if "springs" not in note and "damping" not in note] == [
        f"the {name} {base}" for name in names
    ]


def test_a_handle_that_was_measured_is_not_named(tmp_path: Path) -> None:
    notes = _assembly(tmp_path, '[geometry]\na = 0.025\nb = 0.005\npivot_to_top = "42 cm"').notes
    assert not [note for note in notes if "handle" in note]
