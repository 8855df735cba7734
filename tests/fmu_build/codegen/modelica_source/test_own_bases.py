"""Models that extend their own encapsulated class, like the MSL's mass with stops and friction."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fmu_build import build_fmu
from fmu_build.codegen.modelica_source.own_bases import with_bases_beside
from pyjoystick.fmu import Fmu

_PACKAGE = """package Bodies
  partial model Body
    Real x(start = 2, fixed = true);
  end Body;
end Bodies;
"""
_MODEL = """within Bodies;
model Decaying "Begins with what it extends"
  extends Base(k = 3);
  Real twice = 2*x;
  encapsulated partial model Base "Base, as its name says"
    import Bodies.Body;
    parameter Real k = 1;
    extends Body;
  equation
    der(x) = -k*x;
  end Base;
end Decaying;
"""
_USER = """model User
  Bodies.Decaying body;
  annotation (uses(Bodies(version = "1")));
end User;
"""


def test_the_motion_of_such_a_model(tmp_path: Path) -> None:
    library = tmp_path / "Bodies"
    library.mkdir()
    (library / "package.mo").write_text(_PACKAGE)
    (library / "Decaying.mo").write_text(_MODEL)
    (tmp_path / "User.mo").write_text(_USER)
    built = build_fmu("User", tmp_path / "out", library=[tmp_path / "User.mo", library])
    with Fmu(built.path) as fmu:
        result = fmu.run([0.0, 0.5, 1.0], parameters={"body.k": 2.0}, outputs=["body.twice"])
    np.testing.assert_allclose(result["body.twice"], 4 * np.exp([0.0, -1.0, -2.0]), rtol=1e-7)


def test_all_else_keeps_its_line() -> None:
    changed = with_bases_beside({Path("Decaying.mo"): _MODEL})[Path("Decaying.mo")]
    lines = _MODEL.splitlines()
    assert changed.splitlines()[:4] == [*lines[:2], "  extends Decaying_Base(k = 3);", lines[3]]
    assert changed.splitlines()[11].startswith("end Decaying; encapsulated partial model Decaying_Base")


def test_a_base_whose_name_is_part_of_other_words() -> None:
    model = _MODEL.replace("Base", "del").replace("partial model del", "partial model /* del */ del")
    changed = with_bases_beside({Path("Decaying.mo"): model})[Path("Decaying.mo")]
    assert "encapsulated partial model /* del */ Decaying_del " in changed
    assert changed.rstrip().endswith("end Decaying_del;")


@pytest.mark.parametrize(
    "texts",
    [
        [_MODEL.replace("encapsulated ", "")],
        [_MODEL.replace("extends Base(k = 3);", "Base base(k = 3);").replace("partial ", "")],
        [_MODEL, "model Other extends Bodies.Decaying.Base; end Other;"],
        [_MODEL.replace("encapsulated partial", "/* encapsulated */ partial")],
        [_MODEL.replace("Base", "'Base[1'")],
    ],
    ids=["not encapsulated", "a component", "named from outside", "in a comment", "a quoted name"],
)
def test_other_classes_stay(texts: list[str]) -> None:
    files = {Path(f"{number}.mo"): text for number, text in enumerate(texts)}
    assert with_bases_beside(files) == files
