"""Reading parameter files, and the messages for mistakes in them."""

from __future__ import annotations

from pathlib import Path

import pytest

from pyjoystick.model import (
    NOMINAL,
    NOMINAL_POWER_LAW,
    PAPER,
    PIVOT_TO_TOP,
    ConstantDamping,
    ImplausibleError,
    PowerLawDamping,
    RestrainedSpring,
    read_parameter_file,
    read_parameters,
    require_plausible,
    write_parameters,
)
from pyjoystick.support import InputFileError, SettingsError
from tests.pyjoystick.model.parameters.conftest import change


def test_the_shipped_file_holds_tables_1_and_2() -> None:
    """Against the paper's tables as they are printed."""
    curves = {side: (curve.x, curve.k) for side, curve in PAPER.curves.items()}
    assert curves == {
        "forward": ((0.075e-3, 0.1985e-3, 2.932e-3, 2.943e-3), (430e3, 2625.0, 1028e3, 5600.0)),
        "backward": ((0.075e-3, 0.1595e-3, 3.054e-3, 3.063e-3), (659e3, 1191.0, 1112e3, 4090.0)),
    }
    body = {name: NOMINAL.to_names()[name] for name in ("m", "J", "h", "a", "b", "g")}
    assert body == {"m": 0.87, "J": 0.01135, "h": 0.082, "a": 0.02398, "b": 0.005, "g": 9.80665}
    assert PIVOT_TO_TOP == 0.266
    assert NOMINAL.damping == ConstantDamping(C=0.045)
    expected = PowerLawDamping(
        alpha=0.9, A_pos=0.086, n_pos=0.084, A_neg=0.032, n_neg=-0.23, B=0.051, m=-0.26
    )
    assert NOMINAL_POWER_LAW.damping == expected


def test_the_law_that_the_file_chooses(file: Path) -> None:
    assert read_parameters(file) == NOMINAL
    change(file, ('law = "constant"', 'law = "power-law"'))
    found = read_parameter_file(file)
    assert (found.law, found.joystick) == ("power-law", NOMINAL_POWER_LAW)
    assert found.with_law("constant") == NOMINAL


def test_a_law_that_the_file_lacks(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    file.write_text(text[: text.index("[damping.power-law]")], encoding="utf-8")
    with pytest.raises(SettingsError) as missing:
        read_parameter_file(file).with_law("power-law")
    expected = f"{file}: [damping.power-law]: is missing (it has those of the law constant)"
    assert str(missing.value) == expected
    change(file, ('law = "constant"', 'law = "power-law"'))
    with pytest.raises(
        SettingsError, match=r"\[damping\] law = .power-law.: needs a table \[damping.power-law\]"
    ):
        read_parameter_file(file)


def test_uncertainties_and_sources(file: Path) -> None:
    change(
        file,
        ("m = 0.87 ", "u_m = 0.001\nm = 0.87 "),
        ("x = [0.075e-3, 0.1985e-3", "u_x = [1e-6, 2e-6, 3e-6, 0]\nx = [0.075e-3, 0.1985e-3"),
        ("C = 0.045", "u_C = 2e-3\nC = 0.045"),
    )
    found = read_parameter_file(file)
    travels = {f"forward.x[{i}]": value for i, value in enumerate((1e-6, 2e-6, 3e-6, 0.0))}
    assert found.uncertainties == {"body.m": 0.001, **travels, "damping.constant.C": 0.002}
    assert found.sources["forward"] == "Rogers et al. (2004), Table 1"
    assert found.joystick == NOMINAL


def test_what_may_be_left_out(file: Path) -> None:
    text = file.read_text(encoding="utf-8")
    left_out = ("pivot_to_top", "eps_theta", "eps_omega", "source", "title", "#")
    kept = [line for line in text.splitlines() if not line.startswith(left_out)]
    file.write_text("\n".join(kept), encoding="utf-8")
    found = read_parameter_file(file)
    assert found.pivot_to_top is None
    assert found.with_law("power-law") == NOMINAL_POWER_LAW
    assert (found.title, found.sources) == ("", {})


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("m = 0.87 ", "m = -1 ", "[body] m = -1: must be a finite number, 0 kg or more"),
        ("m = 0.87 ", 'm = "heavy" ', '[body] m = "heavy": must be a finite number'),
        ("m = 0.87 ", "", "[body] m: is missing"),
        ("m = 0.87 ", "mass = 0.87 ", "[body] m: is missing"),
        (
            "m = 0.87 ",
            "m = 0.87\nM = 1 ",
            "[body] M: is not a known key (known are m, u_m, h, u_h, J, u_J, source)",
        ),
        ("m = 0.87 ", "m = 0.87\nu_m = -1 ", "[body] u_m = -1: must be a finite number, 0 or more"),
        ("m = 0.87 ", "m = 0.87\nu_m = 1.3 ", "[body] u_m = 1.3: must be below a third of m = 0.87"),
        ("b = 0.0050 ", "b = 0.03 ", "[geometry] b = 0.03: must be below a = 0.02398 m"),
        (
            "pivot_to_top = 0.266",
            "pivot_to_top = 0",
            "[geometry] pivot_to_top = 0: must be a finite number above 0 m",
        ),
        ("[gravity]\n", "[weight]\n", "gravity: is missing"),
        (
            "x = [0.075e-3, 0.1985e-3, 2.932e-3, 2.943e-3]",
            "x = [0.075, 0.1985, 2.932, 2.943]",
            "[forward] x[0] = 0.075: must be below a = 0.02398 m (in mm? 0.075 mm are 7.5e-05 m)",
        ),
        (
            "0.1985e-3, 2.932e-3",
            "0.1985e-3, 0.1e-3",
            "[forward] x[2] = 0.0001: must be at least x[1] = 0.0001985 m",
        ),
        ("[0.075e-3, 0.1985e-3, ", "[0.075e-3, ", "as many stiffnesses as travels"),
        ("k = [430e3,", "k = [43,", "[forward] k[0] = 43.0: must be above k[1] = 2625 N/m"),
        ("k = [430e3,", 'k = ["stiff",', '[forward] k[0] = "stiff": must be a finite number above 0 N/m'),
        (
            "k = [430e3,",
            "u_k = [1.0]\nk = [430e3,",
            "[forward] u_k = [1.0]: must be a list of 4 numbers, as k is",
        ),
        (
            "k = [430e3,",
            "u_k = [1, 1, -1, 1]\nk = [430e3,",
            "[forward] u_k[2] = -1: must be a finite number, 0 or more",
        ),
        (
            'law = "constant"',
            'law = "viscous"',
            '[damping] law = "viscous": must be one of constant, power-law',
        ),
        ("alpha = 0.9", "alpha = 1.9", "[damping.power-law] alpha = 1.9: must be between 0 and 1"),
        ("[forward] ", "[forwards] ", "forward: is missing"),
        (
            "[gravity]\n",
            "[friction]\nT_c = -0.1\n[gravity]\n",
            "[friction] T_c = -0.1: must be a finite number, 0 N.m",
        ),
        ("[gravity]\n", "[friction]\nT_c = 7.2\n[gravity]\n", "did you mean 7.2 N.mm = 0.0072 N.m?"),
        (
            "[gravity]\n",
            "[friction]\nT_k = 0.1\n[gravity]\n",
            "[friction] T_k: is not a known key (did you mean T_s?)",
        ),
        (
            "[gravity]\n",
            "[friction]\nT_c = 0.1\nT_s = 0.2\n[gravity]\n",
            "[friction] omega_s = 0.0: must be above 0 rad/s, because T_s is above T_c",
        ),
        ("[gravity]\n", "[stops]\ntheta_stop = 20.0\n[gravity]\n", "did you mean 20 deg = 0.349066 rad?"),
        (
            "[gravity]\n",
            "[stops]\nK = -1.0\n[gravity]\n",
            "[stops] K = -1.0: must be a finite number above 0 N.m/rad",
        ),
        (
            "[gravity]\n",
            "[stops]\nangle = 0.3\n[gravity]\n",
            "[stops] angle: is not a known key (known are theta_stop,",
        ),
        ("[body]", "[body", "is not TOML"),
    ],
)
def test_mistakes_are_named_with_their_place(file: Path, old: str, new: str, message: str) -> None:
    change(file, (old, new))
    with pytest.raises(SettingsError) as refused:
        read_parameter_file(file)
    assert str(refused.value).startswith(f"{file}: ")
    assert message in str(refused.value)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(InputFileError, match=r"none\.toml: cannot be read: No such file"):
        read_parameters(tmp_path / "none.toml")


@pytest.mark.parametrize(
    ("spring", "k_s", "k_h", "preload"),
    [
        (NOMINAL.forward.return_spring, 2625.0, 427375.0, 52.7808),
        (NOMINAL.forward.balance_spring, 2975.0, 1022400.0, 11.2464),
        (NOMINAL.backward.return_spring, 1191.0, 657809.0, 55.5849),
        (NOMINAL.backward.balance_spring, 2899.0, 1107910.0, 9.9712),
    ],
)
def test_springs_of_table_1(spring: RestrainedSpring, k_s: float, k_h: float, preload: float) -> None:
    assert spring.k_s == k_s
    assert spring.k_h == k_h
    assert pytest.approx(preload, abs=5e-5) == spring.F_0


def test_the_two_nominal_joysticks_differ_in_damping_only() -> None:
    constant, power_law = NOMINAL.to_names(), NOMINAL_POWER_LAW.to_names()
    shared = {name for name in constant if not name.startswith("damping.")}
    assert {name: power_law[name] for name in shared} == {name: constant[name] for name in shared}
    assert constant["damping.C"] == 0.045
    assert power_law["damping.alpha"] == 0.9


def test_numbers_that_no_joystick_has_are_refused_unless_the_file_insists(file: Path) -> None:
    for old, new, message in (
        ("a = 0.02398 ", "a = 24.1 ", "[geometry] a = 24.1: must be between 0.001 and 0.5 m"),
        ("J = 0.01135 ", "J = 11.35 ", "did you mean 11.35 g.m2 = 0.01135 kg.m2?"),
        ("pivot_to_top = 0.266 ", "pivot_to_top = 266 ", "did you mean 266 mm = 0.266 m?"),
        ("k = [430e3, 2625.0,", "k = [430e3, 2.625,", "[forward] k[1] = 2.625: must be between 10 and 1e+13"),
        ("C = 0.045 ", "C = 45 ", "[damping.constant] C = 45: must be between 1e-07 and 10 N.m.s/rad"),
        ("m = -0.26 ", "m = 26 ", "[damping.power-law] m = 26: must be between 0 and 5"),
    ):
        before = file.read_text(encoding="utf-8")
        change(file, (old, new))
        with pytest.raises(SettingsError) as refused:
            read_parameter_file(file)
        assert message in str(refused.value)
        assert "implausible = true above the tables accepts it" in str(refused.value)
        change(file, ("[body]", "implausible = true\n[body]"))
        read_parameter_file(file)
        file.write_text(before, encoding="utf-8")


@pytest.mark.parametrize(("name", "value"), [("J", 100.0), ("J", 1e-7), ("forward.returnSpring.k_h", 1e14)])
def test_what_a_study_writes_can_be_read(tmp_path: Path, name: str, value: float) -> None:
    for _ in range(2):
        write_parameters(tmp_path / "a.toml", NOMINAL.replace({name: value}))
        found = read_parameters(tmp_path / "a.toml")
        assert found.to_names()[name] == pytest.approx(value, rel=1e-3)


def test_the_travel_of_a_spring_set_by_its_name() -> None:
    with pytest.raises(ImplausibleError, match=r"did you mean 2\.93 mm = 0\.00293 m\?"):
        require_plausible("forward.balanceSpring.x_0", 2.93)
    for name, value in (("a", 0.0), ("a", float("nan")), ("J", -1.0), ("omega_start", 1e9)):
        require_plausible(name, value)  # refused for another reason, or not judged
