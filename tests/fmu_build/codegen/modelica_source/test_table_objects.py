"""Table objects of components, as friction elements of MSL 4.1 have them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from fmu_build import build_fmu
from fmu_build.codegen.modelica_source.table_objects import without_table_objects
from pyjoystick.fmu import Fmu

_FOLDER = Path(__file__).with_name("tables")
_MODEL, _LIBRARY = _FOLDER / "Rubbing.mo", _FOLDER / "library" / "Modelica.mo"


def test_a_component_with_a_table_object(tmp_path: Path) -> None:
    """Through (0, a) and (2, 3): w' = a/2 - a - w*(3 - a)/2, also with another a in the FMU."""
    times = np.linspace(0.0, 2.0, 5)
    with Fmu(build_fmu("Rubbing", tmp_path, library=[_MODEL, _LIBRARY]).path) as fmu:
        for a in (1.0, 2.0):
            run = fmu.run(times, parameters={"tau_pos[1,2]": a}, outputs=["w", "half"], tolerance=1e-9)
            rate = (3.0 - a) / 2.0
            rest = -a / 2.0 / rate
            np.testing.assert_allclose(run["w"], rest + (5.0 - rest) * np.exp(-rate * times), atol=1e-7)
            assert (run["half"] == a / 2.0).all()


def test_all_else_keeps_its_line() -> None:
    before = _MODEL.read_text("utf-8").splitlines()
    after = without_table_objects("\n".join(before)).splitlines()
    assert len(after) == len(before)
    changed = [number for number, (old, new) in enumerate(zip(before, after, strict=True)) if old != new]
    assert 4 <= min(changed) <= max(changed) <= len(before) - 2
    assert not any("tableID," in line or "ExternalCombiTable1D(" in line for line in after)


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ('fileName="NoName"', 'fileName="torques.txt"'),
        ("der(w) =", "der(w) = getTable1DAbscissaUmax(tableID) +"),
        ("    columns={2},\n", ""),
    ],
    ids=["of a file", "its range is asked for", "without columns"],
)
def test_other_objects_stay(old: str, new: str) -> None:
    text = _MODEL.read_text("utf-8")
    assert old in text
    text = text.replace(old, new)
    assert without_table_objects(text) == text
