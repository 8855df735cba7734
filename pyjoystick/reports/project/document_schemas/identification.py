"""Documents on the identification of parameters from motions: peaks, fit, budget, design."""

from __future__ import annotations

from typing import Final

from pyjoystick.reports.project.document_schemas.blocks import (
    COUNT,
    INTERVAL,
    NUMBER,
    NUMBERS,
    TEXTS,
    entry,
    or_null,
    parameters,
    rows,
    si,
)
from pyjoystick.reports.project.editor_schemas.blocks import FLAG, TEXT, Schema, about, array, mapping

_MATRIX: Final = about(array(NUMBERS, 0), "in the order of the parameters")
_WITH_BIAS: Final = rows(
    name=TEXT,
    estimate=NUMBER,
    returned=about(NUMBER, "what the method makes of a simulation with the estimate"),
    corrected=NUMBER,
    bias=NUMBER,
    interval=or_null(INTERVAL),
)
PEAKS: Final[dict[str, Schema]] = {
    "releases": rows(
        name=TEXT,
        release_time=si("s"),
        release_angle=si("rad"),
        release_time_error=si("s", "standard error"),
        release_angle_error=si("rad", "standard error"),
        noise=si("rad"),
    ),
    "constants": about(_WITH_BIAS, "C from displacement peaks, velocity peaks and both, in N.m.s/rad"),
    "lines": about(_WITH_BIAS, "of eq. (11): coefficients, in N.m.s/rad, and exponents"),
    "left_out": about(COUNT, "points without a logarithm"),
}
_PROFILE: Final = entry(
    interval=INTERVAL,
    values=NUMBERS,
    distances=NUMBERS,
    at_bound=array(FLAG, 2, 2),
    undercut=NUMBER,
    followed=FLAG,
)
_FITTED: Final = rows(
    "profile",
    "bootstrap_error",
    "bootstrap_interval",
    name=about(TEXT, "as in the FMU, or release_time, zero_offset, delay"),
    record={"type": ["string", "null"], "description": "null: shared by all records"},
    unit=TEXT,
    value=NUMBER,
    standard_error=about(NUMBER, "null: not determined"),
    interval=INTERVAL,
    determined=FLAG,
    profile=_PROFILE,
    bootstrap_error=NUMBER,
    bootstrap_interval=INTERVAL,
)
_RECORD: Final = rows(
    name=TEXT,
    noise=about(mapping(NUMBER), "standard deviation by output"),
    torque_noise=si("N.m", "standard deviation of the noise of the torque that drives the FMU; 0: none seen"),
    labels=about(TEXTS, "the output of each sample; in a fit of peaks, the peak"),
    times=NUMBERS,
    data=NUMBERS,
    fit=NUMBERS,
    fit_error=or_null(NUMBERS),
    curve=about(or_null(mapping(NUMBERS)), "`time`, in s, and the outputs of the fitted motion"),
)
FIT: Final[dict[str, Schema]] = {
    "trusted": about(FLAG, "every check passed"),
    "interrupted": about(FLAG, "it was stopped before its end"),
    "parameters": _FITTED,
    "tied": rows(name=TEXT, record={"type": ["string", "null"]}, value=NUMBER, standard_error=NUMBER),
    "correlation": _MATRIX,
    "sum_of_squares": about(NUMBER, "of the residuals, in standard deviations of the noise"),
    "degrees_of_freedom": about({"type": "integer"}, "samples less fitted values"),
    "criteria": or_null(
        entry(log_likelihood=NUMBER, parameters=COUNT, samples=COUNT, aicc=NUMBER, bic=NUMBER)
    ),
    "identifiability": entry(singular_values=NUMBERS, condition=NUMBER, rank=COUNT, open=TEXTS, weakest=TEXT),
    "minima": rows(x=NUMBERS, sum_of_squares=NUMBER, searches=COUNT, converged=FLAG),
    "checks": rows(name=TEXT, passed=FLAG, message=TEXT),
    "unseen": about(
        rows(suspect=TEXT, size=TEXT, parameter=TEXT, part=NUMBER, errors=NUMBER),
        "what the records would hardly show: by what part it moves a parameter, and by how many errors",
    ),
    "records": _RECORD,
    "noise_correlation": about(NUMBER, "from sample to sample; 0: white"),
    "derivatives": entry(steps=NUMBERS, errors=NUMBERS, noise=NUMBER, tolerance=NUMBER),
    "runs": about(COUNT, "runs of the FMU"),
    "seconds": si("s", "of the computer"),
    "settings": about({"type": "object"}, "of the fit, with the names of `FitSettings`"),
}
BUDGET: Final[dict[str, Schema]] = {
    "trusted": about(FLAG, "the fit passed every check"),
    "parameters": parameters(unit=TEXT, standard_uncertainty=NUMBER),
    "contributions": rows(
        stage=TEXT,
        theta=si("rad", "rms"),
        omega=si("rad/s", "rms"),
        period=about(NUMBER, "relative"),
        J=about(NUMBER, "relative"),
        C=about(NUMBER, "relative"),
    ),
    "exact": about(TEXTS, "what was taken as exact"),
}
DESIGN: Final[dict[str, Schema]] = {
    "designs": rows(
        name=TEXT,
        experiments=rows(name=TEXT, count=COUNT),
        parameters=parameters(standard_error=about(NUMBER, "in the unit of the FMU")),
        covariance=_MATRIX,
    ),
    "check": or_null(
        entry(sets=COUNT, parameters=rows(name=TEXT, scatter_over_standard_error=NUMBER)),
    ),
}
