"""What importers may set: parameters, inputs of every type; what is fixed in the code."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from fmpy import read_model_description, simulate_fmu

from fmu_build import build_fmu
from pyjoystick import Fmu
from tests.shared_fmus import SharedFmus

MODELS = Path(__file__).parent


def library(model: str) -> Path:
    return MODELS / f"{model.partition('.')[0]}.mo"


@pytest.mark.parametrize(
    ("model", "parameter"),
    [
        ("Sampling.SampledAlgorithm", "T"),
        ("Arrays.Heat", "n"),
        ("Components.Conditional", "stiffened"),
        ("Components.Chain", "n"),
    ],
)
def test_what_the_compiler_has_used_up_cannot_be_set(
    model: str, parameter: str, shared_fmus: SharedFmus
) -> None:
    """A sample period, an array size, the condition of a component: another value would be ignored."""
    path = shared_fmus.unpacked(model, library(model))
    variables = {variable.name: variable for variable in read_model_description(path).modelVariables}
    assert variables[parameter].variability == "constant"
    assert variables[parameter].causality == "local"


@pytest.mark.parametrize(
    ("model", "parameter"),
    [
        ("Components.GearBox", "ratio"),
        ("Components.GearBox", "braked"),
        ("Components.GearBox", "selected"),
        ("Components.Chain", "body[2].m"),
        ("TimeEvents.Steps", "t_1"),
        ("Arrays.Table", "x_i[2]"),
    ],
)
def test_what_stays_a_parameter(model: str, parameter: str, shared_fmus: SharedFmus) -> None:
    path = shared_fmus.unpacked(model, library(model))
    variables = {variable.name: variable for variable in read_model_description(path).modelVariables}
    assert variables[parameter].causality == "parameter"
    assert variables[parameter].variability in {"fixed", "tunable"}


def test_an_element_that_no_modifier_sets_alone_is_a_constant(tmp_path: Path) -> None:
    """The first element of k is computed from p: a modifier for the array would replace it, too."""
    file = tmp_path / "M.mo"
    part = "model Part parameter Real k = 1; Real y = k*time; end Part;"
    file.write_text(f"model M {part} parameter Real p = 2; Part parts[2](k = {{3*p, 0.5}}); end M;")
    with Fmu(build_fmu("M", tmp_path, library=file).path) as fmu:
        variables = fmu.description.variables
        table = fmu.run([0.0, 1.0], parameters={"p": 4.0}, outputs=["parts[1].y", "parts[2].y"])
    assert variables["parts[1].k"].causality == "calculatedParameter"
    assert variables["parts[2].k"].causality == "local"
    assert list(table.iloc[-1]) == [12.0, 0.5]


_RECORD = "record R Real a = 1; Real b = a; end R; model A parameter R r; Real y = r.a + 10*r.b; end A; "


@pytest.mark.parametrize(
    ("declaration", "given", "value"),
    [
        ("A d(r = R(5, 6));", {}, 65.0),
        ("A d(r = R(5, 6));", {"d.r.a": 8.0}, 68.0),
        ("A d(r = R(5, 5));", {"d.r.a": 8.0}, 58.0),
        ("A d(r(a = 5, b = 5));", {"d.r.a": 8.0}, 58.0),
        ("A d(r = R(5));", {"d.r.a": 8.0}, 88.0),
        ("A d(r(a = 5));", {"d.r.a": 8.0}, 88.0),
        ("parameter R q(a = 5, b = 6); A d(r = q);", {}, 65.0),
        ("record Q extends R(a = 5, b = 6); end Q; A d(r = Q());", {}, 65.0),
    ],
)
def test_a_member_with_a_value_of_its_own_follows_no_other(
    declaration: str, given: dict[str, float], value: float, tmp_path: Path
) -> None:
    """By default b follows a, and so it does where the trials set a alone by a modifier."""
    file = tmp_path / "P.mo"
    file.write_text(f"package P {_RECORD} model M {declaration} end M; end P;")
    with Fmu(build_fmu("P.M", tmp_path, library=file).path) as fmu:
        table = fmu.run([0.0, 1.0], parameters=given, outputs=["d.y"])
    assert list(table["d.y"]) == [value, value]


@pytest.mark.parametrize(("name", "value"), [("d.r.a", 8.0), ("d.r.b", 9.0), ("e.r.a", 7.0)])
def test_a_member_leads_what_is_bound_to_it_and_nothing_else(name: str, value: float, tmp_path: Path) -> None:
    parts = "model H parameter Real J = 1; Real y = J; end H; "
    user = "model B extends A; H h(J = r.a); end B; model M B d(r = R(5, 6)); B e(r(a = 3)); end M; "
    file = tmp_path / "P.mo"
    file.write_text(f"package P {_RECORD}{parts}{user}end P;")
    with Fmu(build_fmu("P.M", tmp_path, library=file).path) as fmu:
        row = fmu.run([0.0, 1.0], parameters={name: value}, outputs=["d.y", "d.h.y", "e.y", "e.h.y"]).iloc[-1]
    a, b, own = ({"d.r.a": 5.0, "d.r.b": 6.0, "e.r.a": 3.0} | {name: value}).values()
    assert list(row) == [a + 10 * b, a, 11 * own, own]


def test_names_with_escapes(tmp_path: Path) -> None:
    """Quoted identifiers with an apostrophe and a backslash, a description with what looks like escapes."""
    file = tmp_path / "M.mo"
    file.write_text(r"""model M Real 'it\'s' = 2 "a \\0 'b' \\u{41}"; Real '\\' = 2*'it\'s'; end M;""")
    with Fmu(build_fmu("M", tmp_path, library=file).path) as fmu:
        variables = fmu.description.variables
        table = fmu.run([0.0, 1.0], outputs=[r"'it\'s'", r"'\\'"])
    assert variables[r"'it\'s'"].description == r"a \0 'b' \u{41}"
    assert list(table.iloc[-1]) == [2.0, 4.0]


def test_integer_and_boolean_inputs(shared_fmus: SharedFmus) -> None:
    """The gear goes from 1 to 3 at t = 1, and into reverse at t = 2."""
    path = shared_fmus.unpacked("Oscillators.DiscreteInputs", library("Oscillators"))
    signals = np.array(
        [(0.0, 1, False), (1.0, 1, False), (1.0, 3, False), (2.0, 3, False), (2.0, 3, True), (3.0, 3, True)],
        dtype=[("time", float), ("gear", int), ("reverse", bool)],
    )
    result = simulate_fmu(
        path,
        fmi_type="CoSimulation",
        stop_time=3.0,
        output_interval=0.25,
        input=signals,
        output=["speed", "doubled", "forward"],
    )
    t = result["time"]
    speed = np.where(t <= 1, t, np.where(t <= 2, 1 + 3 * (t - 1), 4 - 3 * (t - 2)))
    np.testing.assert_allclose(result["speed"], speed, atol=1e-12)
    settled = (np.abs(t - 1) > 0.1) & (np.abs(t - 2) > 0.1)
    np.testing.assert_array_equal(result["doubled"][settled], np.where(t[settled] < 1, 2, 6))
    np.testing.assert_array_equal(result["forward"][settled], t[settled] < 2)


def test_protected_variables_are_listed_if_their_declaration_asks_for_it(tmp_path: Path) -> None:
    """HideResult = false, as in the members of a signal bus; of parameters, it does not make public ones."""
    source = """
    model Shown
      connector Bus Real used annotation (HideResult=false); Real other; end Bus;
      Real x(start=1, fixed=true);
    protected
      parameter Real p = 2 annotation (HideResult=false);
      Real plain = 4*x "annotation (HideResult=false)";
      Real hidden = 4*x annotation (HideResult=true), shown(start=max({0, 1})) = 5*x
        "shown; ü" annotation (Dialog(enable=true), HideResult = false), last = 6*x;
      Bus bus;
    equation
      der(x) = -p*x;
      bus.used = 7*x;
      bus.other = 8*x;
    end Shown;
    """
    (tmp_path / "Shown.mo").write_text(source, "utf-8")
    path = build_fmu("Shown", tmp_path, library=tmp_path / "Shown.mo").path
    listed = {v.name for v in read_model_description(str(path)).modelVariables}
    assert listed == {"time", "x", "der(x)", "shown", "bus.used"}
    with Fmu(path) as fmu:
        row = fmu.run([0.0, 0.1], outputs=["shown", "bus.used"]).iloc[0]
    assert (row["shown"], row["bus.used"]) == (5.0, 7.0)
