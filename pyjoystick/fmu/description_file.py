"""Reading modelDescription.xml."""

from __future__ import annotations

import math
import re
import zipfile
from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final, TypeAlias
from xml.parsers import expat

from fmpy import read_model_description

from pyjoystick.fmu.description import DefaultExperiment, FmuDescription, Variable
from pyjoystick.fmu.errors import FmuFileError, UnsupportedFmuError
from pyjoystick.fmu.limits import MOST_VARIABLES, require_at_most, require_modest
from pyjoystick.fmu.values import NUMBERS
from pyjoystick.motion import DisplayUnit
from pyjoystick.support import ARCHIVE_ERRORS, PyJoystickError, archive_problem, is_number_text

#: Value references are unsigned 32-bit integers in both FMI versions.
_LARGEST_REFERENCE: Final = 0xFFFF_FFFF
#: Characters of an error of the archive or of its XML that a message repeats.
_MOST_SAID: Final = 500
#: Spellings of a true Boolean in XML.
_TRUE: Final = ("true", "1")

_DisplayUnits: TypeAlias = Mapping[tuple[str, str], DisplayUnit]


def read_description(path: Path) -> FmuDescription:
    """Read the description without loading the FMU's binary; FMI 2.0 and 3.0 are supported.

    Raises:
        FmuFileError: the file is not a ZIP archive, has paths that lead out of it, its modelDescription.xml
            is missing or unreadable, or it is larger than `limits` allows
        UnsupportedFmuError: the FMU has another FMI version
    """
    try:
        with zipfile.ZipFile(path) as archive:
            files = archive.namelist()
            require_modest(path, archive)
    except PyJoystickError:
        raise
    except ARCHIVE_ERRORS as error:
        raise FmuFileError(path, f"not an FMU: {archive_problem(error)}") from error
    for name in files:
        if "\\" in name or ":" in name or name.startswith("/") or ".." in name.split("/"):
            raise FmuFileError(path, f"contains a file whose path may lead elsewhere: {name!r}")
    if "modelDescription.xml" not in files:
        raise FmuFileError(path, "not an FMU: there is no modelDescription.xml in it")
    try:
        declared = _declared(path)
        return _description(path, files, read_model_description(str(path), validate=False), declared)
    except FmuFileError:
        raise
    except Exception as error:  # FMPy passes on any error of its parser
        said = str(error)[:_MOST_SAID]  # of a damaged archive, an error quotes whatever follows in it
        known = isinstance(error, IndexError)
        cause = "an index belongs to no variable" if known else f"{type(error).__name__}: {said}"
        reason = f"its modelDescription.xml cannot be read: {cause}"
        raise FmuFileError(path, reason) from error


@dataclass(frozen=True, slots=True)
class _Declared:
    """What FMPy leaves out.

    Attributes:
        co_simulation: attributes of CoSimulation
        inverse: display units whose scale runs backwards, as pairs of the names of unit and display unit
        in_steps: variables that may be set in Intermediate Update Mode
    """

    co_simulation: dict[str, str] = field(default_factory=dict)
    inverse: set[tuple[str, str]] = field(default_factory=set)
    in_steps: set[str] = field(default_factory=set)


def _declared(path: Path) -> _Declared:
    """Read what FMPy leaves out.

    FMPy reads the whole description, which takes minutes for a huge one. This function therefore checks it
    first, and raises FmuFileError for an unknown FMI version, too many variables, or one whose name is
    missing or another's. Elements count at their place in the standard only: annotations of tools may contain
    elements of any name.
    """
    found = _Declared()
    variables: set[str] = set()
    parents: list[str] = []  # of the element that begins, from the root on
    unit = ""

    def start(name: str, attributes: dict[str, str]) -> None:
        nonlocal unit
        if not parents:
            _require_known_version(path, name, attributes)
        elif len(parents) == 1 and name == "CoSimulation":
            found.co_simulation.update(attributes)
        elif parents[1:] == ["UnitDefinitions"]:
            unit = attributes.get("name", "")
        elif parents[1:] == ["UnitDefinitions", "Unit"] and attributes.get("inverse", "").strip() in _TRUE:
            found.inverse.add((unit, attributes.get("name", "")))
        elif parents[1:] == ["ModelVariables"]:
            _require_own_name(path, attributes, variables)
            variables.add(attributes["name"])
            if attributes.get("intermediateUpdate", "").strip() in _TRUE:
                found.in_steps.add(attributes["name"])
            require_at_most(path, "declares {} variables or more", len(variables), MOST_VARIABLES)
        elif parents[1:2] == ["ModelVariables"] and len(parents) == 3 and name == "Alias":
            _require_new_name(path, attributes.get("name", ""), variables)
            variables.add(attributes.get("name", ""))
        parents.append(name)

    parser = expat.ParserCreate()
    parser.StartElementHandler = start
    parser.EndElementHandler = lambda _: parents.pop()
    with zipfile.ZipFile(path) as archive, archive.open("modelDescription.xml") as file:
        parser.ParseFile(file)
    return found


def _require_own_name(path: Path, attributes: Mapping[str, str], others: Set[str]) -> None:
    name = attributes.get("name", "")
    if not name:
        raise FmuFileError(path, f"variable {len(others) + 1} in its modelDescription.xml has no name")
    _require_new_name(path, name, others)
    if "valueReference" not in attributes:
        raise FmuFileError(path, f"variable {name!r} in its modelDescription.xml has no valueReference")


def _require_new_name(path: Path, name: str, others: Set[str]) -> None:
    if name in others:
        raise FmuFileError(path, f"two variables in its modelDescription.xml have the name {name!r}")


def _require_known_version(path: Path, root: str, attributes: Mapping[str, str]) -> None:
    version = attributes.get("fmiVersion")
    if version is None:
        raise FmuFileError(path, f"its modelDescription.xml names no FMI version in its element {root}")
    if not re.fullmatch(r"2\.0|3\.0(\D.*)?", version):  # FMPy runs no other minor version of FMI 3
        raise UnsupportedFmuError(path, f"is an FMU of FMI {version}; FMI 2.0 and 3.0 are supported")


def _description(path: Path, files: list[str], model: Any, declared: _Declared) -> FmuDescription:
    for variable in model.modelVariables:
        if not 0 <= variable.valueReference <= _LARGEST_REFERENCE:
            allowed = f"must be a whole number from 0 to {_LARGEST_REFERENCE}"
            given = f"valueReference = {variable.valueReference}"
            raise FmuFileError(path, f"variable {variable.name!r}: {given}: {allowed}")
        if variable.type in NUMBERS and not all(map(is_number_text, (variable.start or "").split())):
            reason = f"variable {variable.name!r}: start = {variable.start!r}: must be a number"
            raise FmuFileError(path, reason)
    interfaces = {
        name: str(interface.modelIdentifier)
        for name, interface in (("CoSimulation", model.coSimulation), ("ModelExchange", model.modelExchange))
        if interface is not None
    }
    units = _display_units(model.unitDefinitions or (), declared.inverse)
    experiment = model.defaultExperiment
    is_fmi3 = not model.fmiVersion.startswith("2.")
    return FmuDescription(
        path=path,
        model_name=model.modelName or "",
        description=model.description or "",
        fmi_version=model.fmiVersion,
        guid=model.guid or "",
        generation_tool=model.generationTool or "",
        generation_date=model.generationDateAndTime or "",
        interfaces=MappingProxyType(interfaces),
        binaries=tuple(
            file.removeprefix("binaries/")
            for file in files
            if file.startswith("binaries/") and not file.endswith("/")
        ),
        has_sources=any(file.startswith("sources/") and file.endswith(".c") for file in files),
        variables=MappingProxyType(
            {v.name: _variable(v, units, is_fmi3, declared.in_steps) for v in model.modelVariables}
        ),
        experiment=DefaultExperiment(
            *(
                _number(getattr(experiment, field, None))
                for field in ("startTime", "stopTime", "tolerance", "stepSize")
            )
        ),
        interpolates_inputs=bool(getattr(model.coSimulation, "canInterpolateInputs", False)),
        variable_steps=bool(getattr(model.coSimulation, "canHandleVariableCommunicationStepSize", False)),
        # FMPy uses the FMI 2 name for both versions.
        saves_states=bool(getattr(model.coSimulation, "canGetAndSetFMUstate", False)),
        one_instance=bool(getattr(model.coSimulation, "canBeInstantiatedOnlyOncePerProcess", False)),
        asks_for_inputs=bool(getattr(model.coSimulation, "providesIntermediateUpdate", False)),
        # FMPy only knows the FMI 2 names.
        directional_derivatives=_provides(declared.co_simulation, "providesDirectionalDerivative"),
        adjoint_derivatives=_provides(declared.co_simulation, "providesAdjointDerivative"),
        log_categories=tuple(category.name for category in model.logCategories or ()),
    )


def _provides(declared: Mapping[str, str], capability: str) -> bool:
    """Whether Co-Simulation declares a capability, whose name ends in s in FMI 3."""
    return any(declared.get(name) in _TRUE for name in (capability, f"{capability}s"))


def _variable(variable: Any, units: _DisplayUnits, is_fmi3: bool, in_steps: Set[str]) -> Variable:
    """Make a variable; attributes that it omits are taken from its declared type."""

    def attribute(name: str) -> Any:
        own = getattr(variable, name)
        return getattr(variable.declaredType, name, None) if own is None else own

    unit = attribute("unit") or ""
    items = tuple(int(str(item.value)) for item in getattr(variable.declaredType, "items", None) or ())
    ends = (min(items), max(items)) if items else (None, None)
    return Variable(
        name=variable.name,
        type=variable.type,
        causality=variable.causality or "local",
        variability=variable.variability or "continuous",
        initial=variable.initial or "",
        value_reference=variable.valueReference,
        description=variable.description or "",
        unit=unit,
        display_unit=units.get((unit, attribute("displayUnit") or "")),
        start=variable.start,
        minimum=_bound(attribute("min") or ends[0]),
        maximum=_bound(attribute("max") or ends[1]),
        is_array=bool(variable.dimensions),
        nominal=abs(_number(attribute("nominal")) or 1.0),
        shape=tuple(variable.shape or ()),
        is_fmi3=is_fmi3,
        items=items,
        is_set_in_steps=variable.name in in_steps,
    )


def _display_units(definitions: Iterable[Any], inverse: Set[tuple[str, str]]) -> _DisplayUnits:
    """Display units by the names of unit and display unit.

    Inverse ones of FMI 3, as s for 1/s, are left out: they do not convert as ``factor * value + offset``,
    and a difference cannot be converted at all. So are those whose factor cannot be divided by.
    """
    return {
        (unit.name, display.name): DisplayUnit(display.name, float(display.factor), float(display.offset))
        for unit in definitions
        for display in unit.displayUnits
        if (unit.name, display.name) not in inverse and 0.0 < abs(float(display.factor)) < math.inf
    }


def _bound(text: object) -> float | None:
    """As `_number`, but exact for integers beyond the digits of a float."""
    number = _number(text)
    return int(str(text)) if number is not None and abs(number) >= 2.0**53 and _is_whole(text) else number


def _is_whole(text: object) -> bool:
    return re.fullmatch(r"\s*[-+]?\d+\s*", str(text)) is not None


def _number(text: object) -> float | None:
    return None if text is None else float(str(text))
