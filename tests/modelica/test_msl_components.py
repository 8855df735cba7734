"""The springs with MSL flanges, tested without MSL: a stand-in provides the few base classes."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
import rumoca

from tests.modelica.library import MSL_ROOT, library_classes
from tests.modelica.physics import TABLE_1, Array, table_force

STAND_IN = Path(__file__).parent / "stand_in" / "Modelica.mo"
COMPONENTS = [c for c in library_classes(MSL_ROOT) if c.name.startswith("Components.")]


@pytest.fixture(autouse=True)
def _no_msl(monkeypatch: pytest.MonkeyPatch) -> None:
    """Hide an installed library, whose classes rumoca would take for a second definition."""
    monkeypatch.delenv("MODELICAPATH", raising=False)


def _session() -> rumoca.Session:
    """A session with the stand-in and the components, without the examples, which need more of MSL."""
    session = rumoca.Session()
    packages = [c for c in library_classes(MSL_ROOT) if c.name in ("", "Components")]
    files = [
        STAND_IN,
        *(c.file for c in sorted(packages, key=lambda c: c.name)),
        *(c.file for c in COMPONENTS),
    ]
    for file in files:
        with pytest.raises(rumoca.CompileError):  # it keeps the text all the same, and reads none beside it
            session.loads(file.read_text(), model="None_", filename=f"part:{file}")
    return session


def _pulled(component: str) -> tuple[Array, Array, dict[str, Array]]:
    """Relative distance (m) from -4 to 4 mm, the force (N), and all else."""
    source = f"""model Bench
      model Jaw
        Modelica.Mechanics.Translational.Interfaces.Flange_b flange;
        input Real s;
      equation
        flange.s = s;
      end Jaw;
      Jaw a(s = 0);
      Jaw b(s = 8e-3*(time - 0.5));
      PreloadedSpringsMSL.Components.{component};
    equation
      connect(a.flange, c.flange_a);
      connect(c.flange_b, b.flange);
    end Bench;"""
    model = _session().loads(source, model="Bench")
    result = model.simulate(1.0, config=rumoca.SimConfig(rtol=1e-10, atol=1e-12, dt=1e-3))
    found = {name: np.asarray(result[name]) for name in result.names}
    return found["c.flange_b.s"], found["c.f"], found


def _spring(compression: Array, c: float, c_r: float, preload: float) -> Array:
    """Equations (7) and (8), as the smaller of the two."""
    pushed = np.maximum(compression, 0.0)
    return np.asarray(np.minimum((c + c_r) * pushed, preload + c * pushed))


def test_every_component_is_here() -> None:
    assert {c.name for c in COMPONENTS} == {
        f"Components.{name}" for name in ("PreloadedSpring", "ActuatorAssembly", "OpposingSprings")
    }


def test_a_spring_pushes_where_the_distance_is_short() -> None:
    s_rel, force, found = _pulled("PreloadedSpring c(c = 2000, c_r = 1e5, f_preload = 50, s_rel0 = 1e-3)")
    np.testing.assert_allclose(force, -_spring(1e-3 - s_rel, 2000.0, 1e5, 50.0), atol=1e-9)
    assert np.min(force) < -50.0
    np.testing.assert_allclose(found["c.flange_a.f"], -found["c.flange_b.f"], atol=0.0)


def test_an_actuator_is_table_1() -> None:
    s_rel, force, _ = _pulled("ActuatorAssembly c")
    np.testing.assert_allclose(force, -table_force(np.maximum(-s_rel, 0.0), *TABLE_1[1]), atol=1e-9)
    assert np.min(force) < -70.0


def test_opposing_springs_center() -> None:
    s_rel, force, _ = _pulled("OpposingSprings c(c = 2000, c_r = 4e5, f_preload = 40, clearance = 0.5e-3)")
    expected = np.sign(s_rel) * _spring(np.abs(s_rel) - 0.5e-3, 2000.0, 4e5, 40.0)
    np.testing.assert_allclose(force, expected, atol=1e-9)
    assert np.max(force) > 40.0 > -40.0 > np.min(force)
