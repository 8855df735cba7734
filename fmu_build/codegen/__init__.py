"""Generate C source for the runtime's model.h from a model that rumoca has compiled."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from fmu_build.codegen.annotations import default_experiment, documentation, terminals
from fmu_build.codegen.baked import baked_parameters
from fmu_build.codegen.c_model import write_model
from fmu_build.codegen.compact import compact
from fmu_build.codegen.coordinates import with_named_states
from fmu_build.codegen.equation_reader import n_named_slots, read_equations
from fmu_build.codegen.equations import Equations
from fmu_build.codegen.followed import with_followed_parameters
from fmu_build.codegen.functions import FunctionLibrary
from fmu_build.codegen.held_values import with_values_from_before
from fmu_build.codegen.left_limits import reject_left_limits_of_inputs
from fmu_build.codegen.lowered import LoweredModel, lower
from fmu_build.codegen.names import modelica_texts
from fmu_build.codegen.open_connectors import without_open_connectors
from fmu_build.codegen.rejections import reject_unsupported
from fmu_build.codegen.second_reading.results import Row, kept_texts, mistaken_results
from fmu_build.codegen.sensitivities import extend, find_wanted
from fmu_build.codegen.source import ModelSource
from fmu_build.codegen.start_values import StartValues
from fmu_build.codegen.state_choice import reject_other_states
from fmu_build.codegen.structure import Structure
from fmu_build.codegen.tables import reject_unsupported_tables
from fmu_build.codegen.tangents import NoTangentsError, Tangents
from fmu_build.codegen.trials import Trials
from fmu_build.codegen.variables import StoredVariable, VariableReader
from fmu_build.support.description import GeneratedModel, ModelDescription
from fmu_build.support.errors import UnsupportedModelError
from fmu_build.support.request import SensitivityRequest

__all__ = ["ModelSource", "check_results", "generate"]

_MOST_TEXTS = 5


def generate(source: ModelSource, sensitivity: SensitivityRequest | None = None) -> GeneratedModel:
    """Return the C source and the description of a compiled model, with sensitivities if they are requested.

    Raises `UnsupportedModelError` with the name and line of an unsupported construct.
    """
    model = _read(lower(source.model))
    unchecked = _unchecked(model.unchecked)
    trials = Trials(source, model.lowered, model.starts)
    followed = with_followed_parameters(source, model.lowered, trials)
    if followed is not None:
        source, lowered = followed
        model = _read(lowered)
        trials = Trials(source, lowered, model.starts)
    lowered, functions, equations, left_out, starts, _ = model
    baked = baked_parameters(trials)
    variables = VariableReader(lowered, equations, starts, baked, left_out).read()
    if sensitivity is not None:
        wanted = find_wanted(lowered.name, variables, sensitivity)
        extended = extend(lowered, equations, variables, wanted)
        lowered, equations = extended.model, extended.equations
        starts = StartValues(lowered)
        variables = extended.marked(VariableReader(lowered, equations, starts, baked, left_out).read())
    structure = Structure(equations, variables)
    texts = modelica_texts(lowered, equations)
    written = with_values_from_before(equations)
    tangents, notes = _tangents(equations, variables)
    description = ModelDescription(
        model_name=lowered.name,
        description=lowered.flat.get("model_description") or "",
        variables=tuple(stored.variable for stored in variables),
        outputs=structure.outputs(),
        derivatives=structure.derivatives(),
        initial_unknowns=structure.initial_unknowns(),
        event_indicators=tuple(map(texts.text, equations.relations.roots)),
        default_experiment=default_experiment(lowered),
        documentation=documentation(lowered),
        terminals=terminals(lowered),
        has_directional_derivatives=tangents is not None,
    )
    c_source = write_model(lowered, written, variables, starts, functions.sources(), tangents)
    kept = kept_texts([text for _, text in lowered.sources.values()])
    return GeneratedModel(description, c_source, notes + unchecked, kept)


def check_results(model: GeneratedModel, rows: Sequence[Row]) -> None:
    """Raise `UnsupportedModelError` if the FMU's values at some times do not fulfil the model's equations."""
    for mistake in mistaken_results(model.texts, model.description.model_name, rows):
        raise UnsupportedModelError(
            f"{model.description.model_name}: {mistake}; compiler or generator have misread it: write it "
            "another way"
        )


class _Read(NamedTuple):
    """What the generator reads of a lowered model."""

    lowered: LoweredModel
    functions: FunctionLibrary
    equations: Equations
    left_out: frozenset[str]
    starts: StartValues
    unchecked: Sequence[str]


def _read(lowered: LoweredModel) -> _Read:
    unchecked = reject_unsupported(lowered)
    reject_unsupported_tables(lowered, StartValues(lowered))
    functions = FunctionLibrary(lowered)
    equations = compact(read_equations(lowered, functions.name_of), n_named_slots(lowered))
    lowered = with_named_states(lowered, equations)
    reject_other_states(lowered, equations)
    reject_left_limits_of_inputs(lowered, equations)
    equations, left_out = without_open_connectors(lowered, equations)
    return _Read(lowered, functions, equations, left_out, StartValues(lowered), unchecked)


def _unchecked(texts: Sequence[str]) -> str:
    """Return a note on what the second reading could not compute."""
    if not texts:
        return ""
    more = f" and {len(texts) - _MOST_TEXTS} more" if len(texts) > _MOST_TEXTS else ""
    return (
        f"Not computed by the second reading, so check the results: {'; '.join(texts[:_MOST_TEXTS])}{more}. "
        "See docs/compilers.md.\n"
    )


def _tangents(equations: Equations, variables: Sequence[StoredVariable]) -> tuple[Tangents | None, str]:
    """Return the directional derivatives, or None and the reason why there are none."""
    if equations.sensitivities is not None:
        return None, "The FMU provides no directional derivatives: it computes sensitivities instead.\n"
    try:
        return Tangents.of(equations, variables), ""
    except NoTangentsError as error:
        return None, f"The FMU provides no directional derivatives: {error}.\n"
