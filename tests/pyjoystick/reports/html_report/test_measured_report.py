"""A report on a measured joystick separates measured values, to their known digits, from computed ones."""

from __future__ import annotations

import dataclasses
import json
import math
import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from pyjoystick.cli import main
from pyjoystick.fmu import Fmu
from pyjoystick.identification import (
    CONSTANT_DAMPING,
    BudgetDocument,
    Contribution,
    FittedValue,
    Free,
    Uncertainty,
    as_json,
    fit,
    fitted_joystick,
    read_fit,
    with_values,
)
from pyjoystick.laboratory import (
    Estimate,
    fit_load_curve,
    period_of_record,
    read_load_curve,
    synthetic_load_cycle,
    synthetic_record,
    synthetic_swing,
)
from pyjoystick.model import FORWARD_TABLE, NOMINAL, read_parameter_file, write_parameters
from pyjoystick.reports import Measurements, Study, joystick_report, read_measurements
from pyjoystick.reports.html_report.known_digits import with_uncertainty
from pyjoystick.reports.html_report.measured_parameters import parameter_section
from pyjoystick.reports.html_report.measured_sections import SECTIONS as MEASURED_SECTIONS
from pyjoystick.reports.html_report.measurements import SwingTest, moved_joysticks
from pyjoystick.reports.html_report.sections import SECTIONS
from pyjoystick.support import InputFileError, ParameterError
from tests.pyjoystick.reports.html_report.reading import read_page


@dataclasses.dataclass(frozen=True)
class Bench:
    folder: Path
    fmu: Fmu

    @property
    def parameters(self) -> Path:
        return self.folder / "joystick.toml"

    def study(self) -> Study:
        return Study(read_parameter_file(self.parameters).joystick, self.fmu, math.radians(-20.0), None)


@pytest.fixture(scope="module")
def bench(tmp_path_factory: pytest.TempPathFactory, joystick_fmus: Path) -> Iterator[Bench]:
    """A parameter file, the load-deflection curve and the fit that it came from."""
    folder, random = tmp_path_factory.mktemp("bench"), np.random.default_rng(3)
    travel, force = synthetic_load_cycle(FORWARD_TABLE, random=random, step=1e-5)
    np.savetxt(
        folder / "forward.csv",
        np.column_stack((1e3 * travel, force)),
        delimiter=",",
        header="travel (mm),force (N)",
        comments="",
    )
    curve = fit_load_curve(read_load_curve(folder / "forward.csv"))
    start = dataclasses.replace(NOMINAL, forward=curve.assembly)
    records = [
        synthetic_record(start, release_angle=math.radians(angle), random=random, name=f"release {angle}")
        for angle in (-20, 18)
    ]
    with Fmu(joystick_fmus / "Joystick.fmu") as fmu:
        free = (Free("damping.C"), *(Free(name, per_record=True) for name in ("theta_start", "release_time")))
        settings = dataclasses.replace(
            with_values(dataclasses.replace(CONSTANT_DAMPING, free=free), start.to_names()),
            uncertainty=Uncertainty(profiles=()),
        )
        found = fit(records, settings, fmu=fmu)
        (folder / "fit.json").write_text(as_json(found))
        fitted = fitted_joystick(found, start, {})
        errors = {f"forward.x[{i}]": float(one) for i, one in enumerate(curve.x_errors)}
        errors |= {f"forward.k[{i}]": float(one) for i, one in enumerate(curve.k_errors)}
        write_parameters(
            folder / "joystick.toml",
            fitted.joystick,
            uncertainties={**fitted.uncertainties, **errors, "body.m": 0.0013},
            sources={"body": "fit to something", "backward": "a drawing"},
        )
        yield Bench(folder, fmu)


@pytest.fixture(scope="module")
def page(bench: Bench, joystick_fmus: Path) -> str:
    with pytest.MonkeyPatch.context() as patch:
        for module in ("pyjoystick.fmu.files", "pyjoystick.fmu"):
            patch.setattr(f"{module}.build_folder", lambda: joystick_fmus)
        computed = {name: SECTIONS[name] for name in ("springs", "free oscillation")}  # the others take long
        patch.setattr("pyjoystick.reports.html_report.report.SECTIONS", computed)
        folder, target = bench.folder, bench.folder / "report.html"
        files = ["--fit", str(folder / "fit.json"), "--curve", f"forward={folder / 'forward.csv'}"]
        assert main(["report", "-p", str(bench.parameters), *files, "-o", str(target)]) == 0
    return target.read_text(encoding="utf-8")


def test_what_is_measured_and_what_is_computed_are_told_apart(page: str) -> None:
    read = read_page(page)
    titles = read.headings[1:]
    first = next(i for i, title in enumerate(titles) if title.startswith("Computed: "))
    assert titles[:first] == [
        "Parameters, and where they are from",
        "Records against the model",
        "Fit to the records",
        "What was not identified",
        "Load-deflection curves as measured",
    ]
    assert all(title.startswith("Computed: ") for title in titles[first:])
    assert "records (release -20, release 18), load-deflection curves (forward.csv)." in page
    assert read.outside == []
    assert "prefers-color-scheme: dark" in page
    assert "@media print" in page


def test_every_number_ends_where_its_uncertainty_does(bench: Bench, page: str) -> None:
    """Two digits of the uncertainty, and the value to that place; k_h too, by the errors of the curve."""
    curve = fit_load_curve(read_load_curve(bench.folder / "forward.csv"))
    read = read_page(page)
    k_h, error = curve.springs()["returnSpring.k_h"]
    place = 1 - math.floor(math.log10(error))
    assert place < 0
    row = read.cells[read.cells.index("return spring, k_h") :][:4]
    assert row == ["return spring, k_h", f"{round(k_h, place):.0f}", f"{round(error, place):.0f}", "N/m"]
    assert re.search(r"mass, m</th><td[^>]*>0\.8700</td><td[^>]*>0\.0013</td>", page)
    assert re.search(
        r"moment of inertia about the pivot, J</th><td[^>]*>0\.01135</td><td[^>]*>not stated<", page
    )


def test_each_number_says_where_it_is_from(page: str) -> None:
    """The file has one source for a table: what the fit did not find is not from the fit."""
    rows = dict(re.findall(r'<th scope="row">([^<]*)</th>(?:<td[^<]*</td>){3}<td>([^<]*)</td>', page))
    assert rows["damping coefficient, C"] == "fit to release -20, release 18"
    assert rows["mass, m"] == "not from the fit; the file names no other source"
    assert rows["pivot to the top of the handle"] == "Rogers et al. (2004), Table 2"
    assert "it stands for. From: load-deflection curve, forward.csv." in page
    assert "it stands for. From: a drawing." in page
    assert "No uncertainty is stated in joystick.toml for" in page
    assert "Not given to this report: load-deflection curves, a swing test, an error budget." in page


def test_the_bands_hold_as_many_samples_as_they_say(bench: Bench) -> None:
    """With the noise known: 95 % of 212 samples, give or take three standard deviations."""
    found = read_fit(bench.folder / "fit.json")
    inside, count = 0, 0
    for one in found.series:
        assert one.errors is not None
        inside += int(np.sum(np.abs(one.residuals) <= found.quantile * np.hypot(one.sigma, one.errors)))
        count += len(one.data)
    assert abs(inside / count - 0.95) < 3.0 * math.sqrt(0.95 * 0.05 / count)


def test_the_uncertainty_of_the_motion_is_that_of_its_parameters(bench: Bench) -> None:
    """At the hold it is that of the angle of release, and it is small beside the noise everywhere."""
    found = read_fit(bench.folder / "fit.json")
    for one in found.series:
        assert one.errors is not None
        start = next(v for v in found.values if (v.name, v.record) == ("theta_start", one.record))
        assert one.errors[0] == pytest.approx(start.error, rel=1e-3)
        assert np.all(one.errors < one.sigma)
        assert np.max(one.errors) > 1.5 * start.error


def test_computed_numbers_have_the_digits_that_the_parameters_leave(bench: Bench) -> None:
    """With a mass known to a percent, a peak's angle is known to less than the thousandth of a degree."""
    file = read_parameter_file(bench.parameters)
    vague = dataclasses.replace(file, uncertainties={**file.uncertainties, "body.J": 0.02 * file.joystick.J})
    texts = []
    for one in (file, vague):
        moved = tuple(moved_joysticks(Measurements(file=one), file.joystick))
        section = SECTIONS["free oscillation"](dataclasses.replace(bench.study(), moved=moved))
        texts.append("".join(section.parts))
    times = [re.findall(r'<th scope="row">1</th><td class="number">([^<]*)</td>', text)[0] for text in texts]
    assert times[1] == f"{float(times[0]):.4f}"
    assert len(times[1]) < len(times[0])
    assert "to the digits that the uncertainties of the parameters leave" in texts[1]


@pytest.mark.parametrize(
    ("value", "uncertainty", "factor", "expected"),
    [
        (641924.17, 3500.0, 1.0, ("641900", "3500")),
        (0.0118219, 1.5e-5, 1.0, ("0.011822", "0.000015")),
        (0.0024, 0.0000996, 1e3, ("2.40", "0.10")),
        (-12.345, 0.951, 1.0, ("-12.35", "0.95")),
        (9.80665, None, 1.0, ("9.80665", "not stated")),
        (0.1 + 0.2, 0.0, 1.0, ("0.3", "not stated")),
        (641924.17321, None, 1.0, ("6.419e+05", "not stated")),
        (1.0, math.inf, 1.0, ("not determined", "")),
    ],
)
def test_known_digits(
    value: float, uncertainty: float | None, factor: float, expected: tuple[str, str]
) -> None:
    assert with_uncertainty(value, uncertainty, factor) == expected


def test_files_of_another_joystick_are_refused(bench: Bench, tmp_path: Path) -> None:
    file = read_parameter_file(bench.parameters)
    other = tmp_path / "other.toml"
    write_parameters(other, file.joystick.replace({"damping.C": 0.06, "forward.returnSpring.k_s": 2700.0}))
    for settings, message in (
        ({"fit": bench.folder / "fit.json"}, r"fit.json: other.toml does not come from it: damping.C = 0.06"),
        (
            {"curves": {"forward": bench.folder / "forward.csv"}},
            r"forward.csv: other.toml does not come from it",
        ),
    ):
        with pytest.raises(InputFileError, match=message):
            read_measurements(read_parameter_file(other), **settings)  # type: ignore[arg-type]
    found = read_measurements(file, fit=bench.folder / "fit.json")
    changed = dataclasses.replace(bench.study(), joystick=file.joystick.replace({"J": 0.012}))
    with pytest.raises(ParameterError, match="measurements"):
        joystick_report(changed, measurements=found)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("nonsense", "is not JSON"),
        ("[]", "is no fit.json of pyjoystick fit"),
        (json.dumps({"settings": {}}), "is no fit.json of pyjoystick fit.*'uncertainty' is missing"),
    ],
)
def test_what_is_no_fit_is_refused(bench: Bench, tmp_path: Path, content: str, message: str) -> None:
    path = tmp_path / "fit.json"
    path.write_text(content)
    with pytest.raises(InputFileError, match=message):
        read_measurements(read_parameter_file(bench.parameters), fit=path)


def test_a_measurement_that_the_fit_contradicts_is_named_where_the_fit_is(bench: Bench) -> None:
    """And where the swing test is; a J of the report's own is not compared with itself."""
    file = read_parameter_file(bench.parameters)
    record = synthetic_swing(NOMINAL, amplitude=0.1, random=np.random.default_rng(5))
    period = period_of_record(record)

    def measured(inertia: float, error: float) -> Measurements:
        swing = SwingTest(
            source="swing.csv",
            record=record,
            period=period,
            inertia=Estimate(inertia, error, math.inf, {"T": error}),
        )
        fit = read_fit(bench.folder / "fit.json")
        free = FittedValue(
            name="J",
            record="",
            unit="kg.m2",
            value=NOMINAL.J,
            error=1e-6,
            interval=(NOMINAL.J - 2e-6, NOMINAL.J + 2e-6),
            is_determined=True,
        )
        known = dataclasses.replace(file, uncertainties={**file.uncertainties, "body.J": 3e-5})
        return Measurements(file=known, fit=dataclasses.replace(fit, values=(*fit.values, free)), swing=swing)

    off = measured(NOMINAL.J - 2e-4, 4e-5)
    text = "".join(MEASURED_SECTIONS["fit"][0](off).parts)
    assert "contradicts 0.01115 +- 4e-05 of the swing test swing.csv: 4.0 combined" in text
    assert "Check the clock of the records, the scale of their angle and h." in text
    swing = "".join(MEASURED_SECTIONS["swing test"][0](off).parts)
    assert "the two differ by 4.0 combined standard uncertainties." in swing
    near = measured(NOMINAL.J, 4e-5)
    assert "contradicts" not in "".join(MEASURED_SECTIONS["fit"][0](near).parts)
    assert "It is the J of this report." in "".join(MEASURED_SECTIONS["swing test"][0](near).parts)


def test_the_budget_has_rows_with_numbers_and_says_what_is_exact(bench: Bench) -> None:
    rows = (Contribution("zero, noise at rest", theta=1e-4), Contribution("m +- 0.001", J=1e-3, C=2e-3))
    budget = BudgetDocument(source="budget.json", fitted={}, contributions=rows, exact=("b", "time base"))
    found = Measurements(file=read_parameter_file(bench.parameters), budget=budget)
    text = "".join(MEASURED_SECTIONS["error budget"][0](found).parts)
    assert "zero, noise" not in text
    assert "m +- 0.001" in text
    assert "Taken as exact, because no uncertainty was given: b, time base." in text


def test_without_the_curve_uncertainties_of_springs_are_said_to_be_bounds(bench: Bench, page: str) -> None:
    """The file has no correlations of x and k, without which they may be hundreds of times too large."""
    file = read_parameter_file(bench.parameters)
    without = "".join(parameter_section(read_measurements(file)).parts)
    assert "upper bounds: the file does not contain the correlations of x and k" in without
    assert "upper bounds" not in page


@pytest.mark.parametrize(("factor", "is_same"), [(1.0, True), (1.04, True), (3.0, False)])
def test_a_budget_whose_uncertainty_was_not_saved_is_refused(
    factor: float, is_same: bool, bench: Bench, tmp_path: Path
) -> None:
    file = read_parameter_file(bench.parameters)
    value, error = file.joystick.to_names()["damping.C"], file.uncertainties["damping.constant.C"]
    one = {"name": "damping.C", "value": value, "standard_uncertainty": factor * error}
    budget = tmp_path / "budget.json"
    budget.write_text(json.dumps({"parameters": [one], "contributions": [], "exact": []}), encoding="utf-8")
    if is_same:
        assert read_measurements(file, budget=budget).budget is not None
    else:
        with pytest.raises(InputFileError, match=r"u_damping\.C = .*`pyjoystick budget --update`"):
            read_measurements(file, budget=budget)
