"""The page in a notebook: values and results are traits in both directions; a plain page simulates it."""

from __future__ import annotations

import base64
import math
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from playwright.sync_api import Browser, FrameLocator, Page, expect

import pyjoystick
from pyjoystick.fmu import Fmu
from pyjoystick.identification import guess_release
from pyjoystick.model import NOMINAL, NOMINAL_POWER_LAW, PAPER
from pyjoystick.motion import read_record
from pyjoystick.reports.live_page.widget import JoystickWidget
from pyjoystick.support import MissingPackageError, ParameterError, UnknownParameterError

_RECORD = Path(__file__).parents[4] / "scenarios" / "data" / "synthetic_constant_1.csv"
_ADDRESS = "http://notebook.test/"
#: What anywidget gives to its scripts: https://anywidget.dev/en/afm/.
_MODEL = """async ([script, state]) => {
  const listeners = new Map();
  const unsaved = new Map();
  window.model = {
    get: name => state[name],
    set: (name, value) => { state[name] = value; unsaved.set(name, value); },
    on: (event, listener) => listeners.set(event, listener),
    off: event => listeners.delete(event),
    save_changes() {
      const text = bytes => btoa(bytes.reduce((before, byte) => before + String.fromCharCode(byte), ""));
      const plain = value => value instanceof DataView ? text(new Uint8Array(value.buffer)) : value;
      saved(Object.fromEntries([...unsaved].map(([name, value]) => [name, plain(value)])));
      unsaved.clear();
    },
    changed(name, value) { state[name] = value; listeners.get(`change:${name}`)?.(); },
  };
  const url = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
  window.end = (await import(url)).default.render({ model, el: document.body });
}"""


class Notebook:
    """A page that shows widgets, each with its own Python object as in a notebook."""

    def __init__(self, page: Page, widget: JoystickWidget) -> None:
        self.page, self.widget = page, widget
        self.errors: list[str] = []
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.route(_ADDRESS, lambda route: route.fulfill(body="<!DOCTYPE html>", content_type="text/html"))
        page.goto(_ADDRESS)
        page.expose_function("saved", self._saved)
        names = ("_page", "_start", "values", "height")
        page.evaluate(_MODEL, [widget._esm, {name: getattr(widget, name) for name in names}])
        self.wait(lambda: len(widget.results) > 0)

    def _saved(self, traits: dict[str, Any]) -> None:
        table = memoryview(base64.b64decode(traits.pop("_table")))
        data = {"method": "update", "state": traits, "buffer_paths": [["_table"]]}
        self.widget._handle_msg({"content": {"data": data}, "buffers": [table]})  # as a kernel does

    @property
    def frame(self) -> FrameLocator:
        """The live page."""
        return self.page.frame_locator("iframe")

    def assign(self, **values: float) -> None:
        """Assign values in Python."""
        self.widget.values = values
        self.page.evaluate("values => model.changed('values', values)", self.widget.values)

    def wait(self, until: Callable[[], bool]) -> None:
        """Wait until something holds of the widget."""
        for _ in range(400):
            if until():
                return
            self.page.wait_for_timeout(25)
        pytest.fail("the page did not tell it")


Show = Callable[[JoystickWidget], Notebook]


@pytest.fixture
def show(browser: Browser) -> Iterator[Show]:
    """Show widgets; the pages must not have failed."""
    shown: list[Notebook] = []

    def one(widget: JoystickWidget) -> Notebook:
        shown.append(Notebook(browser.new_page(), widget))
        return shown[-1]

    yield one
    for notebook in shown:
        notebook.page.close()
        assert notebook.errors == []


@pytest.fixture(autouse=True)
def _fmus_with_modules(fmus: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in ("pyjoystick.fmu.files", "pyjoystick.fmu"):
        monkeypatch.setattr(f"{module}.build_folder", lambda: fmus)


def _damping(widget: JoystickWidget) -> float:
    """The damping of the run: M_d = C*omega."""
    row = widget.results.iloc[100]
    return round(float(row["M_d"] / row["omega"]), 12)


def _assert_run(notebook: Notebook, fmus: Path, law: str = "") -> None:
    """The results are the FMU's run with the values."""
    results, values = notebook.widget.results, dict(notebook.widget.values)
    with Fmu(fmus / f"HeldJoystick{law}.fmu") as fmu:
        inputs = {name: values.pop(name) for name in fmu.description.names("input")}
        time, names = results.index.to_numpy(), list(results.columns)
        expected = fmu.run(time, parameters=values, inputs=inputs, outputs=names)
    np.testing.assert_allclose(results.to_numpy(), expected.to_numpy(), rtol=1e-9, atol=1e-9)


def test_values_and_results_follow_the_page(show: Show, fmus: Path) -> None:
    widget = pyjoystick.explore(NOMINAL.replace({"m": 0.9}), release_angle=math.radians(-15.0))
    assert widget.values["m"] == 0.9
    notebook = show(widget)
    _assert_run(notebook, fmus)
    seen: list[float] = []
    widget.observe(lambda change: seen.append(change["new"]["damping.C"]), "values")
    field = notebook.frame.locator('.control[data-name="damping.C"] input.number')
    field.fill("0.08")
    notebook.wait(lambda: bool(seen) and _damping(widget) == 0.08)
    assert seen[-1] == 0.08
    assert widget.joystick == NOMINAL.replace({"m": 0.9, "damping.C": 0.08})
    assert widget.results.attrs["units"]["theta"] == "rad"
    _assert_run(notebook, fmus)


def test_the_page_follows_values_that_are_assigned(show: Show, fmus: Path) -> None:
    notebook = show(pyjoystick.explore(NOMINAL_POWER_LAW))
    notebook.assign(theta_start=math.radians(10.0))
    notebook.wait(lambda: bool(notebook.widget.results["theta"].iloc[0] > 0.17))
    field = notebook.frame.locator('.control[data-name="theta_start"] input.number')
    assert field.input_value() == "10"
    _assert_run(notebook, fmus, "PowerLaw")


def test_values_from_before_the_page_is_shown(show: Show) -> None:
    widget = pyjoystick.explore(PAPER)
    widget.values = {"damping.C": 0.07}
    notebook = show(widget)
    notebook.wait(lambda: _damping(widget) == 0.07)


def test_a_record_sets_the_release(show: Show) -> None:
    record = read_record(_RECORD)
    notebook = show(pyjoystick.explore(records=[record]))
    notebook.wait(lambda: abs(notebook.widget.values["theta_start"]) < 0.349)
    release = guess_release(record.time, record.theta)
    assert notebook.widget.values["theta_start"] == pytest.approx(release.angle, abs=1e-6)


def test_what_the_model_refuses_is_told(show: Show) -> None:
    notebook = show(pyjoystick.explore())
    notebook.assign(J=-1.0)
    notebook.wait(lambda: 'Variable "J" cannot be -1' in notebook.widget.message)
    notebook.assign(J=0.02)
    notebook.wait(lambda: notebook.widget.message == "")


def test_nothing_is_told_after_the_cell_is_cleared(show: Show) -> None:
    notebook = show(pyjoystick.explore())
    notebook.page.evaluate("end()")
    before = notebook.widget.values
    body = notebook.frame.locator("body")
    runs = str(body.get_attribute("data-runs"))
    notebook.frame.locator('.control[data-name="damping.C"] input.number').fill("0.08")
    expect(body).not_to_have_attribute("data-runs", runs)
    notebook.page.wait_for_timeout(300)  # the page would tell it after 200 ms
    assert notebook.widget.values == before


@pytest.mark.parametrize(
    ("values", "error"),
    [
        ({"mass": 1.0}, UnknownParameterError),
        ({"m": math.nan}, ParameterError),
        ({"m": "heavy"}, ParameterError),
    ],
)
def test_faults(values: dict[str, Any], error: type[Exception]) -> None:
    widget = pyjoystick.explore()
    with pytest.raises(error, match="m"):
        widget.values = values
    assert widget.values["m"] == NOMINAL.m


def test_faults_of_the_arguments() -> None:
    with pytest.raises(ParameterError, match="release_angle"):
        pyjoystick.explore(release_angle=2.0)
    with pytest.raises(ParameterError, match="height"):
        pyjoystick.explore(height=0)


def test_without_anywidget(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyjoystick.reports.live_page.widget", None)
    with pytest.raises(MissingPackageError, match=r"pip install 'pyjoystick\[notebook\]'"):
        pyjoystick.explore()
