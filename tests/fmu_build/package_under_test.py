"""A Modelica package to which each test adds declarations, to be built and run or to be refused."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import pytest

from fmu_build import UnsupportedModelError, build_fmu
from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.request import BuildRequest
from pyjoystick import Fmu


@dataclass(frozen=True)
class PackageUnderTest:
    """A package ``R`` with the model ``R.M``.

    Attributes:
        text: its source, with ``{}`` where a test's declarations belong
    """

    text: str

    def write(self, folder: Path, declarations: str) -> Path:
        """Write the package with these declarations and return its file."""
        file = folder / "R.mo"
        file.write_text(self.text.replace("{}", declarations), "utf-8")
        return file

    def values(self, folder: Path, declarations: str, names: Iterable[str]) -> dict[str, float]:
        """Return the values of variables of ``R.M`` at 1 s."""
        built = build_fmu("R.M", folder, library=self.write(folder, declarations))
        with Fmu(built.path) as fmu:
            return dict(fmu.run([0.0, 1.0], outputs=[*names]).iloc[-1])

    def refusal(self, folder: Path, declarations: str, message: str) -> str:
        """Return the message with which ``R.M`` is refused, which must match `message`."""
        file = self.write(folder, declarations)
        with pytest.raises(UnsupportedModelError, match=message) as caught:
            generate_model(BuildRequest("R.M", folder, file))
        return str(caught.value)
