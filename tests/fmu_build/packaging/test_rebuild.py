"""FMPy compiles an FMU's sources with the local C compiler, and the result runs."""

from __future__ import annotations

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.util import read_csv

from fmu_build.packaging import package_fmu
from fmu_build.support.description import GeneratedModel
from fmu_build.support.request import BuildRequest, FmiVersion


@pytest.mark.parametrize("fmi_version", ["2.0", "3.0"])
def test_fmpy_rebuilds_the_library(
    generated: GeneratedModel, fmi_version: FmiVersion, tmp_path: Path
) -> None:
    if missing := [program for program in ("cmake", "cc", "make") if shutil.which(program) is None]:
        pytest.skip(f"needed to compile as FMPy does, but not found: {', '.join(missing)}")
    fmu = package_fmu(generated, BuildRequest("Test.Oscillator", tmp_path, fmi_version=fmi_version)).path
    folder = {"2.0": fmpy.platform, "3.0": fmpy.platform_tuple}[fmi_version]
    library = f"binaries/{folder}/Oscillator{fmpy.sharedLibraryExtension}"
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(tmp_path)
        before = archive.read(library)
    subprocess.run(
        [sys.executable, "-m", "fmpy", "compile", str(fmu), "--all-warnings", "--warning-as-error"],
        check=True,
        capture_output=True,
        cwd=tmp_path,
    )
    with zipfile.ZipFile(fmu) as archive:
        assert archive.read(library) != before
    expected = read_csv(tmp_path / "extra" / "org.fmi-standard.fmi-ls-ref" / "Oscillator_ref.csv")
    for fmi_type, limit in (("CoSimulation", 1e-9), ("ModelExchange", 1e-6)):
        result = fmpy.simulate_fmu(
            str(fmu),
            fmi_type=fmi_type,
            relative_tolerance=1e-10,
            output_interval=expected["time"][1],
            output=["x", "E"],
        )
        for name in ("x", "E"):
            np.testing.assert_allclose(result[name], expected[name], rtol=0, atol=limit)
