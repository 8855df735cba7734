"""Two FMUs compared over the same experiments, interface by interface and variable by variable."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from os import PathLike
from typing import Final

import numpy as np
import pandas as pd

from pyjoystick.fmu import FmuDescription, Interface, Variable, find_fmu, read_description
from pyjoystick.motion import Difference, compare
from pyjoystick.runs.fmu_comparison.declarations import Declarations, compare_declarations
from pyjoystick.runs.fmu_comparison.experiments import (
    Experiment,
    Tolerances,
    experiments_for,
    is_joystick,
    run,
)
from pyjoystick.runs.fmu_comparison.limits import MODEL_EXCHANGE, RELATIVE_LIMIT, angle_limit, relative_limits
from pyjoystick.support import ParameterError, SimulationError, UnknownVariableError

INTERFACES: Final[tuple[Interface, ...]] = ("ModelExchange", "CoSimulation")


@dataclass(frozen=True, slots=True)
class Limits:
    """What is allowed between two FMUs.

    Attributes:
        absolute: largest difference by name of the variable, in its unit, in place of the others below
        relative: for every other variable, in parts of its largest value. The angle ``theta`` of a joystick
            has a limit of its own, see `angle_limit`: about 1e-6 rad for a release at 20 degrees.
        co_simulation: limits for Co-Simulation, by name. Nothing else is judged there: each FMU has its own
            solver and step, which may be explicit Euler at the communication step.
    """

    absolute: Mapping[str, float] = field(default_factory=dict)
    relative: float = RELATIVE_LIMIT
    co_simulation: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class RunComparison:
    """One experiment through one interface.

    Attributes:
        interface: ``ModelExchange`` or ``CoSimulation``
        experiment: its label
        differences: one per variable; their limits determine when the FMUs part
        judged: names of the variables that must keep their limit
        failures: messages of FMUs that did not reach the end of the run
    """

    interface: Interface
    experiment: str
    differences: tuple[Difference, ...] = ()
    judged: frozenset[str] = frozenset()
    failures: tuple[str, ...] = ()

    @property
    def within_limits(self) -> bool:
        """Both FMUs reached the end, and every judged variable is within its limit."""
        kept = all(one.within_limit for one in self.differences if one.variable in self.judged)
        return kept and not self.failures


@dataclass(frozen=True, slots=True)
class FmuComparison:
    """Two FMUs side by side.

    Attributes:
        first, second: the FMUs
        declarations: what they declare
        tolerances: what the integrators were asked to keep
        runs: one per interface and experiment
    """

    first: FmuDescription
    second: FmuDescription
    declarations: Declarations
    tolerances: Tolerances
    runs: tuple[RunComparison, ...]

    @property
    def within_limits(self) -> bool:
        """Every run is within its limits."""
        return all(one.within_limits for one in self.runs)


def compare_fmus(
    first: str | PathLike[str],
    second: str | PathLike[str],
    *,
    experiments: Iterable[Experiment] | None = None,
    interfaces: Iterable[Interface] | None = None,
    variables: Iterable[str] | None = None,
    limits: Limits | None = None,
    tolerances: Tolerances | None = None,
    on_run: Callable[[str], None] = lambda _: None,
) -> FmuComparison:
    """Run two FMUs through the same experiments and compare what they give.

    Args:
        first: name or path of an FMU, see `pyjoystick.fmu.find_fmu`
        second: that of the other
        experiments: what to run; by default those of `experiments_for`
        interfaces: ``ModelExchange`` (FMI 2.0, by CVode), ``CoSimulation``; by default those that both have
        variables: names of the variables to compare; by default the outputs that both have or, without any,
            the local variables that both have
        limits: what is allowed
        tolerances: what the integrators are asked to keep
        on_run: called with a description of each run before it starts

    Raises:
        FmuNotFoundError, FmuFileError, UnsupportedFmuError: an FMU cannot be opened or lacks an interface
        ParameterError: the FMUs share no interface or no variable, or a setting is not allowed
        UnknownNameError: an FMU lacks a requested variable, parameter or input
    """
    a, b = read_description(find_fmu(first)), read_description(find_fmu(second))
    declarations = compare_declarations(a, b)
    chosen = list(experiments_for(a, b) if experiments is None else experiments)
    compared = _variables(a, b, declarations, variables)
    through = _interfaces(a, b) if interfaces is None else tuple(interfaces)
    limits, tolerances = limits or Limits(), tolerances or Tolerances()
    runs = []
    for interface in through:
        for experiment in chosen:
            on_run(f"{interface}: {experiment.label}")
            runs.append(_compare_run((a, b), interface, experiment, compared, limits, tolerances))
    return FmuComparison(a, b, declarations, tolerances, tuple(runs))


def _interfaces(a: FmuDescription, b: FmuDescription) -> tuple[Interface, ...]:
    shared = tuple(
        name
        for name in INTERFACES
        if name in a.interfaces
        and name in b.interfaces
        and (name == "CoSimulation" or a.fmi_version == b.fmi_version == "2.0")
    )
    if not shared:
        has = " and ".join(f"{one.path} {' and '.join(one.interfaces) or 'none'}" for one in (a, b))
        raise ParameterError(
            "interfaces", f"none that can be run with both FMUs ({has})", "at least one in common"
        )
    return shared


def _variables(
    a: FmuDescription, b: FmuDescription, declarations: Declarations, names: Iterable[str] | None
) -> tuple[str, ...]:
    """The names of what is compared; both FMUs have them."""
    pairs = [(a.variables[name], b.variables[name]) for name in declarations.shared]
    shared = {
        part.name: (part, second)
        for first, second in pairs
        if _is_number(first) and _is_number(second) and first.shape == second.shape
        for part in first.elements()
    }
    if names is not None:
        wanted = tuple(dict.fromkeys(names))
        for name in wanted:
            if name not in shared:
                raise UnknownVariableError(name, shared)
        return wanted
    for causality in ("output", "local"):
        found = tuple(
            name
            for name, (first, second) in shared.items()
            if first.causality == second.causality == causality
            and first.variability not in ("constant", "fixed", "tunable")
        )
        if found:
            return found
    raise ParameterError("variables", "none that both FMUs have", "at least one in common")


def _is_number(variable: Variable) -> bool:
    return variable.type not in ("String", "Binary", "Clock") and variable.causality != "independent"


def _compare_run(
    fmus: tuple[FmuDescription, FmuDescription],
    interface: Interface,
    experiment: Experiment,
    variables: Sequence[str],
    limits: Limits,
    tolerances: Tolerances,
) -> RunComparison:
    tables: list[pd.DataFrame] = []
    failures: list[str] = []
    for which, fmu in zip(("first", "second"), fmus, strict=True):
        try:
            tables.append(run(fmu.path, interface, experiment, variables, tolerances))
        except SimulationError as error:
            failures.append(f"{which} FMU, {error}")
    if failures:
        return RunComparison(interface, experiment.label, failures=tuple(failures))
    # Where units differ, which the declarations say, the numbers are compared as they are.
    tables[1].attrs["units"] = tables[0].attrs["units"]
    allowed = _allowed(fmus, tables, interface, limits, tolerances)
    differences = compare(tables[0], tables[1], limits=allowed)
    judged = allowed if interface == "ModelExchange" else limits.co_simulation
    return RunComparison(interface, experiment.label, tuple(differences), frozenset(judged))


def _allowed(
    fmus: tuple[FmuDescription, FmuDescription],
    tables: Sequence[pd.DataFrame],
    interface: Interface,
    limits: Limits,
    tolerances: Tolerances,
) -> dict[str, float]:
    allowed = relative_limits(limits.relative, tables, fmus)
    if "theta" in allowed and all(map(is_joystick, fmus)):
        larger = max((table["theta"] for table in tables), key=lambda theta: float(np.max(np.abs(theta))))
        allowed["theta"] = angle_limit(larger, tolerances.model_exchange, MODEL_EXCHANGE)
    allowed.update(limits.absolute)
    if interface == "CoSimulation":
        allowed.update(limits.co_simulation)
    return allowed
