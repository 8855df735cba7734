"""Fixtures shared by all tests."""

from __future__ import annotations

import os
import signal
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import fmpy
import pytest
from playwright.sync_api import Browser

from fmu_build import FmiVersion
from pyjoystick.fmu import MODELS, SENSITIVITIES
from tests import browser as browsers
from tests.omc import Omc, opened, why_not
from tests.shared_fmus import SharedFmus

ROOT = Path(__file__).parents[1]
#: What a release consists of, and what takes long to make: the wheel, the site, its pages carried out as
#: printed, the scenario scripts, binaries for other platforms, the runtime under sanitizers, benchmarks. A
#: change of the code alone seldom breaks these.
SHIPPED = (
    "benchmarks",
    "docs/test_live_page.py",
    "docs/test_pages.py::test_a_page_from_top_to_bottom",
    "docs/test_site.py",
    "fmu_build/packaging/test_binaries.py::test_a_stored_runtime_gives_the_same_library",
    "fmu_build/packaging/test_package.py::test_an_fmu_for_another_machine",
    "fmu_build/packaging/test_rebuild.py",
    "fmu_build/platforms",
    "fmu_build/runtime/test_sanitizers.py",
    "pyjoystick/reports/claims",
    "scenarios",
    "test_wheel.py",
    "test_your_joystick.py",
)
#: Studies with many joysticks, records, motions or processes. What they use has quicker tests of its own.
STUDIES = (
    "fmu_build/explore/test_numbers.py",
    "fmu_build/models/test_derivatives.py::test_so_are_those_of_other_times",
    "fuzz",
    "joystick_fmu/test_flange.py::test_co_simulation",
    "joystick_fmu/test_friction.py::test_a_push_by_time_alone_is_not_missed",
    "joystick_fmu/test_reuse.py",
    "joystick_fmu/test_sensitivities.py::test_random_joysticks",
    "pyjoystick/cli/test_export.py::test_an_exported_fmu_is_its_own_joystick_in_commands",
    "pyjoystick/cli/test_export.py::test_stops_of_an_exported_fmu",
    "pyjoystick/cli/test_response.py::test_branches_over_a_parameter",
    "pyjoystick/cli/test_response.py::test_the_motions_at_one_frequency",
    "pyjoystick/fmu/test_own_process.py::test_a_batch_survives_everything",
    "pyjoystick/forced_motion/periodic/test_continuation.py",
    "pyjoystick/forced_motion/response/test_attractors.py",
    "pyjoystick/identification/fitting/solution/test_search.py",
    "pyjoystick/identification/fitting/test_known_beforehand.py",
    "pyjoystick/identification/fitting/test_missing_physics.py",
    "pyjoystick/identification/fitting/test_order.py",
    "pyjoystick/identification/fitting/test_recovery.py",
    "pyjoystick/identification/fitting/test_selection.py",
    "pyjoystick/laboratory/inertia/test_decay.py::test_stated_errors",
    "pyjoystick/laboratory/inertia/test_swing.py::test_stated_intervals",
    "pyjoystick/laboratory/load_curve/test_fit.py::test_stated_errors",
    "pyjoystick/model/reference/test_accuracy.py",
    "pyjoystick/motion/test_record_peaks.py::test_the_standard_errors",
    "pyjoystick/reports/project/test_evaluating.py",
    "pyjoystick/reports/export/test_fmus.py::test_an_exported_fmu_is_the_joystick_of_the_file",
    "pyjoystick/reports/html_report/test_report.py",
    "pyjoystick/runs/coupling/test_master.py::test_the_system_as_one_model_is_the_equations",
    "pyjoystick/runs/fmu_comparison/test_reference.py::test_a_small_mistake_in_a_model_is_found",
    "pyjoystick/runs/sweeps/test_cluster.py::test_a_worker_is_lost",
    "pyjoystick/runs/sweeps/test_cluster.py::test_ctrl_c_and_a_lost_scheduler_lose_nothing",
    "pyjoystick/runs/sweeps/test_interruption.py::test_a_stopped_sweep_goes_on_from_there",
)
RELEASE = (*SHIPPED, *STUDIES)
#: What the quick part leaves out, besides tests that build FMUs: those that compile or start other
#: programs, and those that take more than some seconds for other reasons.
SLOW = (
    *RELEASE,
    *("docs", "fmu_build", "fuzz", "joystick_fmu", "modelica", "other_tools", "scenarios", "test_signals.py"),
    *("test_your_joystick.py", "pyjoystick/cli", "pyjoystick/forced_motion", "pyjoystick/identification"),
    *("pyjoystick/laboratory/inertia/test_swing.py", "pyjoystick/laboratory/load_curve/test_fit.py"),
    *(
        "pyjoystick/laboratory/measurements",
        "pyjoystick/motion/test_record_peaks.py",
        "pyjoystick/reports/project",
    ),
    *("pyjoystick/reports", "pyjoystick/support/test_plots.py", "pyjoystick/test_shown.py"),
    *("pyjoystick/fmu/stepping", "pyjoystick/fmu/test_batch.py", "pyjoystick/fmu/test_cosimulation.py"),
    *("pyjoystick/fmu/test_exact_values.py", "pyjoystick/fmu/test_interruption.py"),
    *("pyjoystick/fmu/test_linearization.py", "pyjoystick/fmu/test_own_fmi3.py"),
    *("pyjoystick/fmu/test_own_process.py", "pyjoystick/fmu/test_stepper.py"),
    *("pyjoystick/fmu/test_texts_and_arrays.py", "pyjoystick/model/reference/test_accuracy.py"),
    *("pyjoystick/model/reference/test_integration.py", "pyjoystick/model/reference/test_physics.py"),
    *("pyjoystick/runs/coupling", "pyjoystick/runs/fmu_comparison", "pyjoystick/runs/sweeps/test_cluster.py"),
    *("pyjoystick/runs/sweeps/test_interruption.py", "pyjoystick/runs/sweeps/test_parts.py"),
)
#: Quick all the same.
QUICK = ("fmu_build/codegen/modelica_source", "fmu_build/runtime/test_layers.py")
#: What takes longest, one process each, while others go on with the rest.
FIRST = (
    *("test_wheel.py", "test_your_joystick.py", "fmu_build/platforms/test_libraries.py", "docs/test_site.py"),
    *("fmu_build/models/test_derivatives.py", "pyjoystick/identification/fitting/test_order.py"),
    *("docs/test_pages.py", "pyjoystick/reports/export/test_fmus.py", "joystick_fmu/test_sensitivities.py"),
    *("pyjoystick/model/reference/test_accuracy.py", "pyjoystick/identification/fitting/test_recovery.py"),
    *("modelica/test_models.py", "joystick_fmu/test_flange.py", "fmu_build/runtime/test_sanitizers.py"),
    *("pyjoystick/reports/html_report/test_report.py", "pyjoystick/identification/fitting/test_selection.py"),
)


def _place(item: pytest.Item) -> str:
    """File and name of a test, as the parts begin with them."""
    return f"{item.path.relative_to(ROOT / 'tests').as_posix()}::{item.name}"


def _is_of_release(item: pytest.Item) -> bool:
    return _place(item).startswith(RELEASE)


def _is_quick(item: pytest.Item) -> bool:
    fixtures = set(getattr(item, "fixturenames", ()))
    builds = "shared_fmus" in fixtures and not fixtures & {"joystick_fmus", "joystick_fmus3"}
    return not builds and (not _place(item).startswith(SLOW) or _place(item).startswith(QUICK))


#: The parts of the tests that can be run alone.
PARTS: dict[str, Callable[[pytest.Item], bool]] = {
    "quick": _is_quick,
    "code": lambda item: not _is_of_release(item),
    "release": _is_of_release,
}


def pytest_configure() -> None:
    """Where Ctrl-C is ignored, as after ``nohup``, the processes that tests start hear it all the same.

    They would inherit that it is ignored, but not that something else is done with it.
    """
    if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
        signal.signal(signal.SIGINT, lambda *_: None)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption("--part", choices=PARTS, help="only a part of the tests; all where it is not given")


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Leave out files without a test of the part: every process of the tests would read them."""
    part = config.getoption("--part")
    if part not in ("code", "release") or not collection_path.is_file():
        return None
    place = collection_path.relative_to(ROOT / "tests").as_posix()
    is_whole = any(place.startswith(one) for one in RELEASE)
    has_some = any(one.startswith(f"{place}::") for one in RELEASE)
    return True if (is_whole if part == "code" else not (is_whole or has_some)) else None


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Begin with what takes longest, and leave out what is not of the part."""
    order = {ROOT / "tests" / file: number for number, file in enumerate(FIRST)}
    items.sort(key=lambda item: order.get(item.path, len(FIRST)))  # else in the order of collection
    is_of_part = PARTS.get(config.getoption("--part"))
    if is_of_part is not None:
        config.hook.pytest_deselected(items=[item for item in items if not is_of_part(item)])
        items[:] = filter(is_of_part, items)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """With ``--dist loadgroup``, one process has all tests of a file: each would make what they share."""
    if config.getoption("dist") != "loadgroup":
        return None
    from xdist.scheduler import LoadGroupScheduling

    scheduler = LoadGroupScheduling(config, log)
    group_of = scheduler._split_scope
    scheduler._split_scope = lambda nodeid: group_of(nodeid).partition("::")[0]
    return scheduler


@pytest.fixture(scope="session")
def shared_fmus(tmp_path_factory: pytest.TempPathFactory) -> SharedFmus:
    """FMUs that are built once, also where several processes share the tests."""
    folder = tmp_path_factory.getbasetemp()
    if "PYTEST_XDIST_WORKER" in os.environ:
        folder = folder.parent
    folder /= "shared_fmus"
    folder.mkdir(exist_ok=True)
    return SharedFmus(folder)


@pytest.fixture(scope="session")
def joystick_fmus(shared_fmus: SharedFmus, request: pytest.FixtureRequest) -> Path:
    """The folder with the FMUs of this project by the default compiler.

    Those of ``make fmu`` where they are up to date and not another compiler's, else new ones. For the quick
    part those of ``make fmu`` as they are.
    """
    return _made_or_new("2.0", shared_fmus, request)


@pytest.fixture(scope="session")
def joystick_fmus3(shared_fmus: SharedFmus, request: pytest.FixtureRequest) -> Path:
    """The same of FMI 3."""
    return _made_or_new("3.0", shared_fmus, request)


def _made_or_new(fmi_version: FmiVersion, shared_fmus: SharedFmus, request: pytest.FixtureRequest) -> Path:
    made = ROOT / "build" / f"fmi{fmi_version[0]}"
    if _is_up_to_date(made):
        return made
    if request.config.getoption("--part") == "quick":
        if all(fmu.is_file() for fmu in _of_this_project(made)):
            return made
        pytest.skip(f"the FMUs are missing: make fmu FMI={fmi_version[0]}")
    make = partial(shared_fmus.fmu, fmi_version=fmi_version, as_shipped=True)
    (folder,) = {make(model).parent for model in MODELS.values()}
    for name, request_of in SENSITIVITIES.items():
        make(MODELS[name], sensitivity=request_of, beside=folder)
    return folder


def _is_up_to_date(folder: Path) -> bool:
    fmus = _of_this_project(folder)
    if not all(fmu.is_file() for fmu in fmus):
        return False
    if not all(_tool(fmu).startswith("pyjoystick") for fmu in fmus):
        return False
    oldest = min(fmu.stat().st_mtime for fmu in fmus)
    return all(source.stat().st_mtime <= oldest for source in _sources())


def _of_this_project(folder: Path) -> list[Path]:
    sensitive = [folder / "sensitivities" / f"{name}.fmu" for name in SENSITIVITIES]
    return [*(folder / f"{name}.fmu" for name in MODELS), *sensitive]


def _tool(fmu: Path) -> str:
    return str(fmpy.read_model_description(str(fmu), validate=False).generationTool)


def _sources() -> Iterator[Path]:
    yield ROOT / "pyjoystick" / "fmu" / "shipped.py"
    for folder in ("fmu_build", "modelica"):
        for file in (ROOT / folder).rglob("*"):
            if file.is_file() and file.suffix not in (".pyc", ".js", ".css", ".html"):  # pages are in no FMU
                yield file


@pytest.fixture(scope="session")
def omc(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Omc]:
    """An OpenModelica session, for root in the script form; skips where none is installed."""
    reason = why_not()
    if reason:
        pytest.skip(reason)
    with opened(tmp_path_factory.mktemp("omc")) as session:
        yield session


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """A headless Chromium for the tests of a file.

    Not for the whole session: Playwright's event loop runs as long as the browser does, and no other test of
    that process could start one.
    """
    with browsers.opened() as one:
        yield one


@pytest.fixture
def fmus_by_name(joystick_fmus: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Has ``Joystick`` and the other names mean the FMUs of `joystick_fmus`."""
    for module in ("pyjoystick.fmu.files", "pyjoystick.fmu"):
        monkeypatch.setattr(f"{module}.build_folder", lambda: joystick_fmus)
    return joystick_fmus
