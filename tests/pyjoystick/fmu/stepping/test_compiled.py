"""Compilation happens once, is cached on disk if possible, and is optional."""

from __future__ import annotations

import errno
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.fmu.stepping import compiled, engine, kernel

_SCRIPT = """
import sys
from pyjoystick.fmu import Fmu
from pyjoystick.fmu.stepping import engine
with Fmu(sys.argv[1]) as fmu:
    fmu.plan([0.0, 0.1]).run()
print(sum(engine._compiled.stats.cache_hits.values()), sum(engine._compiled.stats.cache_misses.values()))
"""


def test_one_compilation_serves_every_fmu(
    joystick: Fmu, mixed: Fmu, awkward_fmu: Fmu, awkward3_path: Path
) -> None:
    with Fmu(awkward3_path) as awkward3:
        loops = []
        for fmu in (joystick, mixed, awkward_fmu, awkward3):
            fmu.plan([0.0, 0.1]).run()
            loops.append(engine._compiled)
    assert len({id(loop) for loop in loops}) == 1
    dispatcher: Any = loops[0]
    assert len(dispatcher.overloads) == 1


def test_another_process_finds_it_on_disk(joystick: Fmu, joystick_path: Path) -> None:
    joystick.plan([0.0, 0.1]).run()
    command = [sys.executable, "-c", _SCRIPT, str(joystick_path)]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "1 0\n"


def test_a_single_table_run_does_not_load_the_compiler(joystick_path: Path) -> None:
    script = (
        "import sys; from pyjoystick.fmu import Fmu\n"
        "with Fmu(sys.argv[1]) as fmu: fmu.run([0.0, 0.1])\n"
        "print('numba' in sys.modules)"
    )
    command = [sys.executable, "-c", script, str(joystick_path)]
    assert subprocess.run(command, capture_output=True, text=True, check=True).stdout == "False\n"


def test_without_numba_the_plain_loop_runs(joystick: Fmu, monkeypatch: pytest.MonkeyPatch) -> None:
    assert engine.has_compiled_loop()
    plan = joystick.plan([0.0, 0.1, 0.2], varied="theta_start")
    expected = plan.run([0.1])
    monkeypatch.setattr(engine, "find_spec", lambda name: None)
    monkeypatch.setattr(engine, "_compiled", None)
    assert not engine.has_compiled_loop()
    without = joystick.plan([0.0, 0.1, 0.2], varied="theta_start")
    np.testing.assert_array_equal(without.run([0.1]), expected)
    assert engine._compiled is None


def _sum(program: int, operations: int) -> int:
    return program + operations


@pytest.fixture
def small_kernel(monkeypatch: pytest.MonkeyPatch) -> None:
    """Something that compiles quickly in place of the kernel."""
    monkeypatch.setattr(kernel, "run_many", _sum)


@pytest.mark.usefixtures("small_kernel")
def test_no_folder_to_keep_it_in(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("numba.core.caching.CacheImpl._locator_classes", [])
    assert compiled.compiled((1, 2))(3, 4) == 7


@pytest.mark.usefixtures("small_kernel")
def test_no_room_to_keep_it(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise OSError(errno.ENOSPC, "no space left")

    monkeypatch.setattr("numba.core.caching.IndexDataCacheFile.save", refuse)
    assert compiled.compiled((1.5, 2.5))(3.0, 4.0) == 7.0


@pytest.mark.usefixtures("small_kernel")
def test_the_first_compilation_is_logged_and_no_later_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr("numba.core.config.CACHE_DIR", str(tmp_path))
    told = ["compiling the loop of the runs; this takes some seconds the first time"]
    for expected in (told, []):  # the second one is found on disk
        with caplog.at_level("INFO", logger=compiled.__name__):
            assert compiled.compiled((1, 2))(3, 4) == 7
        assert [record.getMessage() for record in caplog.records] == expected
        caplog.clear()


@pytest.mark.usefixtures("small_kernel")
def test_other_types_are_refused_instead_of_compiled() -> None:
    with pytest.raises(TypeError, match="No matching definition"):
        compiled.compiled((1, 2))("3", 4)


def test_a_change_in_any_source_makes_it_new(monkeypatch: pytest.MonkeyPatch) -> None:
    names = {compiled._versioned(_sum).__qualname__}
    assert names == {compiled._versioned(_sum).__qualname__}
    source = compiled.inspect.getsource
    for changed in compiled._SOURCES:
        monkeypatch.setattr(
            compiled.inspect,
            "getsource",
            lambda part, changed=changed: source(part) + " " * (part is changed),
        )
        names.add(compiled._versioned(_sum).__qualname__)
    assert len(names) == 1 + len(compiled._SOURCES)


def test_every_source_of_the_kernel_counts() -> None:
    """What the kernel calls, at first or second hand, is in one of the modules that the name depends on."""
    modules = {module.__name__ for module in compiled._SOURCES}
    assert {function.__module__ for function in kernel.FUNCTIONS} < modules
    assert kernel.run_many.__module__ in modules
