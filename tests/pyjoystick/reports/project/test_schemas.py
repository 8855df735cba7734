"""The schemas of the TOML files accept what their readers accept."""

from __future__ import annotations

import copy
import json
import random
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import tomlkit
from jsonschema import Draft7Validator

from fmu_build import BuildError
from fmu_build.explore import read_settings as read_explore_settings
from pyjoystick.fmu import find_fmu
from pyjoystick.identification import read_fit_settings
from pyjoystick.model import PAPER, read_parameter_file, write_parameters
from pyjoystick.reports import EXAMPLE_LABORATORY, new_project, read_laboratory, schemas, write_schemas
from pyjoystick.runs import Sweep, read_settings
from pyjoystick.support import PyJoystickError, Table, write_text
from tests.docs.pages import PAGES, ROOT, blocks
from tests.pyjoystick.reports.project.test_laboratory_file import WHOLE

Content = dict[str, Any]
FIT = """
[fmu]
path = "Joystick"
tolerance = 1e-8
[parameters]
J = 0.0115
[free]
"damping.C" = { start = 0.05, minimum = "0.0 N.m.s/rad", maximum = 0.5 }
m = { }
theta_start = { per_record = true, start = "-20deg" }
release_time = { per_record = true }
[ties]
h = "0.09 * m"
[noise]
sigma = { theta = "0.1deg" }
per_record = false
[compare]
what = "trajectory"
outputs = ["theta"]
peaks = 5
derivatives = { theta = "omega" }
[search]
starts = 2
seed = 1
evaluations = 100
stages = [0.5]
exchanges = [["damping.C", "m"]]
[uncertainty]
level = 0.9
profiles = ["m"]
bootstrap = 0
resampling = "residuals"
"""
EXPLORE = """
[explore]
title = "A joystick"
stop_time = 2.0
step = 0.001
first = ["theta_start"]
values = { theta_start = -0.35 }
input_tables = false
plots = [{ y = ["theta"] }, { x = "theta", y = ["omega"] }]
[explore.ranges]
"damping.C" = { min = 0.1, max = 0.2, scale = "log" }
[[explore.presets]]
name = "Undamped"
values = { "damping.C" = 0.0 }
"""
#: Ways in which a value can be wrong, and some in which it may be right.
OTHERS: tuple[Any, ...] = (0, 1, 3, -2.5, "text", "1 mm", True, [], [1.0], ["a", "b"], {}, {"a": 1})


@pytest.fixture(scope="module")
def find(joystick_fmus: Path) -> Callable[[str], Path]:
    return lambda name: find_fmu(str(joystick_fmus / f"{name}.fmu"))


def _reader(kind: str, find: Callable[[str], Path]) -> Callable[[Table], object]:
    return {
        "laboratory": read_laboratory,
        "joystick": read_parameter_file,
        "sweep": lambda root: Sweep(read_settings(root, find)),
        "fit": lambda root: read_fit_settings(root, find),
        "explore": _read_explore,
    }[kind]


def _read_explore(root: Table) -> object:
    root.path.write_text(tomlkit.dumps(root.content), encoding="utf-8")
    try:
        return read_explore_settings(root.path)
    except BuildError as error:
        raise PyJoystickError from error


def _examples(kind: str) -> list[Content]:
    sweeps = sorted((ROOT / "scenarios" / "sweeps").glob("*.toml"))
    whole = PAPER.path.read_text(encoding="utf-8").replace("m = 0.87", "u_m = 0.001\nm = 0.87")
    texts = {
        "laboratory": [WHOLE, EXAMPLE_LABORATORY.read_text(encoding="utf-8")],
        "joystick": [whole, f"implausible = true\n{whole}"],
        "sweep": [path.read_text(encoding="utf-8") for path in sweeps],
        "fit": [FIT],
        "explore": [EXPLORE],
    }
    return [tomllib.loads(text) for text in texts[kind]]


def _places(content: Any, place: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Every place in a document."""
    items = content.items() if isinstance(content, dict) else enumerate(content)
    for key, value in items:
        yield (*place, key)
        if isinstance(value, dict | list):
            yield from _places(value, (*place, key))


def _mutated(content: Content, rng: random.Random) -> Content:
    """One place deleted, given another value, or with an unknown key beside it."""
    found = copy.deepcopy(content)
    *way, last = rng.choice(list(_places(found)))
    at: Any = found
    for key in way:
        at = at[key]
    action = rng.randrange(4)
    if action == 0:
        del at[last]
    elif action == 1 and isinstance(at, dict):
        at["unknown_key"] = 1.0
    else:
        at[last] = copy.deepcopy(rng.choice(OTHERS))
    return found


@pytest.mark.parametrize("kind", ["laboratory", "joystick", "sweep", "fit", "explore"])
def test_a_schema_takes_what_its_reader_takes(kind: str, find: Callable[[str], Path], tmp_path: Path) -> None:
    """And of what the reader refuses, most, though it knows no FMU and compares no values."""
    schema = schemas()[f"{kind}.schema.json"]
    Draft7Validator.check_schema(schema)
    validator, read = Draft7Validator(schema), _reader(kind, find)
    rng = random.Random(3)
    refused = seen = 0
    for content in _examples(kind):
        read(Table(tmp_path / "file.toml", "", copy.deepcopy(content)))
        assert not [error.message for error in validator.iter_errors(content)]
        for _ in range(50):
            changed = _mutated(content, rng)
            try:
                read(Table(tmp_path / "file.toml", "", copy.deepcopy(changed)))
            except PyJoystickError:
                refused += 1
                seen += not validator.is_valid(changed)
            else:
                errors = [f"{list(error.path)}: {error.message}" for error in validator.iter_errors(changed)]
                assert not errors
    assert seen > 0.75 * refused > 20


def test_printed_settings_are_right_by_their_schemas() -> None:
    """Those of the pages, and with them the keys that are documented."""
    known = {
        "vary": "sweep",
        "free": "fit",
        "load_curve": "laboratory",
        "body": "joystick",
        "explore": "explore",
    }
    count = 0
    for page in PAGES:
        for block in blocks(page.read_text(encoding="utf-8")):
            if block.language == "toml":
                content = tomllib.loads(block.text)
                kind = next(known[table] for table in known if table in content)
                errors = Draft7Validator(schemas()[f"{kind}.schema.json"]).iter_errors(content)
                assert not [f"{page.name}: {error.message}" for error in errors]
                count += 1
    assert count >= 4


def test_a_new_project_names_its_schema(tmp_path: Path) -> None:
    new_project(tmp_path)
    first = (tmp_path / "laboratory.toml").read_text(encoding="utf-8").partition("\n")[0]
    schema = json.loads((tmp_path / first.removeprefix("#:schema ")).read_text(encoding="utf-8"))
    assert schema == schemas()["laboratory.schema.json"]


def test_schemas_are_written_whole(tmp_path: Path) -> None:
    write_text(tmp_path / "fit.schema.json", "old")
    assert sorted(path.name for path in write_schemas(tmp_path)) == sorted(schemas())
    assert (
        json.loads((tmp_path / "fit.schema.json").read_text(encoding="utf-8")) == schemas()["fit.schema.json"]
    )


def test_a_parameter_file_with_friction_fits_its_schema(tmp_path: Path) -> None:
    joystick = PAPER.joystick.replace({"friction.T_c": 0.02})
    write_parameters(tmp_path / "joystick.toml", joystick, uncertainties={"friction.T_c": 1e-4})
    content = tomllib.loads((tmp_path / "joystick.toml").read_text(encoding="utf-8"))
    assert content["friction"]["T_c"] == 0.02
    (name,) = (one for one in schemas() if "parameter" in one or "joystick" in one)
    assert list(Draft7Validator(schemas()[name]).iter_errors(content)) == []
