"""Documents on FMUs and parameter files."""

from __future__ import annotations

from typing import Final

from pyjoystick import model
from pyjoystick.reports.project.document_schemas.blocks import FMU, NUMBER, TEXTS, entry, parameters, rows, si
from pyjoystick.reports.project.editor_schemas.blocks import FLAG, TEXT, Schema, about

LAW: Final[Schema] = {"enum": list(model.PAPER.laws)}
INFO: Final[dict[str, Schema]] = {
    "fmu": FMU,
    "about": about(TEXT, "one line on the model"),
    "fmi_version": about(TEXT, "such as 2.0"),
    "interfaces": about(TEXTS, "CoSimulation, ModelExchange"),
    "platforms": about(TEXTS, "for which there are binaries"),
    "sources": about(FLAG, "the C sources are in the FMU"),
    "experiment": entry(
        start_time=si("s"), stop_time=si("s"), step_size=si("s"), tolerance=about(NUMBER, "relative")
    ),
    "variables": rows(
        name=TEXT,
        type=TEXT,
        causality=TEXT,
        variability=TEXT,
        unit=TEXT,
        start=about({"type": ["number", "string", "null"]}, "a text where it is no single number"),
        minimum=NUMBER,
        exclusive_minimum=about(FLAG, "the value must be above the minimum"),
        maximum=NUMBER,
        description=TEXT,
    ),
}
PARAMETERS: Final[dict[str, Schema]] = {
    "title": about(TEXT, "of the parameter file"),
    "damping": about(LAW, "the damping law"),
    "parameters": parameters(
        unit=TEXT,
        standard_uncertainty=about(NUMBER, "in the unit of the value"),
        source=TEXT,
        **{"from": about(TEXT, "table and key of the parameter file, or what is computed from several")},
    ),
}
_DIFFERENCES: Final = rows(
    variable=TEXT,
    unit=TEXT,
    largest=about(NUMBER, "largest difference, in the unit of the variable"),
    relative=about(NUMBER, "to the largest value"),
    time=si("s", "of the largest difference"),
    limit=NUMBER,
    parted_at=si("s", "instant at which the limit is first exceeded"),
    judged=FLAG,
    within_limit=FLAG,
)
#: Only in a comparison of two FMUs.
COMPARE_OPTIONAL: Final = ("declarations",)
COMPARE: Final[dict[str, Schema]] = {
    "fmus": {"type": "array", "items": FMU, "minItems": 1, "maxItems": 2},
    "tolerances": entry(co_simulation=NUMBER, model_exchange=NUMBER),
    "within_limits": about(FLAG, "in all runs"),
    "runs": rows(
        interface=TEXT,
        experiment=TEXT,
        within_limits=FLAG,
        failures=TEXTS,
        differences=_DIFFERENCES,
    ),
    "declarations": entry(
        **dict.fromkeys(
            ("shared", "only_first", "only_second", "internal_only_first", "internal_only_second"), TEXTS
        ),
        differences=rows(variable=TEXT, attribute=TEXT, first=TEXT, second=TEXT),
    ),
}
