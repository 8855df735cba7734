"""Systems as SSP archives (System Structure and Parameterization 1.0 and 2.0, Modelica Association)."""

from __future__ import annotations

import zipfile
from collections.abc import Collection, Iterable, Iterator
from os import PathLike
from pathlib import Path, PurePosixPath
from typing import Final, Literal
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from fmpy import read_model_description

from pyjoystick.fmu import INTEGERS, REALS, FmuDescription, Value, Variable, find_fmu
from pyjoystick.runs.coupling.system import Component, Connection, CoupledSystem
from pyjoystick.runs.errors import CouplingError
from pyjoystick.support import (
    ARCHIVE_ERRORS,
    DEFAULT_OUTPUT_INTERVAL,
    DEFAULT_TOLERANCE,
    InputFileError,
    archive_problem,
    positive,
    replacing,
    version_of,
)

SspVersion = Literal["1.0", "2.0"]
#: The namespaces of both versions of the standard, and OMSimulator's; tools look for these very prefixes.
_NAMESPACES: Final = {
    "ssc": "http://ssp-standard.org/SSP1/SystemStructureCommon",
    "ssd": "http://ssp-standard.org/SSP1/SystemStructureDescription",
    "ssv": "http://ssp-standard.org/SSP1/SystemStructureParameterValues",
    "oms": "https://raw.githubusercontent.com/OpenModelica/OMSimulator/master/schema/oms.xsd",
}
_FMU_TYPE: Final = "application/x-fmu-sharedlibrary"
_BASE_UNITS: Final = ("kg", "m", "s", "A", "K", "mol", "cd", "rad", "factor", "offset")
#: What the schema allows only with something in it.
_LISTS: Final = ("ssd:Connectors", "ssd:Elements", "ssd:Connections", "ssd:Units")

#: One name for the values of all components: ecos applies the sets of one name, which it is given.
_PARAMETERS: Final = "parameters"
#: What an archive may unpack to (bytes).
_LARGEST: Final = 1_000_000_000
_STRUCTURE: Final = "SystemStructure.ssd"
#: The least date that a ZIP archive can hold: equal systems give equal bytes.
_NO_DATE: Final = (1980, 1, 1, 0, 0, 0)


def write_ssp(system: CoupledSystem, path: str | PathLike[str], *, version: SspVersion = "1.0") -> None:
    """Write a system with its FMUs into one SSP archive, whole or not at all.

    Args:
        system: what to write
        path: the .ssp file
        version: of the SSP standard; FMPy 0.3 and ecos 0.7 open 1.0 only

    Raises:
        CouplingError, FmuNotFoundError, FmuFileError, ParameterError, UnknownParameterError: as
            `CoupledSystem.describe`, or two different FMUs have the same file name
        OutputFileError: the file cannot be written
    """
    files: dict[str, Path] = {}
    for component in system.components:
        file = find_fmu(component.fmu)
        if not files.setdefault(file.name, file).samefile(file):
            reason = f"another FMU of the system is called {file.name} too; rename one of the files"
            raise CouplingError(system.name, component.name, reason)
    content = structure_xml(system, version)
    with replacing(Path(path)) as temporary, zipfile.ZipFile(temporary, "w") as archive:
        _add(archive, _STRUCTURE, content)
        for name, fmu in files.items():
            _add(archive, f"resources/{name}", fmu.read_bytes())


def _add(archive: zipfile.ZipFile, name: str, content: bytes) -> None:
    entry = zipfile.ZipInfo(name, _NO_DATE)
    entry.compress_type = zipfile.ZIP_DEFLATED
    entry.external_attr = 0o644 << 16
    archive.writestr(entry, content)


def read_ssp(path: str | PathLike[str], folder: str | PathLike[str]) -> CoupledSystem:
    """Read an SSP archive whose components are FMUs, connected output to input, in one system.

    Args:
        path: the .ssp file
        folder: receives the FMUs; made where it is missing

    Raises:
        InputFileError: the file is no SSP archive, or holds what this reader does not understand (systems
            within systems, other components than FMUs, parameter files, unit conversions): it is named
    """
    path, folder = Path(path), Path(folder)
    try:
        with zipfile.ZipFile(path) as archive:
            if (size := sum(entry.file_size for entry in archive.infolist())) > _LARGEST:
                allowed = f"at most {_LARGEST / 1e9:.3g} GB are unpacked"
                raise InputFileError(path, f"declares {size / 1e9:.3g} GB; {allowed}")
            system = system_of(path, ElementTree.fromstring(archive.read(_STRUCTURE)), folder)
            for component in system.components:
                archive.extract(Path(component.fmu).relative_to(folder).as_posix(), folder)
    except KeyError as error:
        raise InputFileError(path, f"not a whole SSP archive: {error.args[0]}") from error
    except (ElementTree.ParseError, LookupError) as error:  # LookupError: an unknown encoding
        raise InputFileError(path, f"{_STRUCTURE} cannot be read: {error}") from error
    except ARCHIVE_ERRORS as error:
        raise InputFileError(path, f"not an SSP archive: {archive_problem(error)}") from error
    return system


def structure_xml(system: CoupledSystem, version: SspVersion) -> bytes:
    """The content of SystemStructure.ssd; raises as `CoupledSystem.describe`."""
    described = system.describe()
    for prefix, uri in _NAMESPACES.items():
        ElementTree.register_namespace(prefix, uri)
    root = Element(
        _tag("ssd:SystemStructureDescription"),
        version=version,
        name=system.name,
        generationTool=f"pyjoystick {version_of('pyjoystick')}",
    )
    top = SubElement(root, _tag("ssd:System"), name=system.name, description=system.description)
    elements = SubElement(top, _tag("ssd:Elements"))
    fed = {connection.target for connection in system.connections}
    for component in system.components:
        _add_component(elements, component, described[component.name], version, fed)
    connections = SubElement(top, _tag("ssd:Connections"))
    for connection in system.connections:
        (start, output), (end, target) = (
            path.split(".", 1) for path in (connection.source, connection.target)
        )
        SubElement(
            connections,
            _tag("ssd:Connection"),
            startElement=start,
            startConnector=output,
            endElement=end,
            endConnector=target,
        )
    _add_omsimulator(top)
    _add_units(root, described.values())
    SubElement(root, _tag("ssd:DefaultExperiment"), startTime="0.0", stopTime=repr(float(system.stop_time)))
    lists = [_tag(name) for name in _LISTS]
    for parent in list(root.iter()):
        for empty in [child for child in parent if child.tag in lists and not len(child)]:
            parent.remove(empty)
    ElementTree.indent(root)
    content: bytes = ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True)
    return content + b"\n"


def _add_omsimulator(top: Element) -> None:
    """Without this annotation OMSimulator takes the system for none that it can run."""
    annotations = SubElement(top, _tag("ssd:Annotations"))
    annotation = SubElement(annotations, _tag("ssc:Annotation"), type="org.openmodelica")
    information = SubElement(
        SubElement(annotation, _tag("oms:Annotations")), _tag("oms:SimulationInformation")
    )
    SubElement(
        information,
        _tag("oms:FixedStepMaster"),
        description="oms-ma",
        stepSize=str(DEFAULT_OUTPUT_INTERVAL),
        absoluteTolerance=str(DEFAULT_TOLERANCE),
        relativeTolerance=str(DEFAULT_TOLERANCE),
    )


def _add_component(
    elements: Element,
    component: Component,
    description: FmuDescription,
    version: SspVersion,
    fed: Collection[str],
) -> None:
    """An FMU with connectors for its outputs and the inputs that are `fed`; FMPy cannot open any others."""
    element = SubElement(
        elements,
        _tag("ssd:Component"),
        name=component.name,
        description=description.description,
        type=_FMU_TYPE,
        source=f"resources/{find_fmu(component.fmu).name}",
        implementation="CoSimulation",
    )
    connectors = SubElement(element, _tag("ssd:Connectors"))
    for kind in ("input", "output"):
        for name in description.names(kind):
            variable = description.variables[name]
            if variable.is_array or variable.type == "Clock":
                continue  # SSP has no connectors for them
            if kind == "input" and f"{component.name}.{name}" not in fed:
                continue
            connector = SubElement(connectors, _tag("ssd:Connector"), name=name, kind=kind)
            _add_type(connector, "ssc", variable)
    if component.parameters:
        bindings = SubElement(element, _tag("ssd:ParameterBindings"))
        values = SubElement(SubElement(bindings, _tag("ssd:ParameterBinding")), _tag("ssd:ParameterValues"))
        parameters = SubElement(values, _tag("ssv:ParameterSet"), version=version, name=_PARAMETERS)
        parameters = SubElement(parameters, _tag("ssv:Parameters"))
        for name, value in component.parameters.items():
            parameter = SubElement(parameters, _tag("ssv:Parameter"), name=name)
            _add_type(parameter, "ssv", description.variables[name]).set("value", _text(value))


def _add_type(parent: Element, prefix: str, variable: Variable) -> Element:
    kind = "Real" if variable.type in REALS else "Integer" if variable.type in INTEGERS else variable.type
    element = SubElement(parent, _tag(f"{prefix}:{kind}"))
    if kind == "Real" and variable.unit:
        element.set("unit", variable.unit)
    return element


def _text(value: Value) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)


def _add_units(root: Element, descriptions: Iterable[FmuDescription]) -> None:
    """Every unit that an FMU declares, by its exponents of the SI base units."""
    declared = {
        unit.name: unit.baseUnit
        for description in descriptions
        for unit in read_model_description(str(description.path), validate=False).unitDefinitions
    }
    units = SubElement(root, _tag("ssd:Units"))
    for name, base in sorted(declared.items()):
        unit = SubElement(units, _tag("ssc:Unit"), name=name)
        exponents = {key: str(getattr(base, key)) for key in _BASE_UNITS if base is not None}
        SubElement(
            unit, _tag("ssc:BaseUnit"), {k: v for k, v in exponents.items() if float(v) != (k == "factor")}
        )


def system_of(path: Path, root: Element, folder: Path) -> CoupledSystem:
    """The system of a SystemStructure.ssd, its FMUs as files under `folder`.

    Raises:
        InputFileError: the XML of the archive `path` has something that is not supported
    """
    top = root.find("ssd:System", _NAMESPACES)
    if top is None:
        raise InputFileError(path, f"there is no system in its {root.tag.rpartition('}')[2]}")
    _refuse(path, top, "ssd:ParameterBindings", "ssd:SignalDictionaries")
    elements = top.findall("ssd:Elements/*", _NAMESPACES)
    experiment = root.find("ssd:DefaultExperiment", _NAMESPACES)
    return CoupledSystem(
        name=top.get("name", root.get("name", path.stem)),
        description=top.get("description", ""),
        components=tuple(
            _component(path, element, folder) for element in ([] if elements is None else elements)
        ),
        connections=tuple(_connections(path, top)),
        stop_time=_stop_time(path, experiment),
    )


def _stop_time(path: Path, experiment: Element | None) -> float:
    text = "1.0" if experiment is None else experiment.get("stopTime", "1.0")
    try:
        return positive("stopTime", float(text), "s")
    except ValueError as error:
        allowed = "must be a finite number above 0 s"
        raise InputFileError(path, f"DefaultExperiment: stopTime = {text!r}: {allowed}") from error


def _component(path: Path, element: Element, folder: Path) -> Component:
    name = element.get("name", "")
    kind = element.get("type", _FMU_TYPE)
    source = PurePosixPath(element.get("source", ""))
    if element.tag != _tag("ssd:Component") or kind != _FMU_TYPE:
        raise InputFileError(path, f"element {name!r} is not an FMU; other elements are not supported")
    if source.is_absolute() or ".." in source.parts or source.suffix != ".fmu" or ":" in str(source):
        raise InputFileError(
            path, f"component {name!r}: its source {str(source)!r} is not an FMU in the archive"
        )
    return Component(name, folder / source, dict(_parameters(path, element)))


def _parameters(path: Path, element: Element) -> Iterator[tuple[str, Value]]:
    for binding in element.iterfind("ssd:ParameterBindings/ssd:ParameterBinding", _NAMESPACES):
        if binding.get("source") or binding.get("prefix") or len(binding) != 1:
            reason = "parameters from a file, with a prefix or a mapping are not supported"
            raise InputFileError(path, f"component {element.get('name')!r}: {reason}")
        for parameter in binding.iterfind(".//ssv:Parameter", _NAMESPACES):
            yield parameter.get("name", ""), _value(path, parameter)


def _value(path: Path, parameter: Element) -> Value:
    typed = next(iter(parameter), Element("}no type"))
    kind, text = typed.tag.rpartition("}")[2], typed.get("value", "")
    try:
        if kind in ("Real", "Float64", "Float32"):
            return float(text)
        if kind in INTEGERS:
            return int(text)
        if kind == "Boolean":
            return {"true": True, "1": True, "false": False, "0": False}[text]
    except (KeyError, ValueError):
        kind = f"{kind} {text!r}"
    if kind == "String":
        return text
    raise InputFileError(path, f"parameter {parameter.get('name')!r}: a value of {kind} is not supported")


def _connections(path: Path, top: Element) -> Iterator[Connection]:
    for element in top.iterfind("ssd:Connections/ssd:Connection", _NAMESPACES):
        ends = [element.get(key) for key in ("startElement", "startConnector", "endElement", "endConnector")]
        if None in ends:
            raise InputFileError(
                path, f"connection {element.attrib}: only those between components are supported"
            )
        transformations = [child for child in element if child.tag.endswith("Transformation")]
        if transformations:
            raise InputFileError(path, f"connection {element.attrib}: transformations are not supported")
        yield Connection(f"{ends[0]}.{ends[1]}", f"{ends[2]}.{ends[3]}")


def _refuse(path: Path, element: Element, *tags: str) -> None:
    for tag in tags:
        if element.find(tag, _NAMESPACES) is not None:
            raise InputFileError(path, f"{tag.partition(':')[2]} of a system are not supported")


def _tag(name: str) -> str:
    prefix, _, local = name.partition(":")
    return f"{{{_NAMESPACES[prefix]}}}{local}"
