"""Systems as SSP archives (System Structure and Parameterization 1.0 and 2.0, Modelica Association)."""

from __future__ import annotations

import zipfile
from collections.abc import Callable, Collection, Iterator, Mapping
from os import PathLike
from pathlib import Path, PurePosixPath
from typing import Final
from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from pyjoystick.fmu import FmuDescription, Value, find_fmu, read_description
from pyjoystick.runs.coupling.parameter_sets import (
    ParameterNote,
    SspVersion,
    add_type,
    add_units,
    bind,
    bound_parameters,
    parameter_set,
    parameter_set_xml,
    value_of,
    xml_file,
)
from pyjoystick.runs.coupling.ssp_elements import NAMESPACES, require_known, tag
from pyjoystick.runs.coupling.system import Component, Connection, CoupledSystem
from pyjoystick.runs.errors import CouplingError
from pyjoystick.support import (
    ARCHIVE_ERRORS,
    DEFAULT_OUTPUT_INTERVAL,
    DEFAULT_TOLERANCE,
    InputFileError,
    archive_problem,
    is_number_text,
    number_of_text,
    positive,
    replacing,
    version_of,
)

_OF_EXPERIMENT: Final = frozenset(("description", "id", "startTime", "stopTime"))
_FMU_TYPE: Final = "application/x-fmu-sharedlibrary"
#: Elements that the schema does not allow to be empty.
_LISTS: Final = ("ssd:Connectors", "ssd:Elements", "ssd:Connections", "ssd:Units")

#: Limit of an archive's unpacked size (bytes).
_LARGEST: Final = 1_000_000_000
_STRUCTURE: Final = "SystemStructure.ssd"
#: The components, from the root of the structure on.
_ELEMENTS: Final = "ssd:System/ssd:Elements/*"
#: The earliest date in a ZIP archive, fixed so that equal systems give equal bytes.
_NO_DATE: Final = (1980, 1, 1, 0, 0, 0)


def write_ssp(
    system: CoupledSystem,
    path: str | PathLike[str],
    *,
    version: SspVersion = "1.0",
    notes: Mapping[str, Mapping[str, ParameterNote]] | None = None,
) -> None:
    """Write a system with its FMUs into one SSP archive, atomically.

    Args:
        system: the system
        path: the .ssp file
        version: version of the SSP standard; FMPy 0.3 and ecos 0.7 only open 1.0
        notes: notes on values, by component and parameter; the values of such components are written to
            their own files, ``resources/<component>.ssv``

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
    notes = notes or {}
    described = system.describe()
    sets = {
        f"resources/{one.name}.ssv": parameter_set_xml(one, described[one.name], notes[one.name], version)
        for one in system.components
        if one.name in notes
    }
    content = structure_xml(system, version, notes)
    with replacing(Path(path)) as temporary, zipfile.ZipFile(temporary, "w") as archive:
        _add(archive, _STRUCTURE, content)
        for name, fmu in files.items():
            _add(archive, f"resources/{name}", fmu.read_bytes())
        for name, values in sets.items():
            _add(archive, name, values)


def _add(archive: zipfile.ZipFile, name: str, content: bytes) -> None:
    entry = zipfile.ZipInfo(name, _NO_DATE)
    entry.compress_type = zipfile.ZIP_DEFLATED
    entry.external_attr = 0o644 << 16
    archive.writestr(entry, content)


def read_ssp(path: str | PathLike[str], folder: str | PathLike[str]) -> CoupledSystem:
    """Read an SSP archive with one system of FMUs that are connected output to input.

    Args:
        path: the .ssp file
        folder: receives the FMUs; created if missing

    Raises:
        InputFileError: the file is not an SSP archive, or has unsupported contents (nested systems, other
            components than FMUs, mappings, unit conversions, a start at another time than 0), which the
            message names
        FmuFileError, UnsupportedFmuError: an FMU of the archive cannot be read
    """
    path, folder = Path(path), Path(folder)
    try:
        with zipfile.ZipFile(path) as archive:
            if (size := sum(entry.file_size for entry in archive.infolist())) > _LARGEST:
                allowed = f"at most {_LARGEST / 1e9:.3g} GB are unpacked"
                raise InputFileError(path, f"declares {size / 1e9:.3g} GB; {allowed}")
            root = ElementTree.fromstring(archive.read(_STRUCTURE))
            system = system_of(path, root, folder, archive.read)
            for component in system.components:
                archive.extract(Path(component.fmu).relative_to(folder).as_posix(), folder)
            elements = root.iterfind(_ELEMENTS, NAMESPACES)
            for element, component in zip(elements, system.components, strict=True):
                _require_units(path, element, Path(component.fmu), archive.read)
    except KeyError as error:
        raise InputFileError(path, f"not a whole SSP archive: {error.args[0]}") from error
    except (ElementTree.ParseError, LookupError) as error:  # LookupError: an unknown encoding
        raise InputFileError(path, f"{_STRUCTURE} cannot be read: {error}") from error
    except ARCHIVE_ERRORS as error:
        raise InputFileError(path, f"not an SSP archive: {archive_problem(error)}") from error
    return system


def _require_units(path: Path, element: Element, fmu: Path, read: Callable[[str], bytes]) -> None:
    """Reject parameters and connectors of a component in another unit than that of the FMU's variable."""
    variables = read_description(fmu).variables
    connectors = element.iterfind("ssd:Connectors/ssd:Connector", NAMESPACES)
    for one in (*bound_parameters(path, element, read), *connectors):
        name = one.get("name", "")
        wanted = variables[name].unit if name in variables else ""
        for typed in one.iterfind("*[@unit]"):
            if wanted and typed.get("unit") != wanted:
                reason = f"{name} is in {typed.get('unit')!r}; must be in {wanted!r}, as in {fmu.name}"
                raise InputFileError(path, f"component {element.get('name')!r}: {reason}")


def structure_xml(system: CoupledSystem, version: SspVersion, in_files: Collection[str] = ()) -> bytes:
    """Make the content of SystemStructure.ssd; raises as `CoupledSystem.describe`.

    Args:
        system: the system
        version: version of the standard
        in_files: names of the components whose values are in their own files
    """
    described = system.describe()
    root = Element(
        tag("ssd:SystemStructureDescription"),
        version=version,
        name=system.name,
        generationTool=f"pyjoystick {version_of('pyjoystick')}",
    )
    top = SubElement(root, tag("ssd:System"), name=system.name, description=system.description)
    elements = SubElement(top, tag("ssd:Elements"))
    fed = {connection.target for connection in system.connections}
    for component in system.components:
        inside = described[component.name]
        _add_component(elements, component, inside, version, fed, in_file=component.name in in_files)
    connections = SubElement(top, tag("ssd:Connections"))
    for connection in system.connections:
        (start, output), (end, target) = (
            path.split(".", 1) for path in (connection.source, connection.target)
        )
        SubElement(
            connections,
            tag("ssd:Connection"),
            startElement=start,
            startConnector=output,
            endElement=end,
            endConnector=target,
        )
    _add_omsimulator(top)
    add_units(root, "ssd:Units", described.values())
    SubElement(root, tag("ssd:DefaultExperiment"), startTime="0.0", stopTime=repr(float(system.stop_time)))
    lists = [tag(name) for name in _LISTS]
    for parent in list(root.iter()):
        for empty in [child for child in parent if child.tag in lists and not len(child)]:
            parent.remove(empty)
    return xml_file(root)


def _add_omsimulator(top: Element) -> None:
    """Add the annotation without which OMSimulator refuses to run the system."""
    annotations = SubElement(top, tag("ssd:Annotations"))
    annotation = SubElement(annotations, tag("ssc:Annotation"), type="org.openmodelica")
    information = SubElement(SubElement(annotation, tag("oms:Annotations")), tag("oms:SimulationInformation"))
    SubElement(
        information,
        tag("oms:FixedStepMaster"),
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
    *,
    in_file: bool,
) -> None:
    """An FMU with connectors for its outputs and `fed` inputs; FMPy cannot open other connectors."""
    element = SubElement(
        elements,
        tag("ssd:Component"),
        name=component.name,
        description=description.description,
        type=_FMU_TYPE,
        source=f"resources/{find_fmu(component.fmu).name}",
        implementation="CoSimulation",
    )
    connectors = SubElement(element, tag("ssd:Connectors"))
    for kind in ("input", "output"):
        for name in description.names(kind):
            variable = description.variables[name]
            if variable.is_array or variable.type == "Clock":
                continue  # SSP has no connectors for them
            if kind == "input" and f"{component.name}.{name}" not in fed:
                continue
            connector = SubElement(connectors, tag("ssd:Connector"), name=name, kind=kind)
            add_type(connector, "ssc", variable)
    if component.parameters:
        inside = parameter_set(component, description, version)
        bind(element, f"resources/{component.name}.ssv" if in_file else inside)


def system_of(path: Path, root: Element, folder: Path, read: Callable[[str], bytes]) -> CoupledSystem:
    """Make the system of a SystemStructure.ssd with FMUs under `folder`; `read` reads other files.

    Raises:
        InputFileError: the XML of the archive `path` is not supported
    """
    top = root.find("ssd:System", NAMESPACES)
    if top is None:
        raise InputFileError(path, f"there is no system in its {root.tag.rpartition('}')[2]}")
    require_known(path, root, "ssd:SystemStructureDescription")
    _refuse(path, top, "ssd:ParameterBindings", "ssd:SignalDictionaries")
    experiment = root.find("ssd:DefaultExperiment", NAMESPACES)
    for name in set() if experiment is None else {*experiment.attrib} - _OF_EXPERIMENT:
        raise InputFileError(path, f"DefaultExperiment: {name!r} is not one of its attributes")
    return CoupledSystem(
        name=top.get("name", root.get("name", path.stem)),
        description=top.get("description", ""),
        components=tuple(
            _component(path, element, folder, read) for element in root.iterfind(_ELEMENTS, NAMESPACES)
        ),
        connections=tuple(_connections(path, top)),
        stop_time=_stop_time(path, experiment),
    )


def _stop_time(path: Path, experiment: Element | None) -> float:
    given = {} if experiment is None else experiment.attrib
    start, stop = given.get("startTime", "0.0"), given.get("stopTime", "1.0")
    if not is_number_text(start) or float(start) != 0.0:
        raise InputFileError(path, f"DefaultExperiment: startTime = {start!r}: must be 0 s")
    try:
        return positive("stopTime", number_of_text(stop), "s")
    except ValueError as error:
        allowed = "must be a finite number above 0 s"
        raise InputFileError(path, f"DefaultExperiment: stopTime = {stop!r}: {allowed}") from error


def _component(path: Path, element: Element, folder: Path, read: Callable[[str], bytes]) -> Component:
    name = element.get("name", "")
    kind = element.get("type", _FMU_TYPE)
    source = PurePosixPath(element.get("source", ""))
    if element.tag != tag("ssd:Component") or kind != _FMU_TYPE:
        raise InputFileError(path, f"element {name!r} is not an FMU; other elements are not supported")
    if source.is_absolute() or ".." in source.parts or source.suffix != ".fmu" or ":" in str(source):
        raise InputFileError(
            path, f"component {name!r}: its source {str(source)!r} is not an FMU in the archive"
        )
    parameters: dict[str, Value] = {}
    for one in bound_parameters(path, element, read):
        parameter = one.get("name", "")
        if parameter in parameters:
            raise InputFileError(path, f"component {name!r}: has two values for parameter {parameter!r}")
        parameters[parameter] = value_of(path, one)
    return Component(name, folder / source, parameters)


def _connections(path: Path, top: Element) -> Iterator[Connection]:
    for element in top.iterfind("ssd:Connections/ssd:Connection", NAMESPACES):
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
    for name in tags:
        if element.find(name, NAMESPACES) is not None:
            raise InputFileError(path, f"{name.partition(':')[2]} of a system are not supported")
