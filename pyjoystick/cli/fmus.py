"""FMUs of the command line: found, or built where the tools for it are installed."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path

from pyjoystick.cli.console import messages, print_note
from pyjoystick.support import PyJoystickError

_TOOLS = ("fmu_build", "rumoca", "ziglang")


class FmuBuildError(PyJoystickError):
    """An FMU that was missing could not be built."""


def found_or_built(fmu: str) -> Path:
    """The path of an FMU given by name or path; one of the checkout's own that is missing is built.

    Raises:
        FmuNotFoundError: there is no such file, and it cannot be built here
        FmuBuildError: building it failed
    """
    # What finds FMUs comes with what runs them, which help need not wait for.
    from pyjoystick.fmu import MODELS, FmuNotFoundError, build_folder, find_fmu

    try:
        return find_fmu(fmu)
    except FmuNotFoundError:
        folder = build_folder()
        if fmu not in MODELS or folder is None or not all(find_spec(tool) for tool in _TOOLS):
            raise
        return _build(MODELS[fmu], folder)


def _build(model: str, folder: Path) -> Path:
    from fmu_build import BuildError, build_fmu

    with messages().status(f"building the FMU of {model}") as status:
        try:
            result = build_fmu(model, folder, on_stage=lambda stage: status.update(f"{model}: {stage}"))
        except BuildError as error:
            raise FmuBuildError(f"the FMU of {model} could not be built: {error}") from error
    print_note(f"built {result.path} in {result.seconds:.1f} s, as it was missing")
    return result.path
