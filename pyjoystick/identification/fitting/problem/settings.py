"""Settings of a fit: free parameters, what is compared, noise, search, uncertainty."""

from __future__ import annotations

import math
from collections.abc import Mapping, Set
from dataclasses import dataclass, field, replace
from typing import Final, Literal, get_args

from pyjoystick.fmu import Value
from pyjoystick.identification.fitting.problem.instrument import (
    ANGLE_SCALE,
    DELAY,
    INSTRUMENT,
    RELEASE_TIME,
    TIME_BASE,
)
from pyjoystick.support import ParameterError, finite, positive, whole_number

Comparison = Literal["trajectory", "peaks"]
Resampling = Literal["records", "residuals"]
#: Dry friction that does not depend on the speed: its parameters in the FMUs.
_SLIDING: Final = ("friction.T_c", "friction.F_c")


@dataclass(frozen=True, slots=True)
class Free:
    """A fitted parameter.

    Attributes:
        name: a parameter or start value of the FMU, or a number of the `Instrument`
        start: start of the search, in the unit of the FMU; if None, the FMU's own value or, for the
            release of a free oscillation, a guess from each record
        minimum, maximum: bounds; if None, those of the FMU or, for the release, a range about the guess
        per_record: one value for each record, as for the release, instead of one for all
        uncertainty: standard uncertainty of `start`, if that was measured independently of the records;
            it then counts as one more measurement, normally distributed

    Raises:
        ParameterError: a value is not finite, the start is not within the bounds, or an uncertainty is not
            above 0 or has no start
    """

    name: str
    start: float | None = None
    minimum: float | None = None
    maximum: float | None = None
    per_record: bool = False
    uncertainty: float | None = None

    def __post_init__(self) -> None:
        for what in ("start", "minimum", "maximum"):
            value = getattr(self, what)
            if value is not None:
                object.__setattr__(self, what, finite(f"{self.name}.{what}", value))
        low = -math.inf if self.minimum is None else self.minimum
        high = math.inf if self.maximum is None else self.maximum
        if low >= high:
            raise ParameterError(f"{self.name}.minimum", low, f"below the maximum, {high:g}")
        if self.start is not None and not low <= self.start <= high:
            raise ParameterError(f"{self.name}.start", self.start, f"from {low:g} to {high:g}")
        if self.uncertainty is not None:
            positive(f"{self.name}.uncertainty", self.uncertainty)
            if self.start is None or self.per_record:
                allowed = "left out without a start that all records share"
                raise ParameterError(f"{self.name}.uncertainty", self.uncertainty, allowed)

    def starting_at(self, start: float) -> Free:
        """The same with another start, and room above it where the maximum leaves little.

        The bounds of the usual fits suit joysticks like the paper's; an excavator's lever has more damping.
        """
        cramped = self.maximum is not None and 2.0 * start > self.maximum
        return replace(self, start=start, maximum=10.0 * start if cramped and start > 0.0 else self.maximum)


@dataclass(frozen=True, slots=True)
class Noise:
    """What is known or assumed about the noise.

    Attributes:
        sigma: standard deviation by output, in the unit of the output; if empty, it is estimated from the
            residuals
        per_record: estimate it for each record separately, so that a noisy record counts less
        colored: allow for autocorrelation: if there is any, the noise is modelled as first-order
            autoregressive with an estimated correlation; otherwise it is taken to be white
        robust: reduce the weights of outliers, if there are any (Hampel's weights)
    """

    sigma: Mapping[str, float] = field(default_factory=dict)
    per_record: bool = False
    colored: bool = True
    robust: bool = True

    def __post_init__(self) -> None:
        for name, value in self.sigma.items():
            positive(f"noise.sigma.{name}", value)
        if self.sigma and self.per_record:
            raise ParameterError("noise.per_record", True, "left out where sigma is given")


@dataclass(frozen=True, slots=True)
class Search:
    """How to search for the minimum.

    Attributes:
        starts: number of searches: the first from the start values, the others from a Latin hypercube over
            the bounds of the parameters that all records share
        seed: seed of the hypercube and of the bootstrap
        evaluations: maximum number of evaluations of the residuals in one search
        stages: parts of the records on which each search begins, see `staged_search`; increasing, below 1
        exchanges: pairs of free parameters, such as those of the two sides of a mechanism, whose values are
            exchanged at the start of a last search
        scan: parameters that are multiplied by a range of common factors after the search, if a motion
            comes to rest within its record, see `scan`; if None, the fitted dry friction of the joystick
    """

    starts: int = 1
    seed: int = 0
    evaluations: int = 200
    stages: tuple[float, ...] = (0.3, 0.6)
    exchanges: tuple[tuple[str, str], ...] = ()
    scan: tuple[str, ...] | None = None

    def __post_init__(self) -> None:
        whole_number("search.starts", self.starts, 1)
        whole_number("search.seed", self.seed, 0)
        whole_number("search.evaluations", self.evaluations, 2)
        before = 0.0
        for stage in self.stages:
            if not before < finite("search.stages", stage) < 1.0:
                raise ParameterError("search.stages", list(self.stages), "increasing, between 0 and 1")
            before = stage
        for pair in self.exchanges:
            if not _names(pair) or len(pair) != 2:
                raise ParameterError("search.exchanges", pair, "pairs of names")
        if not _names(self.scan or ()):
            raise ParameterError("search.scan", self.scan, "names of parameters")


@dataclass(frozen=True, slots=True)
class Uncertainty:
    """What to compute in addition to standard errors.

    Attributes:
        level: confidence level of all intervals
        profiles: names of shared parameters whose profile likelihood is computed; if None, all of them
        bootstrap: number of bootstrap fits, 0 for none
        resampling: what the bootstrap resamples: whole records, or the residuals within each record
    """

    level: float = 0.95
    profiles: tuple[str, ...] | None = None
    bootstrap: int = 0
    resampling: Resampling = "records"

    def __post_init__(self) -> None:
        if not 0.0 < finite("uncertainty.level", self.level) < 1.0:
            raise ParameterError("uncertainty.level", self.level, "between 0 and 1")
        if not _names(self.profiles or ()):
            raise ParameterError("uncertainty.profiles", self.profiles, "names of parameters")
        whole_number("uncertainty.bootstrap", self.bootstrap, 0)
        if self.resampling not in get_args(Resampling):
            raise ParameterError("uncertainty.resampling", self.resampling, "'records' or 'residuals'")


@dataclass(frozen=True, slots=True, kw_only=True)
class FitSettings:
    """A fit of an FMU's parameters to records.

    Attributes:
        fmu: name or path of a Co-Simulation FMU
        free: the fitted parameters
        fixed: values of other parameters, in the units of the FMU
        ties: parameters computed from others, as expressions in their names; a fixed ratio is
            ``{"damping.A_neg": "0.4 * damping.A_pos"}``
        outputs: the outputs that are compared; the records must have them as columns
        derivatives: output that is the time derivative of another; required for a free release time
        inputs: columns of the records that drive inputs of the FMU, linear between the samples
        comparison: ``trajectory`` compares every sample, ``peaks`` the heights and times of the first peaks
            relative to the measured ones as in eqs. (12a, b), by least squares
        peaks: number of peaks to compare
        tolerance: relative tolerance of the FMU's integrator
        noise, search, uncertainty: see the classes

    Raises:
        ParameterError: nothing is free, a name is given twice, or a choice does not exist
    """

    fmu: str
    free: tuple[Free, ...]
    fixed: Mapping[str, Value] = field(default_factory=dict)
    ties: Mapping[str, str] = field(default_factory=dict)
    outputs: tuple[str, ...] = ("theta",)
    derivatives: Mapping[str, str] = field(default_factory=lambda: {"theta": "omega", "omega": "alpha"})
    inputs: tuple[str, ...] = ()
    comparison: Comparison = "trajectory"
    peaks: int = 9
    tolerance: float = 1e-8
    noise: Noise = field(default_factory=Noise)
    search: Search = field(default_factory=Search)
    uncertainty: Uncertainty = field(default_factory=Uncertainty)

    def __post_init__(self) -> None:
        if not self.free:
            raise ParameterError("free", "nothing", "one parameter or more")
        given: set[str] = set()
        for name in (*(one.name for one in self.free), *self.fixed, *self.ties):
            if name in given:
                raise ParameterError(name, "given twice", "free, fixed or tied, one of the three")
            given.add(name)
        if not self.outputs:
            raise ParameterError("outputs", "nothing", "one output or more")
        if self.comparison not in get_args(Comparison):
            raise ParameterError("comparison", self.comparison, "'trajectory' or 'peaks'")
        if self.comparison == "peaks":
            self._check_peaks()
        for name in self.noise.sigma:
            if name not in self.outputs:
                raise ParameterError("noise.sigma", name, f"one of the outputs, {', '.join(self.outputs)}")
        self._check_names()
        self._check_instrument(given)
        whole_number("peaks", self.peaks, 2)
        positive("tolerance", self.tolerance)

    @property
    def scanned(self) -> tuple[str, ...]:
        """Parameters of `Search.scan`, by default the fitted dry friction."""
        if self.search.scan is not None:
            return self.search.scan
        return tuple(one.name for one in self.free if one.name in _SLIDING and not one.per_record)

    def _check_peaks(self) -> None:
        if len(self.outputs) != 1:
            raise ParameterError("outputs", self.outputs, "one output where peaks are compared")
        if self.noise.sigma:
            allowed = "left out where peaks are compared, whose relative errors are estimated"
            raise ParameterError("noise.sigma", dict(self.noise.sigma), allowed)

    def _check_instrument(self, given: Set[str]) -> None:
        """Check that the instrument's numbers match the comparison."""
        for name in (RELEASE_TIME, TIME_BASE) if self.inputs else ():
            if name in given:
                raise ParameterError(name, "given", "left out where inputs drive the FMU")
        if DELAY in given and not self.inputs:
            raise ParameterError(DELAY, "given", "left out where no input drives the FMU")
        if ANGLE_SCALE in given and self.comparison == "peaks":
            raise ParameterError(ANGLE_SCALE, "given", "left out where peaks are compared")
        for name in self.ties:
            if name in INSTRUMENT:
                raise ParameterError(f"ties.{name}", self.ties[name], "fixed or free, not tied")

    def _check_names(self) -> None:
        """Check that the exchanged and profiled parameters are free ones."""
        free = [one.name for one in self.free]
        for name in (name for pair in self.search.exchanges for name in pair):
            if name not in free:
                allowed = f"among the free parameters, {', '.join(free)}"
                raise ParameterError("search.exchanges", name, allowed)
        shared = [one.name for one in self.free if not one.per_record]
        named = {
            "search.scan": self.search.scan or (),
            "uncertainty.profiles": self.uncertainty.profiles or (),
        }
        for field_name, name in ((where, name) for where, names in named.items() for name in names):
            if name not in shared:
                allowed = f"among the parameters that all records share, {', '.join(shared)}"
                raise ParameterError(field_name, name, allowed)


def _names(given: object) -> bool:
    """Whether an object is a tuple of names."""
    return isinstance(given, tuple) and all(isinstance(name, str) for name in given)
