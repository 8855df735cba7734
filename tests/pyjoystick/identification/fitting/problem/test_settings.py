"""Settings of a fit: errors, the example of the documentation, and values of a parameter file."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from pyjoystick.identification import (
    CONSTANT_DAMPING,
    RELEASE,
    FitSettings,
    Free,
    Noise,
    Search,
    Uncertainty,
    read_fit_settings,
    reads_releases,
    with_values,
)
from pyjoystick.model import NOMINAL, write_parameters
from pyjoystick.support import ParameterError, PyJoystickError, SettingsError
from tests.pyjoystick.cli.test_fit import SETTINGS

DOCUMENTATION = Path(__file__).parents[5] / "docs" / "fitting.md"


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"free": ()}, "free = nothing"),
        ({"fixed": {"theta_start": 0.1}}, "theta_start = given twice"),
        ({"outputs": ()}, "outputs = nothing"),
        ({"comparison": "spectra"}, "'trajectory' or 'peaks'"),
        ({"comparison": "peaks", "outputs": ("theta", "omega")}, "one output where peaks are compared"),
        ({"noise": Noise({"omega": 0.1})}, "noise.sigma = omega"),
        ({"noise": Noise({"theta": 0.1}), "comparison": "peaks"}, "left out where peaks are compared"),
        ({"inputs": ("T",)}, "left out where inputs drive the FMU"),
        ({"peaks": 1}, "peaks = 1"),
        ({"peaks": 2.5}, "peaks = 2.5"),
        ({"tolerance": 0.0}, "tolerance = 0.0"),
    ],
)
def test_what_is_refused(given: dict[str, Any], words: str) -> None:
    with pytest.raises(ParameterError, match=re.escape(words)):
        FitSettings(**{"fmu": "Joystick", "free": RELEASE, **given})


@pytest.mark.parametrize(
    ("kind", "given", "words"),
    [
        (Free, {"name": "J", "minimum": 2.0, "maximum": 1.0}, "J.minimum = 2.0"),
        (Free, {"name": "J", "start": 3.0, "maximum": 1.0}, "J.start = 3.0"),
        (Free, {"name": "J", "start": float("nan")}, "J.start = nan"),
        (Noise, {"sigma": {"theta": -0.1}}, "noise.sigma.theta = -0.1"),
        (Noise, {"sigma": {"theta": 0.1}, "per_record": True}, "left out where sigma is given"),
        (Search, {"starts": 0}, "search.starts = 0"),
        (Search, {"seed": True}, "search.seed = True"),
        (Search, {"stages": (0.6, 0.3)}, "increasing, between 0 and 1"),
        (Uncertainty, {"level": 1.0}, "uncertainty.level = 1.0"),
        (Uncertainty, {"bootstrap": -1}, "uncertainty.bootstrap = -1"),
        (Uncertainty, {"resampling": "days"}, "'records' or 'residuals'"),
    ],
)
def test_parts_that_are_refused(kind: type[Any], given: dict[str, Any], words: str) -> None:
    with pytest.raises(ParameterError, match=re.escape(words)):
        kind(**given)


def _read(folder: Path, text: str) -> FitSettings:
    (folder / "fit.toml").write_text(text, encoding="utf-8")
    return read_fit_settings(folder / "fit.toml")


def test_the_file_of_the_documentation(tmp_path: Path, fmus_by_name: Path) -> None:
    (example,) = re.findall(r"```toml\n(.*?)```", DOCUMENTATION.read_text(encoding="utf-8"), re.DOTALL)
    found = _read(tmp_path, example)
    assert found.fixed["damping.alpha"] == 1.0
    assert [one.name for one in found.free if one.per_record] == [
        "theta_start",
        "release_time",
        "zero_offset",
    ]
    assert set(found.ties) == {"damping.A_pos", "damping.A_neg"}


def test_every_key_arrives(tmp_path: Path, fmus_by_name: Path) -> None:
    found = _read(
        tmp_path,
        """
[fmu]
path = "Joystick"
tolerance = 1e-9
[parameters]
theta_start = "-20deg"
release_time = 0.1
[free]
"damping.C" = { start = 0.05, minimum = 0.01, maximum = 0.2 }
J = {}
[compare]
what = "peaks"
outputs = ["omega"]
peaks = 8
derivatives = { omega = "alpha" }
[noise]
per_record = true
[search]
starts = 4
seed = 7
evaluations = 50
stages = [0.5]
exchanges = [["J", "damping.C"]]
[uncertainty]
level = 0.9
profiles = ["J"]
bootstrap = 10
resampling = "residuals"
""",
    )
    assert found == FitSettings(
        fmu="Joystick",
        free=(Free("damping.C", 0.05, 0.01, 0.2), Free("J")),
        fixed={"theta_start": pytest.approx(-0.3490658503988659), "release_time": 0.1},
        outputs=("omega",),
        derivatives={"omega": "alpha"},
        comparison="peaks",
        peaks=8,
        tolerance=1e-9,
        noise=Noise(per_record=True),
        search=Search(4, 7, 50, (0.5,), (("J", "damping.C"),)),
        uncertainty=Uncertainty(0.9, ("J",), 10, "residuals"),
    )
    assert reads_releases(found)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('path = "Joystick"', "", r"[fmu] path"),
        ("[fmu]", "[fmus]", "fmu: is missing"),
        ("[free]", "[frei]", "free: is missing"),
        ("start = 0.06", "start = 0.7", '[free."damping.C"] start = 0.7: must be from 0 to 0.5'),
        ("profiles = []", 'profiles = ["theta_start"]', "uncertainty.profiles = theta_start"),
        ("profiles = []", "profiles = [1]", "[uncertainty] profiles = [1]: must be names of parameters"),
        ("starts = 3", "stages = [0.6, 0.3]", "[search] stages = [0.6, 0.3]: must be increasing"),
        ("starts = 3", "exchanges = [3]", "[search] exchanges = [3]: must be pairs of names"),
        ("starts = 3", 'exchanges = [["J"]]', "must be pairs of names"),
        ("starts = 3", 'exchanges = [["J", "m"]]', "search.exchanges = J: must be among the free"),
        ("minimum = 0.0", 'minimum = "0.0 furlong"', r'[free."damping.C"] minimum'),
        ("per_record = true", "per_record = 1", "must be true or false"),
        ("profiles = []", 'profiles = "C"', "[uncertainty] profiles"),
        ("profiles = []", "profiles = []\nlevels = 0.9", "did you mean level?"),
        ("starts = 3", "starts = 0", "[search] starts = 0: must be a whole number"),
        ("starts = 3", "starts = 3\n[compare]\nwhat = 'peak'", "[compare] what"),
        ("starts = 3", "starts = 3\n[compare]\noutputs = [1]", "must be a list of names"),
        ("starts = 3", "starts =", "fit.toml"),
        ('sigma = { theta = "0.1deg" }', 'sigma = { thet = "0.1deg" }', "did you mean theta"),
        ("[noise]", "[parameters]\nQ = 1.0\n[noise]", "[parameters] Q"),
    ],
)
def test_mistakes_are_named_with_their_place(
    tmp_path: Path, fmus_by_name: Path, old: str, new: str, words: str
) -> None:
    assert old in SETTINGS
    with pytest.raises(PyJoystickError) as caught:
        _read(tmp_path, SETTINGS.replace(old, new, 1))
    assert "fit.toml" in str(caught.value)
    assert words in str(caught.value)


def test_a_comparison_that_cannot_be_is_named_with_the_file(tmp_path: Path, fmus_by_name: Path) -> None:
    with pytest.raises(SettingsError, match=r"fit\.toml.*one output where peaks are compared"):
        _read(
            tmp_path,
            SETTINGS.replace("[search]", '[compare]\nwhat = "peaks"\noutputs = ["theta", "omega"]\n[search]'),
        )


_SETTINGS = """
[fmu]
path = "Joystick"
parameters = "joystick.toml"

[parameters]
m = 0.9

[free."damping.C"]
[free.J]
start = 0.013
"""


def test_values_are_fixed_or_the_start() -> None:
    settings = FitSettings(
        fmu="Joystick",
        free=(Free("damping.C"), Free("J", start=0.01)),
        ties={"h": "0.1 * a"},
        fixed={"m": 1.0},
    )
    values = NOMINAL.replace({"J": 0.02, "damping.C": 0.06}).to_names()
    found = with_values(settings, values)
    assert [(one.name, one.start) for one in found.free] == [("damping.C", 0.06), ("J", 0.01)]
    assert found.fixed["m"] == 1.0
    assert found.fixed["a"] == NOMINAL.a
    assert set(found.fixed) == set(values) - {"damping.C", "J", "h"}
    replaced = with_values(settings, values, replace_starts=True)
    assert [one.start for one in replaced.free] == [0.06, 0.02]


def test_the_release_stays_free() -> None:
    found = with_values(CONSTANT_DAMPING, NOMINAL.to_names(), replace_starts=True)
    assert found.free[1:] == CONSTANT_DAMPING.free[1:]


def test_settings_name_a_parameter_file(tmp_path: Path, fmus_by_name: Path) -> None:
    write_parameters(tmp_path / "joystick.toml", NOMINAL.replace({"J": 0.02, "damping.C": 0.06, "b": 0.004}))
    (tmp_path / "fit.toml").write_text(_SETTINGS, encoding="utf-8")
    found = read_fit_settings(tmp_path / "fit.toml")
    assert {one.name: one.start for one in found.free} == {"damping.C": 0.06, "J": 0.013}
    assert (found.fixed["m"], found.fixed["b"]) == (0.9, 0.004)


def test_a_parameter_file_for_another_fmu(tmp_path: Path, fmus_by_name: Path, mixed_path: Path) -> None:
    write_parameters(tmp_path / "joystick.toml", NOMINAL)
    text = _SETTINGS.replace('path = "Joystick"', f'path = "{mixed_path}"').replace("m = 0.9", "")
    (tmp_path / "fit.toml").write_text(text, encoding="utf-8")
    with pytest.raises(
        SettingsError, match=r"\[fmu\] parameters = .joystick.toml.: is for joysticks, and Mixed has no"
    ):
        read_fit_settings(tmp_path / "fit.toml")
