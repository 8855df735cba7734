"""Install FMUs built by another tool in the output folder, after all checks that are possible."""

from __future__ import annotations

import io
import zipfile
from pathlib import Path

from fmpy.validation import validate_fmu
from lxml import etree

from fmu_build.packaging.archive import check_output_folder, replacing
from fmu_build.packaging.check import check_archive, check_loads
from fmu_build.packaging.fmi2_units import add_unit_definitions
from fmu_build.packaging.platforms import WASM32, host_platform, select_platforms, wants_module
from fmu_build.support.errors import BuildError
from fmu_build.support.request import BuildRequest, check_fmi

_DESCRIPTION = "modelDescription.xml"


def check_request(request: BuildRequest, tool: str) -> None:
    """Raise `BuildError` for a request that such a tool cannot fulfil, before any work is done."""
    check_fmi(request)
    host = host_platform()
    asked = select_platforms(request.platforms) if request.platforms else ()
    others = [platform.name for platform in asked if platform != host]
    others += [WASM32.name] if wants_module(request.platforms) else []
    if others:
        own = f" ({host.name})" if host is not None else ""
        raise BuildError(f"{tool} builds only for this machine{own}, not for {', '.join(others)}")
    check_output_folder(request.output)


def place(made: Path, request: BuildRequest) -> tuple[Path, str]:
    """Move an FMU that loads on this machine to the output folder.

    Returns its path and the findings. Raises `BuildError`, and leaves the old FMU in place, if the new one is
    damaged, does not load, or lacks a requested FMI type. Findings of FMPy's validation are only reported;
    missing unit definitions are added.
    """
    if not zipfile.is_zipfile(made):
        raise BuildError(f"{made.name} is not a complete ZIP archive")
    check_archive(made)
    try:
        content, log = _with_unit_definitions(made.read_bytes())
    except (KeyError, etree.XMLSyntaxError) as error:
        raise BuildError(f"{made.name} has no readable {_DESCRIPTION}: {error}") from error
    target = request.output / made.name
    with replacing(target, content) as new:
        log += check_loads(new, request.fmi_types)
        log += "".join(f"FMPy's validation: {finding}\n" for finding in validate_fmu(str(new)))
    return target, log


def _with_unit_definitions(content: bytes) -> tuple[bytes, str]:
    """Return the archive with definitions for all units of its variables, and a log of those added.

    Validating importers such as FMPy reject an FMU without them; old versions of OpenModelica write none.
    """
    with zipfile.ZipFile(io.BytesIO(content)) as old:
        description, units = add_unit_definitions(old.read(_DESCRIPTION))
        if not units:
            return content, ""
        new = io.BytesIO()
        with zipfile.ZipFile(new, "w", zipfile.ZIP_DEFLATED) as archive:
            for entry in old.infolist():
                is_description = entry.filename == _DESCRIPTION
                archive.writestr(entry, description if is_description else old.read(entry))
    return new.getvalue(), f"unit definitions added to the FMU: {', '.join(units)}\n"
