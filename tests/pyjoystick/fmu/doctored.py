"""Copies of a valid FMU with one change."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Callable
from pathlib import Path


def doctored(
    fmu: Path,
    target: Path,
    *,
    description: Callable[[str], str] = lambda text: text,
    rename: Callable[[str], str | None] = lambda name: name,
    content: Callable[[str, bytes], bytes] = lambda name, data: data,
) -> Path:
    """A copy at `target`: the text of modelDescription.xml, names (None leaves a file out), other files."""
    with zipfile.ZipFile(fmu) as source, zipfile.ZipFile(target, "w") as copy:
        for name in source.namelist():
            data = source.read(name)
            if name == "modelDescription.xml":
                data = description(data.decode()).encode()
            new_name = rename(name)
            if new_name is not None:
                copy.writestr(new_name, content(name, data))
    return target


def without_co_simulation(text: str) -> str:
    """A model description that offers Model Exchange only."""
    return re.sub(r"<CoSimulation.*?</CoSimulation>", "", text, flags=re.DOTALL)


FMI_3 = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="M" instantiationToken="t">
  <CoSimulation modelIdentifier="M"/>
  <ModelVariables><Float64 name="time" valueReference="0" causality="independent"/></ModelVariables>
  <ModelStructure/>
</fmiModelDescription>
"""
