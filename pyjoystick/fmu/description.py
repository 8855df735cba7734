"""The description of an FMU, from its modelDescription.xml."""

from __future__ import annotations

import copyreg
import re
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final, Literal
from xml.parsers import expat

import numpy as np
from fmpy import read_model_description

from pyjoystick.fmu.errors import FmuFileError, UnsupportedFmuError
from pyjoystick.fmu.limits import MOST_VARIABLES, require_at_most, require_modest
from pyjoystick.motion import DisplayUnit, Quantity
from pyjoystick.support import ARCHIVE_ERRORS, PyJoystickError, archive_problem

#: What a minimum means that is no larger; Modelica.Constants.small is 1e-60.
_SMALL: Final = 1e-50
#: Value references are unsigned numbers of 32 bits in both versions of FMI.
_LARGEST_REFERENCE: Final = 0xFFFF_FFFF

Interface = Literal["CoSimulation", "ModelExchange"]


def _read_only(table: dict[str, Any]) -> MappingProxyType[str, Any]:
    return MappingProxyType(table)


# A description goes to other processes, read-only tables and all.
copyreg.pickle(MappingProxyType, lambda table: (_read_only, (dict(table),)))


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable of an FMU; absent attributes are None or an empty string.

    `start` is as written in the file; `minimum`, `maximum` and `nominal` are in `unit`, large whole numbers
    exact; `initial` is ``exact``, ``approx`` or ``calculated``. `shape` is that of an array (FMI 3), of an
    element too; `element` is the element's number, from 0. `is_fmi3` says how wide an enumeration is.
    """

    name: str
    type: str
    causality: str
    variability: str
    initial: str
    value_reference: int
    description: str
    unit: str
    display_unit: DisplayUnit | None
    start: str | None
    minimum: float | None
    maximum: float | None
    is_array: bool = False
    nominal: float = 1.0
    shape: tuple[int, ...] = ()
    element: int | None = None
    is_fmi3: bool = False

    @property
    def settable_at_start(self) -> bool:
        """A parameter, or a variable whose start value may be chosen (inputs have their own way in)."""
        if (
            self.causality in ("input", "independent", "structuralParameter")
            or self.variability == "constant"
        ):
            return False
        return self.initial in ("exact", "approx")

    def elements(self) -> tuple[Variable, ...]:
        """Those of an array, ``x[1,1]``, ``x[1,2]`` and so on, the last index first; else the variable."""
        if not self.is_array:
            return (self,)
        return tuple(
            replace(
                self, name=f"{self.name}[{','.join(str(i + 1) for i in place)}]", is_array=False, element=k
            )
            for k, place in enumerate(np.ndindex(self.shape))
        )

    @property
    def whole(self) -> str:
        """Name of the array that the variable is an element of, else its own."""
        return self.name if self.element is None else self.name.rpartition("[")[0]

    @property
    def must_be_positive(self) -> bool:
        """The minimum stands for "above zero", for which Modelica and FMI have no other way of writing."""
        return self.minimum is not None and 0.0 < self.minimum <= _SMALL

    @property
    def quantity(self) -> Quantity:
        """What a table says of it."""
        return Quantity(self.name, self.unit, self.display_unit, self.description)


@dataclass(frozen=True, slots=True)
class DefaultExperiment:
    """Settings that the FMU proposes; times in s, None where it does not say."""

    start_time: float | None
    stop_time: float | None
    tolerance: float | None
    step_size: float | None


@dataclass(frozen=True, slots=True)
class FmuDescription:
    """An FMU as its modelDescription.xml describes it.

    Attributes:
        path: the .fmu file
        model_name: qualified name of the model
        description: one line on the model
        fmi_version: such as ``2.0``
        guid: what ties binary and description together
        generation_tool, generation_date: as written, else empty
        interfaces: model identifier by interface (``CoSimulation``, ``ModelExchange``)
        binaries: files under ``binaries/``, as ``linux64/Joystick.so``
        has_sources: the C sources are inside
        variables: by name, in the order of the file
        experiment: proposed settings
        interpolates_inputs: Co-Simulation follows input derivatives within a step (FMI 2)
        asks_for_inputs: Co-Simulation asks for inputs within a step (FMI 3, intermediate update)
        variable_steps: Co-Simulation takes communication steps of different lengths
        saves_states: Co-Simulation can save its state and restore it
        one_instance: Co-Simulation can be instantiated only once in a process
        directional_derivatives, adjoint_derivatives: Co-Simulation provides them
        log_categories: names of the FMU's log categories
    """

    path: Path
    model_name: str
    description: str
    fmi_version: str
    guid: str
    generation_tool: str
    generation_date: str
    interfaces: Mapping[str, str]
    binaries: tuple[str, ...]
    has_sources: bool
    variables: Mapping[str, Variable]
    experiment: DefaultExperiment
    interpolates_inputs: bool
    variable_steps: bool
    saves_states: bool
    one_instance: bool = False
    asks_for_inputs: bool = False
    directional_derivatives: bool = False
    adjoint_derivatives: bool = False
    log_categories: tuple[str, ...] = ()

    @property
    def platforms(self) -> tuple[str, ...]:
        """Names of the platforms that there are binaries for, such as ``linux64``."""
        return tuple(sorted({file.split("/")[0] for file in self.binaries if "/" in file}))

    @property
    def takes_stop_time(self) -> bool:
        """Co-Simulation may be given a stop time; OpenModelica up to 1.14 goes there in its first step."""
        return not self.generation_tool.startswith("OpenModelica")

    def find(self, name: str) -> Variable | None:
        """A variable or an element of an array; None where there is none of that name."""
        whole = self.variables.get(name) or self.variables.get(name.rpartition("[")[0])
        return next((one for one in (whole, *whole.elements()) if one.name == name), None) if whole else None

    @property
    def is_ours(self) -> bool:
        """This project made the FMU, as it says; its instances reset, and it runs in the caller's process."""
        return self.generation_tool.split(" ")[0] == "pyjoystick"

    def names(self, causality: str) -> tuple[str, ...]:
        """Names of the variables of one causality, in the order of the file."""
        return tuple(name for name, variable in self.variables.items() if variable.causality == causality)

    def settable_names(self) -> tuple[str, ...]:
        """Names that a run takes as parameters or start values."""
        return tuple(name for name, variable in self.variables.items() if variable.settable_at_start)


def read_description(path: Path) -> FmuDescription:
    """Read the description without loading the FMU's binary; FMI 2.0 and 3.0 are supported.

    Raises:
        FmuFileError: the file is not a ZIP archive, its modelDescription.xml is missing or unreadable, or it
            is larger than `limits` allows
        UnsupportedFmuError: the FMU is of another FMI version
    """
    try:
        with zipfile.ZipFile(path) as archive:
            files = archive.namelist()
            require_modest(path, archive)
    except PyJoystickError:
        raise
    except ARCHIVE_ERRORS as error:
        raise FmuFileError(path, f"not an FMU: {archive_problem(error)}") from error
    if "modelDescription.xml" not in files:
        raise FmuFileError(path, "not an FMU: there is no modelDescription.xml in it")
    try:
        declared = _co_simulation(path)
        return _description(path, files, read_model_description(str(path), validate=False), declared)
    except FmuFileError:
        raise
    except Exception as error:  # FMPy raises whatever its parser stumbles over
        reason = f"its modelDescription.xml cannot be read: {type(error).__name__}: {error}"
        raise FmuFileError(path, reason) from error


def _co_simulation(path: Path) -> Mapping[str, str]:
    """The attributes of the element CoSimulation, empty where there is none.

    FMPy reads the description as a whole, for minutes where it is huge. So this looks at it first, and raises
    FmuFileError unless FMPy can read it: a known version of FMI, and not too many variables.
    """
    is_known, variables, found = False, 0, {}

    def start(name: str, attributes: dict[str, str]) -> None:
        nonlocal is_known, variables, found
        if not is_known:
            _require_known_version(path, name, attributes)
            is_known = True
        if name == "CoSimulation":
            found = attributes
        if "valueReference" in attributes and "name" in attributes:
            variables += 1
            require_at_most(path, "declares {} variables or more", variables, MOST_VARIABLES)

    parser = expat.ParserCreate()
    parser.StartElementHandler = start
    with zipfile.ZipFile(path) as archive, archive.open("modelDescription.xml") as file:
        parser.ParseFile(file)
    return found


def _require_known_version(path: Path, root: str, attributes: Mapping[str, str]) -> None:
    version = attributes.get("fmiVersion")
    if version is None:
        raise FmuFileError(path, f"its modelDescription.xml names no FMI version in its element {root}")
    if not re.fullmatch(r"2\.0|3\..*", version):
        raise UnsupportedFmuError(path, f"is an FMU of FMI {version}; FMI 2.0 and 3.0 are supported")


def _description(path: Path, files: list[str], model: Any, declared: Mapping[str, str]) -> FmuDescription:
    for variable in model.modelVariables:
        if not 0 <= variable.valueReference <= _LARGEST_REFERENCE:
            allowed = f"must be a whole number from 0 to {_LARGEST_REFERENCE}"
            given = f"valueReference = {variable.valueReference}"
            raise FmuFileError(path, f"variable {variable.name!r}: {given}: {allowed}")
    interfaces = {
        name: str(interface.modelIdentifier)
        for name, interface in (("CoSimulation", model.coSimulation), ("ModelExchange", model.modelExchange))
        if interface is not None
    }
    units = {unit.name: unit for unit in model.unitDefinitions or ()}
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
        variables=MappingProxyType({v.name: _variable(v, units, is_fmi3) for v in model.modelVariables}),
        experiment=DefaultExperiment(
            *(
                _number(getattr(experiment, field, None))
                for field in ("startTime", "stopTime", "tolerance", "stepSize")
            )
        ),
        interpolates_inputs=bool(getattr(model.coSimulation, "canInterpolateInputs", False)),
        variable_steps=bool(getattr(model.coSimulation, "canHandleVariableCommunicationStepSize", False)),
        # FMPy has the name of FMI 2 for both versions.
        saves_states=bool(getattr(model.coSimulation, "canGetAndSetFMUstate", False)),
        one_instance=bool(getattr(model.coSimulation, "canBeInstantiatedOnlyOncePerProcess", False)),
        asks_for_inputs=bool(getattr(model.coSimulation, "providesIntermediateUpdate", False)),
        # FMPy has the names of FMI 2 alone.
        directional_derivatives=_provides(declared, "providesDirectionalDerivative"),
        adjoint_derivatives=_provides(declared, "providesAdjointDerivative"),
        log_categories=tuple(category.name for category in model.logCategories or ()),
    )


def _provides(declared: Mapping[str, str], capability: str) -> bool:
    """Whether Co-Simulation declares a capability; its name ends in s in FMI 3."""
    return any(declared.get(name) in ("true", "1") for name in (capability, f"{capability}s"))


def _variable(variable: Any, units: Mapping[str, Any], is_fmi3: bool) -> Variable:
    """Attributes that a variable leaves out are those of its declared type."""

    def attribute(name: str) -> Any:
        own = getattr(variable, name)
        return getattr(variable.declaredType, name, None) if own is None else own

    unit = attribute("unit") or ""
    return Variable(
        name=variable.name,
        type=variable.type,
        causality=variable.causality or "local",
        variability=variable.variability or "continuous",
        initial=variable.initial or "",
        value_reference=variable.valueReference,
        description=variable.description or "",
        unit=unit,
        display_unit=_display_unit(units.get(unit), attribute("displayUnit")),
        start=variable.start,
        minimum=_bound(attribute("min")),
        maximum=_bound(attribute("max")),
        is_array=bool(variable.dimensions),
        nominal=abs(_number(attribute("nominal")) or 1.0),
        shape=tuple(variable.shape or ()),
        is_fmi3=is_fmi3,
    )


def _display_unit(unit: Any, name: str | None) -> DisplayUnit | None:
    for candidate in unit.displayUnits if unit is not None else ():
        if candidate.name == name:
            return DisplayUnit(str(name), float(candidate.factor), float(candidate.offset))
    return None


def _bound(text: object) -> float | None:
    """As `_number`, a whole number beyond the digits of a float exactly."""
    number = _number(text)
    return int(str(text)) if number is not None and abs(number) >= 2.0**53 and _is_whole(text) else number


def _is_whole(text: object) -> bool:
    return re.fullmatch(r"\s*[-+]?\d+\s*", str(text)) is not None


def _number(text: object) -> float | None:
    return None if text is None else float(str(text))
