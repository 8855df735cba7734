"""FMUs that several tests need, each built once in a session, by the process of it that asks first."""

from __future__ import annotations

import hashlib
from pathlib import Path

import pytest
from filelock import FileLock
from fmpy import extract

from fmu_build import FmiVersion, build_fmu


class SharedFmus:
    """Builds FMUs into folders that every process of a test session reads."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder

    def fmu(
        self,
        model: str,
        library: Path | None = None,
        *,
        fmi_version: FmiVersion = "2.0",
        platforms: tuple[str, ...] = (),
        sensitivity: str | None = None,
        beside: Path | None = None,
    ) -> Path:
        """The FMU of a model; those of one library with the same settings lie in one folder.

        That is ``sensitivities`` in the folder `beside`, where one is given.
        """
        settings = (library, fmi_version, platforms, *([sensitivity] if sensitivity else []))
        file = self._file(model, *settings)
        if beside is not None:
            file = beside / "sensitivities" / file.name
        with self._lock(file):
            if not file.exists():
                build_fmu(
                    model,
                    file.parent,
                    library=library,
                    fmi_version=fmi_version,
                    platforms=platforms,
                    sensitivity=sensitivity,
                )
        return file

    def unpacked(self, model: str, library: Path) -> Path:
        """The folder of the unpacked FMU of a model, for tests that load and run it.

        Its build therefore leaves that out: the two processes for it take as long as all the rest. It is
        linked as for Windows and macOS, without link-time optimization, in a fifth of the time. The FMUs of
        `fmu` have that.
        """
        fmu = self._file(model, library, "unpacked")
        folder = fmu.with_suffix("")
        with self._lock(folder), pytest.MonkeyPatch.context() as patch:
            if not folder.exists():
                patch.setattr("fmu_build.packaging.run_default_experiment", lambda *_: "the tests run it")
                patch.setattr("fmu_build.packaging.check.check_loads", lambda *_: "")
                patch.setattr("fmu_build.packaging.binaries.OPTIMIZED_WHEN_LINKED", ())
                build_fmu(model, fmu.parent, library=library)
                part = fmu.with_suffix(".part")
                extract(str(fmu), str(part))
                part.rename(folder)
        return folder

    def _file(self, model: str, *settings: object) -> Path:
        folder = self._folder / hashlib.sha256(repr(settings).encode()).hexdigest()[:16]
        return folder / f"{model.rpartition('.')[2]}.fmu"

    def _lock(self, path: Path) -> FileLock:
        return FileLock(self._folder / f"{path.parent.name}-{path.name}.lock")
