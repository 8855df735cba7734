"""FMUs that several tests need, each built once in a session, by the process of it that asks first."""

from __future__ import annotations

import hashlib
from pathlib import Path

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
    ) -> Path:
        """The FMU of a model; those of one library with the same settings lie in one folder."""
        settings = repr((library, fmi_version, platforms))
        folder = self._folder / hashlib.sha256(settings.encode()).hexdigest()[:16]
        file = folder / f"{model.rpartition('.')[2]}.fmu"
        with self._lock(file):
            if not file.exists():
                build_fmu(model, folder, library=library, fmi_version=fmi_version, platforms=platforms)
        return file

    def unpacked(self, model: str, library: Path) -> Path:
        """The folder of the unpacked FMU of a model."""
        fmu = self.fmu(model, library)
        folder = fmu.with_suffix("")
        with self._lock(folder):
            if not folder.exists():
                part = fmu.with_suffix(".part")
                extract(str(fmu), str(part))
                part.rename(folder)
        return folder

    def _lock(self, path: Path) -> FileLock:
        return FileLock(self._folder / f"{path.parent.name}-{path.name}.lock")
