"""Final joystick of a project, from measured and fitted values, and a check whether the two agree."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Final

from pyjoystick import identification, laboratory, model
from pyjoystick.reports.project.evaluating import BUDGET_JSON, FIT_JSON, FITTED
from pyjoystick.reports.project.laboratory import Laboratory
from pyjoystick.reports.project.measuring import MEASURED, fitted_curve
from pyjoystick.reports.project.sources import table_of
from pyjoystick.reports.project.steps import RESULTS, Done, Step, Tell, with_error
from pyjoystick.support import write_text

#: Parameter file of the final joystick.
JOYSTICK: Final = f"{RESULTS}/joystick.toml"
#: Parameters of the error budget: their keys in the parameter file by FMU name.
_BUDGETED: Final = {"J": "body.J", "damping.C": "damping.constant.C"}


def joystick(lab: Laboratory, sources: Mapping[str, str], *, with_fit: bool, with_budget: bool) -> Step:
    """Return the step that writes the joystick's parameter file, the result of the project.

    Args:
        lab: the laboratory
        sources: sources of the parameters that were measured before the fit, by FMU name
        with_fit: whether there is a fit
        with_budget: whether there is an error budget
    """
    before = FITTED if with_fit else MEASURED

    def work(tell: Tell) -> Done:
        file = model.read_parameter_file(lab.root / before)
        budgeted = _budgeted(lab) if with_budget else {}
        values = {name: one.value for name, one in budgeted.items()}
        errors = {_BUDGETED[name]: one.uncertainty for name, one in budgeted.items()}
        found = file.joystick.replace(values)
        doubts = _contradictions(lab, sources, budgeted) if with_fit else []
        texts = {table: file.sources[table] for table in (place.rpartition(".")[0] for place in errors)}
        texts = {table: f"{source}; uncertainty from the budget" for table, source in texts.items()}
        for doubt in doubts:
            table = table_of(doubt.name, found)
            texts[table] = f"{texts.get(table) or file.sources[table]}; {doubt.short}"
        title = lab.title or lab.root.resolve().name
        text = model.updated_text(file, found, title=title, uncertainties=errors, sources=texts)
        write_text(lab.root / JOYSTICK, text)
        return Done(
            files=(JOYSTICK,),
            remark=_remark(found, {**file.uncertainties, **errors}),
            notes=tuple(doubt.sentence for doubt in doubts),
        )

    return Step(
        name="joystick",
        inputs=(
            before,
            *((MEASURED, FIT_JSON) if with_fit else ()),
            *((BUDGET_JSON,) if with_budget else ()),
        ),
        outputs=(JOYSTICK,),
        settings={"title": lab.title, "sources": dict(sources) if with_fit else {}},
        work=work,
    )


def _budgeted(lab: Laboratory) -> dict[str, laboratory.Measured]:
    """Return J and C, rounded to the significant digits, with their uncertainties from the error budget."""
    fitted = identification.read_budget(lab.root / BUDGET_JSON).fitted
    found = {}
    for name in _BUDGETED:
        value, error = fitted[name]
        error = model.rounded_error(error)
        found[name] = laboratory.Measured(model.rounded(value, error), error)
    return found


def _contradictions(
    lab: Laboratory, sources: Mapping[str, str], budgeted: Mapping[str, laboratory.Measured]
) -> list[identification.Contradiction]:
    """Return the parameters whose measured and fitted values contradict each other."""
    fitted = identification.read_fit(lab.root / FIT_JSON).freely()
    both = {name: budgeted.get(name, one) for name, one in fitted.items() if name in sources}
    measured = {name: (one, sources[name]) for name, one in _measured(lab, both)}
    return list(identification.contradictions(both, measured))


def _measured(
    lab: Laboratory, names: Mapping[str, laboratory.Measured]
) -> Iterator[tuple[str, laboratory.Measured]]:
    """Yield the measured values of the named parameters, of springs with the correlations of their curve."""
    file = model.read_parameter_file(lab.root / MEASURED)
    curves = {one.table for one in model.fmu_values(file) if one.name in names} & set(lab.curves)
    springs = {
        f"{side}.{name}": laboratory.Measured(*one)
        for side in lab.curves
        if side in curves
        for name, one in fitted_curve(lab.root, lab.curves[side]).springs().items()
    }
    for one in model.fmu_values(file):
        if one.name in names:
            yield one.name, springs.get(one.name, laboratory.Measured(one.value, one.uncertainty or 0.0))


def _remark(found: model.JoystickParameters, uncertainties: Mapping[str, float]) -> str:
    """Return J and, for constant damping, C as text with their uncertainties."""
    values = found.to_names()
    return ", ".join(
        f"{name.removeprefix('damping.')} = {with_error(values[name], uncertainties.get(place, 0.0))} {unit}"
        for (name, place), unit in zip(_BUDGETED.items(), ("kg m2", "N m s/rad"), strict=True)
        if name in values
    )
