"""``pyjoystick check``."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.model import PAPER
from tests.pyjoystick.cli.conftest import Command

SCENARIOS = Path(__file__).parents[3] / "scenarios"
SWEEP = """
[fmu]
path = "Joystick"
[experiment]
duration = -1.0
[vary."damping.C"]
from = 0.03
to = 0.03
count = 3
[vary.nothing]
values = [1.0]
[sampling]
method = "latin-hypercube"
count = 0
[[results]]
kind = "final"
variable = "nothing"
[extra]
"""
FIT = """
[fmu]
path = "Joystick"
[parameters]
J = -1.0
[free]
"damping.C" = { start = "many", more = 2 }
h = { minimum = 1.0, maximum = 0.0 }
[noise]
sigma = { theta = "0.1kg" }
[search]
starts = 0
"""


def _places(text: str) -> list[str]:
    return [line.split(": ")[2].split(" = ")[0] for line in text.splitlines()]


@pytest.mark.usefixtures("fmus_by_name")
def test_files_that_can_be_used(command: Command, tmp_path: Path) -> None:
    sweeps = sorted(SCENARIOS.glob("sweeps/*.toml"))
    assert sweeps
    (tmp_path / "fit.toml").write_text('fmu.path = "Joystick"\nfree.J = {}\n', encoding="utf-8")
    outcome = command("check", str(PAPER.path), "fit.toml", *map(str, sweeps))
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.out.count("nothing wrong") == 2 + len(sweeps)
    assert f"{PAPER.path}: parameter file, nothing wrong" in outcome.out


def test_everything_wrong_in_a_parameter_file(command: Command, tmp_path: Path) -> None:
    text = PAPER.path.read_text(encoding="utf-8")
    for right, wrong in (
        ("m = 0.87 ", "m = -0.87 "),
        ("J = 0.01135", "jay = 0.01135"),
        ("a = 0.02398", "a = 23.98"),
        ("g = 9.80665", 'g = "9.80665"'),
        ("k = [430e3, 2625.0, 1028e3, 5600.0]", "k = [430e3, 2625.0, 1028e3]"),
        ('law = "constant"', 'law = "konstant"'),
    ):
        assert right in text
        text = text.replace(right, wrong, 1)
    (tmp_path / "wrong.toml").write_text(text, encoding="utf-8")
    outcome = command("check", "wrong.toml")
    assert (outcome.code, outcome.out) == (1, "")
    places = sorted(_places(outcome.err))
    assert len(places) == 7, outcome.err
    for place in ("[body] m", "[body] J", "[body] jay", "[geometry] a", "[gravity] g", "[damping] law"):
        assert places.count(place) == 1, outcome.err
    assert "[forward]" in outcome.err


@pytest.mark.usefixtures("fmus_by_name")
def test_everything_wrong_in_settings(command: Command, tmp_path: Path) -> None:
    (tmp_path / "sweep.toml").write_text(SWEEP, encoding="utf-8")
    (tmp_path / "fit.toml").write_text(FIT, encoding="utf-8")
    sweep = command("check", "sweep.toml")
    assert sweep.code == 1
    assert _places(sweep.err) == [
        '[vary."damping.C"] to',
        "[vary.nothing]",
        "[experiment] duration",
        "[sampling] count",
        "[results 1] variable",
        "extra",
    ], sweep.err
    fit = command("check", "fit.toml")
    assert fit.code == 1
    print(fit.err)
    for place in (
        "[parameters] J",
        '[free."damping.C"] start',
        '[free."damping.C"] more',
        "[noise.sigma] theta",
    ):
        assert place in _places(fit.err), fit.err
    assert "[search] starts" in fit.err
    assert "[free.h]" in fit.err


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a = [", "bad.toml: is not TOML"),
        ("[other]", "bad.toml: contains no table that shows what kind of file it is"),
        ('[free]\nJ = {}\n[fmu]\npath = "no.fmu"', "no.fmu"),
    ],
)
def test_files_that_cannot_be_read(text: str, message: str, command: Command, tmp_path: Path) -> None:
    (tmp_path / "bad.toml").write_text(text, encoding="utf-8")
    outcome = command("check", "bad.toml")
    assert outcome.code == 1
    assert message in outcome.message


def test_names_that_an_fmu_does_not_have(command: Command, tmp_path: Path) -> None:
    (tmp_path / "fit.toml").write_text(
        """
fmu.path = "JoystickPowerLaw"
free.Jx = {}
free.aux = {}
free.J = {minimum = -5}
ties."damping.A_neg" = "0.5 * aux * dampling.A_pos"
compare.outputs = ["theta", "omeg"]
compare.inputs = ["T2"]
""",
        encoding="utf-8",
    )
    outcome = command("check", "fit.toml")
    assert outcome.code == 1
    assert _places(outcome.err) == [
        "[compare] outputs",
        "[compare] inputs",
        "[free.Jx]",
        "[free.aux] start",
        "[free.J] minimum",
        "[ties]",
    ], outcome.err
    assert "did you mean J?" in outcome.err


@pytest.mark.parametrize("fixed", ["h", "forward.returnSpring.F_0"])
def test_a_tie_to_a_parameter_that_is_not_free(fixed: str, command: Command, tmp_path: Path) -> None:
    (tmp_path / "fit.toml").write_text(
        f"""
fmu.path = "Joystick"
free.J = {{}}
parameters."{fixed}" = 0.02
ties."backward.returnSpring.F_0" = "1e-3 * J * {fixed}"
""",
        encoding="utf-8",
    )
    outcome = command("check", "fit.toml")
    assert outcome.code == 1
    assert "[ties] backward.returnSpring.F_0 = " in outcome.err
    assert f"must be an expression in the free parameters: J ({fixed} is not free)" in outcome.err
