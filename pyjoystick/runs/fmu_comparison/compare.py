"""Comparison of two FMUs over the same experiments, for each interface and variable."""

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
    """Limits for the differences between two FMUs.

    Attributes:
        absolute: largest difference by name of the variable, in its unit; overrides the others
        relative: for all other variables, relative to their largest value. The angle ``theta`` of a joystick
            has its own limit, see `angle_limit`: about 1e-6 rad for a release at 20 degrees.
        co_simulation: limits for Co-Simulation, by name. Other variables have none there, because each FMU
            has its own solver and step, which may be explicit Euler at the communication step.
    """

    absolute: Mapping[str, float] = field(default_factory=dict)
    relative: float = RELATIVE_LIMIT
    co_simulation: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class RunComparison:
    """Comparison of one experiment through one interface.

    Attributes:
        interface: ``ModelExchange`` or ``CoSimulation``
        experiment: its label
        differences: one per variable; their limits determine when the FMUs part
        judged: names of the variables that have a limit to keep
        failures: messages of FMUs that did not reach the end of the run
    """

    interface: Interface
    experiment: str
    differences: tuple[Difference, ...] = ()
    judged: frozenset[str] = frozenset()
    failures: tuple[str, ...] = ()

    @property
    def within_limits(self) -> bool:
        """Whether both FMUs reached the end with every judged variable within its limit."""
        kept = all(one.within_limit for one in self.differences if one.variable in self.judged)
        return kept and not self.failures


@dataclass(frozen=True, slots=True)
class FmuComparison:
    """Comparison of two FMUs.

    Attributes:
        first, second: the FMUs
        declarations: comparison of their declarations
        tolerances: tolerances of the integrators
        runs: one per interface and experiment
    """

    first: FmuDescription
    second: FmuDescription
    declarations: Declarations
    tolerances: Tolerances
    runs: tuple[RunComparison, ...]

    @property
    def within_limits(self) -> bool:
        """Whether every run is within its limits."""
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
    """Run two FMUs through the same experiments and compare the results.

    Args:
        first: name or path of an FMU, see `pyjoystick.fmu.find_fmu`
        second: the other FMU
        experiments: experiments to run; by default those of `experiments_for`
        interfaces: ``ModelExchange`` (FMI 2.0, with CVode), ``CoSimulation``; by default those that both have
        variables: names of the variables to compare; by default the outputs that both have or, if there are
            none, the common local variables
        limits: limits for the differences
        tolerances: tolerances of the integrators
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
    """Names of the variables to compare, which both FMUs have."""
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
    # Numbers are compared as they are, even if units differ; the declarations report that.
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
