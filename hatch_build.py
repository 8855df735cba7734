"""Build hook: a wheel carries the FMUs for all platforms, so that who installs it needs no compiler."""

from __future__ import annotations

import runpy
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

MODELS = (
    "Joystick.Joystick",
    "Joystick.JoystickPowerLaw",
    "Joystick.JoystickFriction",
    "Joystick.JoystickFrictionPowerLaw",
    "Joystick.JoystickInverse",
    "Joystick.JoystickInversePowerLaw",
    "Operator.Operator",
    "Operator.HeldJoystick",
    "Operator.HeldJoystickPowerLaw",
    "Operator.MountedJoystick",
    "Operator.MountedJoystickPowerLaw",
    "Examples.OperatedJoystick",
)
#: What those in ``sensitivities/`` compute besides, by name.
SENSITIVITIES = runpy.run_path(str(Path(__file__).with_name("pyjoystick") / "fmu" / "shipped.py"))[
    "SENSITIVITIES"
]
#: With the WebAssembly module, live pages and sandboxes need no compiler either.
PLATFORMS = ("all", "wasm32")


class CustomBuildHook(BuildHookInterface):
    """Builds the FMUs and puts them into ``pyjoystick/fmus/``."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Add the FMUs to a real wheel; an editable install takes them from ``build/fmi2/``."""
        if version == "editable":
            return
        sys.path.insert(0, self.root)
        from fmu_build import build_fmu

        self._folder = tempfile.TemporaryDirectory()
        folder = Path(self._folder.name)
        sensitive = folder / "sensitivities"
        builds = [(model, folder, None) for model in MODELS]
        builds += [(f"Joystick.{name}", sensitive, request) for name, request in SENSITIVITIES.items()]
        for model, output, request in builds:
            result = build_fmu(f"PreloadedSprings.{model}", output, platforms=PLATFORMS, sensitivity=request)
            place = result.path.relative_to(folder).as_posix()
            build_data["force_include"][str(result.path)] = f"pyjoystick/fmus/{place}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """Remove what was built only to be packed."""
        if version != "editable":
            self._folder.cleanup()
