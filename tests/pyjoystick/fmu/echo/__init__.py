"""FMUs of FMI 2.0 and 3.0 that return their inputs, compiled from the C files in this folder."""

from __future__ import annotations

import re
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy

_FOLDER = Path(__file__).parent
_HEADERS = Path(fmpy.__file__).parent / "c-code"
#: The types of numbers of FMI 3 in the order of fmi3.c, from 1.
TYPES = ("Float32", "Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64")


def build(version: int, folder: Path) -> Path:
    """The FMU in a folder of its own."""
    source = (_FOLDER / f"fmi{version}.c").read_text()
    header = (_HEADERS / f"fmi{version}Functions.h").read_text()
    defined = re.sub(r"TYPE\((\w+), \d+\)", r" fmi3Get\1( fmi3Set\1(", source)
    missing = [
        name
        for name in re.findall(rf"FMI{version}_Export\s+\w+TYPE\s+(\w+);", header)
        if f" {name}(" not in defined
    ]
    stubs, library = folder / "stubs.c", folder / f"echo{fmpy.sharedLibraryExtension}"
    stubs.write_text("".join(f"int {name}(void) {{ return 3; }}\n" for name in missing))
    flags = ["-std=c11", "-Wall", "-Wextra", "-Werror", "-O1", "-shared", "-fPIC", "-isystem", str(_HEADERS)]
    command = [sys.executable, "-m", "ziglang", "cc", *flags, "-o", str(library)]
    subprocess.run([*command, str(_FOLDER / f"fmi{version}.c"), str(stubs)], check=True)
    target = folder / f"echo{version}.fmu"
    platform = fmpy.platform if version == 2 else fmpy.platform_tuple
    with zipfile.ZipFile(target, "w") as archive:
        archive.writestr("modelDescription.xml", _fmi2() if version == 2 else _fmi3())
        archive.write(library, f"binaries/{platform}/echo{fmpy.sharedLibraryExtension}")
    return target


def _fmi3() -> str:
    numbers = [
        f"""
    <{name} name="p_{name}" valueReference="{k}1" causality="parameter" variability="tunable" start="0"/>
    <{name} name="u_{name}" valueReference="{k}2" causality="input" variability="discrete" start="0"/>
    <{name} name="p_again_{name}" valueReference="{k}3" causality="output" variability="discrete"/>
    <{name} name="u_again_{name}" valueReference="{k}4" causality="output" variability="discrete"/>
    <{name} name="both_{name}" valueReference="{k}5" causality="output" variability="discrete">
      <Dimension start="3"/>
    </{name}>"""
        for k, name in enumerate(TYPES, start=1)
    ]
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="echo" instantiationToken="echo">
  <CoSimulation modelIdentifier="echo" canHandleVariableCommunicationStepSize="true"
    providesDirectionalDerivatives="true"/>
  <ModelVariables>{"".join(numbers)}
    <UInt64 name="count" valueReference="1000" causality="structuralParameter" variability="fixed" start="2"/>
    <String name="text" valueReference="200" causality="parameter" variability="fixed">
      <Start value="a"/>
    </String>
    <String name="said" valueReference="201" causality="output"/>
    <String name="texts" valueReference="202" causality="output"><Dimension start="2"/></String>
    <String name="text_input" valueReference="203" causality="input"><Start value="b"/></String>
    <String name="text_again" valueReference="204" causality="output"/>
    <Binary name="blob" valueReference="210" causality="output"/>
    <Float64 name="force" valueReference="300" causality="input" start="0"/>
    <Float64 name="x" valueReference="301" causality="output" initial="exact" start="0 0">
      <Dimension valueReference="1000"/>
    </Float64>
    <Float64 name="der(x)" valueReference="302" derivative="301"><Dimension valueReference="1000"/></Float64>
    <Float64 name="y" valueReference="303" causality="output"/>
    <Float64 name="delay" valueReference="306" causality="parameter" variability="tunable" start="0" min="0"/>
  </ModelVariables>
  <ModelStructure><ContinuousStateDerivative valueReference="302"/></ModelStructure>
</fmiModelDescription>
"""


def _fmi2() -> str:
    def variable(
        name: str, reference: int, causality: str, element: str, variability: str = "continuous"
    ) -> str:
        kind = f'causality="{causality}" variability="{variability}"'
        return f'<ScalarVariable name="{name}" valueReference="{reference}" {kind}>{element}</ScalarVariable>'

    variables = [
        variable("force", 1, "input", '<Real start="0"/>'),
        variable("x", 2, "output", "<Real/>"),
        variable("v", 3, "output", "<Real/>"),
        variable("der(x)", 4, "local", '<Real derivative="2"/>'),
        variable("der(v)", 5, "local", '<Real derivative="3"/>'),
        variable("y", 6, "output", "<Real/>"),
        variable("force_again", 1, "output", "<Real/>"),
        variable("p_Integer", 1, "parameter", '<Integer start="0"/>', "tunable"),
        variable("u_Integer", 2, "input", '<Integer start="0"/>', "discrete"),
        variable("p_again_Integer", 3, "output", "<Integer/>", "discrete"),
        variable("u_again_Integer", 4, "output", "<Integer/>", "discrete"),
        variable("said", 1, "output", "<String/>", "discrete"),
    ]
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="echo" guid="echo">
  <CoSimulation modelIdentifier="echo" canHandleVariableCommunicationStepSize="true"
    providesDirectionalDerivative="true"/>
  <ModelVariables>{"".join(variables)}</ModelVariables>
  <ModelStructure><Derivatives><Unknown index="4"/><Unknown index="5"/></Derivatives></ModelStructure>
</fmiModelDescription>
"""
