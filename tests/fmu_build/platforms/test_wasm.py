"""The WebAssembly modules of this project's FMUs."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import wasmtime
from filelock import FileLock

from fmu_build import BuildError
from fmu_build.packaging import binaries, wasm_module
from fmu_build.packaging.binaries import COMPILER_FLAGS
from fmu_build.packaging.module import module_name
from fmu_build.packaging.sources import c_files, fmi_header, module_face
from fmu_build.support.cache import Store
from pyjoystick.fmu import MODELS, Fmu
from tests.fmu_build.random_joysticks import random_joysticks
from tests.pyjoystick.fmu.sandbox.hostile import with_module

#: Bytes; joysticks with friction have more events, those that are held or mounted a hand and stops too.
_LARGEST = 130_000
_LARGEST_WITH_FRICTION = 136_000
_POINTS = 301
_TIME = np.linspace(0.0, 1.5, _POINTS)
#: The sines and powers of the C libraries differ in the last bit. Of 50 random joysticks with the power law,
#: two differed by more than 1e-9 rad at the usual tolerance of 1e-8 (by 3e-9 at most), by less than either of
#: their runs was wrong. At 1e-10 all agreed to 1e-14 rad.
_TOLERANCE = 1e-10
_LIMIT = 1e-12
#: How many; of those with a hand or stops fewer, whose runs take longer and differ in the same few functions.
_JOYSTICKS = 50
_OTHERS = 3

Modules = Callable[[str], Path]


@pytest.fixture(scope="session")
def module_of(joystick_fmus: Path, tmp_path_factory: pytest.TempPathFactory) -> Modules:
    """The FMU of this name with a module made from its sources, once for all processes of the tests."""
    folder = tmp_path_factory.getbasetemp()
    folder = (folder.parent if folder.name.startswith("popen-") else folder) / "modules"
    folder.mkdir(exist_ok=True)

    @cache
    def made(name: str) -> Path:
        target = folder / f"{name}.fmu"
        with FileLock(folder / f"{name}.lock"):
            if not target.exists():
                part = with_module(
                    joystick_fmus / f"{name}.fmu",
                    folder / name,
                    name,
                    wasm_module(joystick_fmus / f"{name}.fmu"),
                )
                part.rename(target)
        return target

    return made


@pytest.mark.parametrize("name", MODELS)
def test_a_module_is_small_imports_nothing_and_exports_fmi_and_its_face(
    module_of: Modules, name: str
) -> None:
    content = wasm_module(module_of(name))
    with_friction = name.startswith(("Held", "Mounted", "JoystickFriction"))
    assert len(content) <= (_LARGEST_WITH_FRICTION if with_friction else _LARGEST)
    module = wasmtime.Module(wasmtime.Engine(), content)
    assert [one.name for one in module.imports] == []
    exported = {one.name for one in module.exports}
    declared = {
        word.split("(")[0].rstrip("TYPE; ")
        for word in fmi_header("fmi2Functions.h").decode().split()
        if word.startswith("fmi2") and word.endswith("TYPE")
    }
    assert len(declared) > 30
    face = {
        word.partition("(")[0].lstrip("*")
        for line in module_face()["explore.h"].decode().splitlines()
        if line.startswith("EXPLORE_EXPORT")
        for word in line.split()
        if "explore_" in word and "(" in word
    }
    assert len(face) == 12
    assert declared | face | {"memory", "malloc", "free", "_initialize"} <= exported


def test_the_same_sources_give_the_same_bytes(
    module_of: Modules, joystick_fmus: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Compiled anew, not taken from the cache of modules."""
    expected = wasm_module(module_of("Operator"))
    monkeypatch.setattr(Store, "folder", lambda store: tmp_path / store.name)
    assert wasm_module(joystick_fmus / "Operator.fmu") == expected
    assert list((tmp_path / binaries.STORE.name).glob("*.wasm")), "it was compiled"


@pytest.mark.parametrize("name", MODELS)
def test_runs_agree_with_those_of_the_binary(module_of: Modules, name: str) -> None:
    with Fmu(module_of(name)) as native, Fmu(module_of(name), sandbox=True) as sandboxed:
        description = native.description
        outputs = [
            one.name
            for one in description.variables.values()
            if one.type == "Real" and one.causality in ("output", "local")
        ]
        # Not below zero, which a hand's grip may not be.
        moving = {one: 0.1 * np.abs(np.sin(9.0 * _TIME)) for one in description.names("input") if one != "W"}
        inputs = pd.DataFrame(moving, index=_TIME)
        count = _JOYSTICKS if name in ("Joystick", "JoystickPowerLaw") else _OTHERS
        for parameters in random_joysticks(description, count):
            settings = {
                "parameters": parameters,
                "inputs": inputs,
                "outputs": outputs,
                "tolerance": _TOLERANCE,
            }
            expected, found = native.run(_TIME, **settings), sandboxed.run(_TIME, **settings)
            if "theta" in outputs:
                np.testing.assert_allclose(found["theta"], expected["theta"], rtol=0.0, atol=_LIMIT)
            # Others are steep functions of the motion, as the springs' force is.
            scale = expected.abs().max() + 1.0
            assert float(((found - expected).abs().max() / scale).max()) < 1e-8


@pytest.mark.skipif(sys.platform != "linux", reason="programs that are linked with musl run on Linux")
@pytest.mark.parametrize("name", ["Joystick", "JoystickPowerLaw"])
def test_runs_are_those_of_a_program_with_the_same_c_library(
    module_of: Modules, name: str, tmp_path_factory: pytest.TempPathFactory
) -> None:
    with Fmu(module_of(name), sandbox=True) as fmu:
        variables = fmu.description.variables
        cases = random_joysticks(fmu.description, _JOYSTICKS)
        program = _musl_program(module_of(name), tmp_path_factory.mktemp(name))
        outputs = fmu.description.names("output")
        lines = [
            " ".join(f"{variables[one].value_reference} {float(value)!r}" for one, value in case.items())
            for case in cases
        ]
        references = [str(variables[one].value_reference) for one in outputs]
        done = subprocess.run(
            [program, "1.5", "1e-08", str(_POINTS), *references],
            input="".join(f"{line}\n" for line in lines).encode(),
            capture_output=True,
            check=True,
        )
        expected = np.frombuffer(done.stdout).reshape(_JOYSTICKS, _POINTS, len(outputs))
        times = np.arange(_POINTS) * (1.5 / (_POINTS - 1))
        for case, table in zip(cases, expected, strict=True):
            found = fmu.run(times, parameters=case, outputs=outputs, tolerance=1e-8)
            np.testing.assert_array_equal(found.to_numpy(), table)


def _musl_program(fmu: Path, folder: Path) -> Path:
    """Runs of the FMU through the face of its module, compiled for this machine and linked with musl."""
    with zipfile.ZipFile(fmu) as archive:
        names = [name for name in archive.namelist() if name.startswith("sources/")]
        sources = {name.removeprefix("sources/"): archive.read(name) for name in names} | module_face()
    sources["main.c"] = Path(__file__).with_name("explorer.c").read_bytes()
    for name, content in sources.items():
        (folder / name).write_bytes(content)
    target = ["-target", "x86_64-linux-musl", "-static", "-mcpu=baseline"]
    command = [sys.executable, "-m", "ziglang", "cc", *target, *COMPILER_FLAGS, "-o", "run"]
    subprocess.run([*command, *c_files(sources), "-lm"], cwd=folder, check=True)
    return folder / "run"


def test_fmus_that_modules_cannot_be_made_from(
    joystick_fmus: Path, joystick_fmus3: Path, tmp_path: Path
) -> None:
    with pytest.raises(BuildError, match="neither a WebAssembly module nor the sources to make one"):
        wasm_module(joystick_fmus3 / "Joystick.fmu")
    with pytest.raises(BuildError, match="cannot read the FMU"):
        wasm_module(tmp_path / "none.fmu")
    (tmp_path / "text.fmu").write_text("no archive")
    with pytest.raises(BuildError, match="cannot read the FMU"):
        wasm_module(tmp_path / "text.fmu")
    with zipfile.ZipFile(tmp_path / "other.fmu", "w") as archive:
        archive.writestr("modelDescription.xml", "<fmiModelDescription/>")
    with pytest.raises(BuildError, match="no modelIdentifier"):
        wasm_module(tmp_path / "other.fmu")
    assert module_name("Joystick") == "extra/org.pyjoystick/wasm32/Joystick.wasm"
