"""laboratory.toml: its meaning, and mistakes reported with their position."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

from pyjoystick.laboratory import LowPass, Measured
from pyjoystick.model import PAPER
from pyjoystick.motion import Layout, Scale
from pyjoystick.reports import EXAMPLE_LABORATORY, read_laboratory
from pyjoystick.support import SettingsError, mistakes, read_toml

WHOLE = """
title = "Left"
[body]
m = "910 g"
u_m = 0.001
source = "balance"
[gravity]
g = 9.81
[geometry]
a = "24.1 mm"
b = 0.0051
pivot_to_top = "27 cm"
[load_curve.backward]
file = "b.csv"
columns = { travel = "Extension" }
units = { force = "kN" }
travel_noise = "1 um"
[swing]
times = [8.09, 8.14]
swings = 10
amplitude = "10 deg"
[signal_chain]
cutoff = 10
order = 2
[[markers]]
files = ["m/*.c3d", "one.csv"]
top = "TOP"
base = ["B1", "B2"]
forward = "-y"
radius = "266 mm"
u_radius = "0.5 mm"
rest = [3.5, 4]
rests = "backward"
[[record]]
files = "log.csv"
scales = { theta = "0.1deg/count", T = "2N.m/V" }
zeros = { theta = 2048 }
from = "500 ms"
decimal = ","
[[accelerometer]]
file = "acc.csv"
record = "one"
distance = "25 cm"
delay = "20 ms"
[fit]
law = "power-law"
u_scale = 0.002
u_time_base = 1e-4
u_force_scale = 0.005
[results]
release_angle = "-15 deg"
[fmus]
fmi = [2, 3]
platforms = ["all"]
json = true
"""


def _write(folder: Path, text: str) -> Path:
    path = folder / "laboratory.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_everything_that_it_can_say(tmp_path: Path) -> None:
    lab = read_laboratory(_write(tmp_path, WHOLE))
    assert lab.title == "Left"
    assert lab.root == tmp_path
    assert lab.given.values == {"m": 0.91, "g": 9.81, "a": 0.0241, "b": 0.0051, "pivot_to_top": 0.27}
    assert lab.given.uncertainties == {"body.m": 0.001}
    stated = "as stated in laboratory.toml"
    assert lab.given.sources == {"body": "balance", "gravity": stated, "geometry": stated}
    curve = lab.curves["backward"]
    assert (curve.columns, curve.units, curve.travel_noise) == (
        {"travel": "Extension"},
        {"force": "kN"},
        1e-6,
    )
    assert lab.swing is not None
    assert (lab.swing.times, lab.swing.swings) == ((8.09, 8.14), 10)
    assert lab.swing.amplitude == Measured(math.radians(10.0), math.radians(1.0))
    markers = lab.markers[0]
    assert markers.files == ("m/*.c3d", "one.csv")
    assert (markers.setup.base, markers.setup.forward, markers.setup.rests) == (
        ("B1", "B2"),
        "-y",
        "backward",
    )
    assert (markers.setup.rest, markers.setup.chain.low_pass) == ((3.5, 4.0), LowPass(10.0, 2))
    table = lab.tables[0]
    assert table.scales == {"theta": Scale(math.radians(0.1), "count", 2048.0), "T": Scale(2.0, "V")}
    assert (table.start, table.end, table.layout) == (0.5, None, Layout(decimal=","))
    assert (lab.accelerometers[0].setup.distance, lab.accelerometers[0].setup.delay) == (0.25, 0.02)
    assert (lab.fit.law, lab.angle_scale(), lab.release_angle) == ("power-law", 0.002, math.radians(-15.0))
    assert lab.time_base == 1e-4
    assert lab.force_scale == 0.005
    assert (lab.fmus.versions, lab.fmus.platforms, lab.fmus.json) == ((2, 3), ("all",), True)


def test_what_it_need_not_say(tmp_path: Path) -> None:
    lab = read_laboratory(_write(tmp_path, ""))
    assert (lab.base, lab.given.values, lab.markers, lab.fmus.versions) == (PAPER, {}, (), (2,))
    assert lab.angle_scale() == 0.0


def test_the_scale_of_the_angle_is_that_of_the_radius() -> None:
    assert read_laboratory(EXAMPLE_LABORATORY).angle_scale() == pytest.approx(0.5 / 266.0)


def test_what_is_commented_out_in_the_template_is_right_too(tmp_path: Path) -> None:
    """All of it at once; what has an alternative gives way to it."""
    text = (EXAMPLE_LABORATORY.parent / "laboratory.toml").read_text(encoding="utf-8")
    read_laboratory(_write(tmp_path, text))
    (tmp_path / "base.toml").write_bytes(PAPER.path.read_bytes())
    for first in (
        '[parts]\nfile = "data/parts.csv"\n',
        '[swing]\nfile = "data/swing.csv"\n',
        'law = "constant"',
    ):
        assert first in text
        text = text.replace(first, "")
    lab = read_laboratory(_write(tmp_path, re.sub(r"^# (?=\w+ = |\[)", "", text, flags=re.MULTILINE)))
    assert (lab.base_file, lab.fit.file, lab.fmus.name) == ("base.toml", "fit.toml", "LeftStick")
    assert set(lab.given.values) == {"m", "h", "a", "b", "pivot_to_top"}
    assert lab.swing is not None
    assert lab.swing.swings == 10
    assert lab.markers[0].radius_uncertainty == 0.0005
    assert lab.tables[0].scales["theta"].zero == 2048.0
    assert lab.accelerometers[0].record == "trial_1"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[geometrie]\na = 1", "geometrie: is not a known key (did you mean geometry?)"),
        ('[geometry]\na = "24 feet"', '[geometry] a = "24 feet": must be a number (m), or text with a unit'),
        ("[geometry]\na = 24.1", "[geometry] a = 24.1: must be between"),
        ("[geometry]\nu_a = 0.1", "[geometry] u_a = 0.1: is given without a"),
        ('[body]\nsource = "x"', '[body] source = "x": is given without a value'),
        ('[parts]\nfile = "p.csv"\n[body]\nm = 1', "[body] m = 1: must be left out: [parts] gives it"),
        ('[swing]\nfile = "a"\n[body]\nJ = 0.01', "[body] J = 0.01: must be left out: [swing] gives it"),
        ("[parts]", "[parts] file: is missing"),
        ('[parts]\nfile = ""', '[parts] file = "": must name a file'),
        ('[swing]\nfile = ""', '[swing] file = "": must name a file'),
        ('[[record]]\nfiles = ["a", ""]', '[record 1] files = ["a", ""]: must name files'),
        ('[geometry]\na = "4 mm"', "[geometry]"),
        ('[fmus]\nname = "../up"', '[fmus] name = "../up": must be letters, digits and underscores'),
        ('[swing]\nfile = "a"\ntimes = [1]', "[swing]: needs either file, a recorded swing, or times"),
        ("[swing]\ntimes = [8.0]", "[swing] amplitude: is missing: the period depends on it"),
        ("[swing]\ntimes = [8.0]\namplitude = 10", 'did you mean "10 deg"?'),
        ("[[markers]]", "[markers 1] base: is missing"),
        ('[[markers]]\nbase = ["A"]', '[markers 1] base = ["A"]: must be two names'),
        ('[[markers]]\nbase = ["A", "B"]\ntop = "T"\nfiles = "x"\nup = "w"', "must be one of x, -x, y, -y"),
        (
            '[[markers]]\nbase = ["A", "B"]\ntop = "T"\nfiles = "x"\nradius = 0.2\nmiddle = true',
            "[markers 1] radius = 0.2: must be left out with middle",
        ),
        ('[[record]]\nfiles = "x"\nscales = { theta = "1/V" }', "[record 1.scales] theta"),
        ('[[record]]\nfiles = "x"\nzeros = { theta = 1 }', 'zeros = {"theta": 1}: has theta, for which'),
        ("[[record]]\nfiles = []", "[record 1] files = []: must be a list with one entry or more"),
        ("[[accelerometer]]", "[accelerometer 1] distance: is missing"),
        ('[fit]\nlaw = "linear"', "[fit] law"),
        ('[fit]\nlaw = "constant"\nsettings = "f.toml"', '[fit] law = "constant": must be left out'),
        ("[fit]\nu_time_base = nan", "[fit] u_time_base = NaN: must be a finite number"),
        ("[fit]\nu_scale = -1.0", "[fit] u_scale = -1.0: must be a finite number, 0 or more"),
        ("[fmus]\nssp = true\nfmi = []", "[fmus] ssp = true: needs FMUs"),
        ("[fmus]\nfmi = 2", "[fmus] fmi = 2: must be a list"),
        ("[signal_chain]\nvelocity_points = 4", "[signal_chain] velocity_points = 4"),
        ("[results]\nrelease_angle = -20", 'did you mean "-20 deg"?'),
    ],
)
def test_mistakes_are_named_by_their_place(text: str, message: str, tmp_path: Path) -> None:
    with pytest.raises(SettingsError) as caught:
        read_laboratory(_write(tmp_path, text))
    assert message in str(caught.value)


def test_all_mistakes_at_once(tmp_path: Path) -> None:
    wrong = (
        WHOLE.replace('"24.1 mm"', '"24.1 miles"').replace('"-y"', '"w"').replace("fmi = [2, 3]", "fmi = 4")
    )
    found = mistakes(_write(tmp_path, wrong), read_laboratory, read_toml(EXAMPLE_LABORATORY).content)
    assert [one.key for one in found if isinstance(one, SettingsError)] == ["a", "forward", "fmi"]
