"""FMUs that several tests need, each built once in a session, by the process of it that asks first."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from contextlib import contextmanager, nullcontext
from pathlib import Path

import pytest
from filelock import FileLock
from fmpy import extract

from fmu_build import FmiVersion, build_fmu


@contextmanager
def plain_builds(*, are_run: bool = False) -> Iterator[None]:
    """Builds that leave out what the tests of an FMU do themselves: to load it, and to run it.

    The two processes for that, the figure and link-time optimization take as long as all the rest. Libraries
    are linked as for Windows and macOS. FMUs of `make fmu` and of the tests of `packaging` have all of it;
    those that `are_run` are compared with their source.
    """
    with pytest.MonkeyPatch.context() as patch:
        if not are_run:
            patch.setattr("fmu_build.packaging.run_default_experiment", lambda *_: "the tests run it")
        patch.setattr("fmu_build.packaging.check.check_loads", lambda *_: "")
        patch.setattr("fmu_build.packaging.binaries.OPTIMIZED_WHEN_LINKED", ())
        yield


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
        as_shipped: bool = False,
        is_run: bool = False,
    ) -> Path:
        """The FMU of a model; those of one library with the same settings lie in one folder.

        That is ``sensitivities`` in the folder `beside`, where one is given. Its build is a plain one, unless
        the FMU has to be `as_shipped`, or `is_run` to be compared with its source.
        """
        more = (*([sensitivity] if sensitivity else []), *(["run"] if is_run else []))
        settings = (library, fmi_version, platforms, *more, as_shipped)
        file = self._file(model, *settings)
        if beside is not None:
            file = beside / "sensitivities" / file.name
        with self._lock(file), nullcontext() if as_shipped else plain_builds(are_run=is_run):
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
        """The folder of the unpacked FMU of a model."""
        fmu = self.fmu(model, library, is_run=True)
        folder = fmu.with_suffix("")
        with self._lock(folder):
            if not folder.exists():
                part = fmu.with_suffix(".part")
                extract(str(fmu), str(part))
                part.rename(folder)
        return folder

    def _file(self, model: str, *settings: object) -> Path:
        folder = self._folder / hashlib.sha256(repr(settings).encode()).hexdigest()[:16]
        return folder / f"{model.rpartition('.')[2]}.fmu"

    def _lock(self, path: Path) -> FileLock:
        return FileLock(self._folder / f"{path.parent.name}-{path.name}.lock")
