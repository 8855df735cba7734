"""The notebook display of each kind of result."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure

from pyjoystick.fmu import Final, Fmu
from pyjoystick.identification import CONSTANT_DAMPING, Uncertainty, fit, summary
from pyjoystick.laboratory import fit_load_curve, read_load_curve, synthetic_load_cycle, synthetic_record
from pyjoystick.model import FORWARD_TABLE, NOMINAL
from pyjoystick.motion import make_table, to_xarray
from pyjoystick.motion.tables import Quantity
from pyjoystick.reports import Findings, findings
from pyjoystick.runs import free_oscillation
from pyjoystick.support import MissingPackageError, plot_motion
from tests.pyjoystick.reports.html_report.reading import read_page


@pytest.fixture(scope="module")
def fmu(joystick_fmus: Path) -> Fmu:
    return Fmu(joystick_fmus / "Joystick.fmu")


def test_a_fit(fmu: Fmu) -> None:
    record = synthetic_record(NOMINAL, release_angle=-0.3, random=np.random.default_rng(1), name="<one>")
    found = fit(
        [record], dataclasses.replace(CONSTANT_DAMPING, uncertainty=Uncertainty(profiles=())), fmu=fmu
    )
    assert found.summary() == summary(found)
    assert len(found.plot().axes) == 1
    read = read_page(found._repr_html_())
    assert "damping.C" in read.cells
    assert "theta_start [<one>]" in read.cells
    assert len(read.images) == 1


def test_an_fmu(fmu: Fmu) -> None:
    text = fmu.summary()
    assert text.startswith("**PreloadedSprings.Joystick.Joystick**: ")
    for part in (
        "Joystick.fmu, FMI 2.0, ",
        "Inputs:",
        "Outputs:",
        "Parameters:",
    ):
        assert part in text
    assert {"T", "theta", "forward.returnSpring.k_h", "427375.0"} <= set(read_page(fmu._repr_html_()).cells)


def test_a_batch(fmu: Fmu) -> None:
    plan = fmu.plan([0.0, 0.1], varied="theta_start", outputs="theta")
    found = plan.run_batch([[0.1], [0.2]], reductions=[Final("theta")])
    assert "2 of 2 runs done, 0 failed." in found.summary()
    read = read_page(found._repr_html_())
    assert read.cells[:5] == ["result", "smallest", "mean", "largest", "unit"]
    assert read.cells[-1] == "rad"
    assert "2 of 2" in plan.run_batch([[0.1], [0.2]]).summary()


def test_a_load_curve(tmp_path: Path) -> None:
    travel, force = synthetic_load_cycle(FORWARD_TABLE, random=np.random.default_rng(1), step=1e-5)
    table = pd.DataFrame({"travel (mm)": 1e3 * travel, "force (N)": force})
    table.to_csv(tmp_path / "curve.csv", index=False)
    found = fit_load_curve(read_load_curve(tmp_path / "curve.csv"))
    read = read_page(found._repr_html_())
    assert "returnSpring.F_0" in read.cells
    assert len(read.images) == 1


def test_claims_are_a_mapping_that_shows_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pyjoystick.reports.claims.document.CHAPTERS", {})
    assert isinstance(findings(), Findings)
    assert findings() == {}
    html = findings()._repr_html_()
    assert html.startswith("<h1>The paper")
    assert "!--" not in html


def test_the_motion_of_one_run(fmu: Fmu) -> None:
    run = free_oscillation(-0.3, fmu=fmu)
    figure = plot_motion(run, title="one")
    assert isinstance(figure, Figure)
    assert [len(axes.lines) for axes in figure.axes] == [2, 2, 2]  # with the line at zero
    assert figure.legends == []


def test_a_table_as_a_dataset() -> None:
    xarray = pytest.importorskip("xarray", reason="needs xarray")
    quantities = [Quantity("theta", "rad", None, "angle"), Quantity("n")]
    found = to_xarray(make_table([0.0, 0.5], {"theta": [0.1, 0.2], "n": [1, 2]}, quantities))
    assert isinstance(found, xarray.Dataset)
    assert found["theta"].attrs == {"units": "rad", "long_name": "angle"}
    assert found["n"].attrs == {}
    assert found["time"].attrs == {"units": "s"}
    assert float(found["theta"].sel(time=0.5)) == 0.2


def test_without_xarray_there_is_one_line_to_install_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "xarray", None)
    with pytest.raises(MissingPackageError, match=r"pip install 'pyjoystick\[xarray\]'"):
        to_xarray(make_table([0.0, 1.0], {"x": [1.0, 2.0]}, [Quantity("x")]))
