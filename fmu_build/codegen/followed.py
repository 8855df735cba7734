"""Keep parameters that others follow: rumoca copies the literal of a modifier to all that is bound to it.

In ``Joystick joystick(J = 0.002)`` the handle's inertia, bound to the joystick's J, becomes the number 0.002,
which J at run time would not change. If the modifier names a parameter instead, the inertia is computed from
it. The model is compiled anew with such parameters, which take the names of those that they stand for.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import rumoca

from fmu_build.codegen.baked import followers_of, halves
from fmu_build.codegen.lowered import LoweredModel, lower
from fmu_build.codegen.source import ModelSource
from fmu_build.codegen.trials import Candidate, Trials
from fmu_build.support.errors import BuildError


def with_followed_parameters(
    source: ModelSource, model: LoweredModel, trials: Trials
) -> tuple[ModelSource, LoweredModel] | None:
    """Return the model in which others follow the parameters at run time; None if it is that already."""
    followers = {name for kind in trials.kinds for name in followers_of(trials, kind)}
    leaders = (one for kind in trials.kinds for one in _leaders(trials, kind, followers))
    kept = [one.present for one in leaders if len(one.names) == 1 and _is_open(trials, one)]
    if not kept:
        return None
    try:
        anew = source.keeping(kept)
        return anew, _named(model, lower(anew.variant([])), anew.names([]))
    except (BuildError, rumoca.RumocaError):
        return None  # they remain constants


def _leaders(trials: Trials, group: Sequence[Candidate], followers: set[str]) -> Iterator[Candidate]:
    """Yield the candidates that others follow and that follow none.

    What follows a candidate has moved in every trial that set the candidate, unless it was set there itself.
    """
    tried = [(chosen, trials.followers(chosen) | _names(chosen)) for chosen in halves(group)]
    for one in group:
        moved = [names for chosen, names in tried if one in chosen]
        others = followers.difference(one.names)
        if len(others) < len(followers) or not others.intersection(*moved):
            continue
        if trials.followers([one]):
            yield one


def _names(chosen: Sequence[Candidate]) -> set[str]:
    return {name for one in chosen for name in one.names}


def _is_open(trials: Trials, one: Candidate) -> bool:
    """Return whether the equations do not hang on it otherwise, and setting it as it is changes nothing."""
    present, other = trials.compiled([one.present]), trials.compiled([one.other])
    if trials.plain is None or present is None or other is None or trials.plain.changed(present):
        return False
    return present.computes_as(other)


def _named(model: LoweredModel, anew: LoweredModel, settings: Mapping[str, str]) -> LoweredModel:
    """Exchange the names of the settings and of the parameters that they set."""
    entries = {entry["name"]: entry for entry in anew.dae["variables"]}
    slots = dict(anew.slots)
    exchanged: dict[str, dict[str, Any]] = {}
    for name, setting in settings.items():
        own, given = entries[name], entries[setting]
        for one, other in zip(own["scalar_names"], given["scalar_names"], strict=True):
            slots[one], slots[other] = slots[other], slots[one]
        values = {key: given["attributes"][key] for key in ("binding", "binding_values")}
        exchanged[name] = {**own, "id": given["id"], "attributes": {**own["attributes"], **values}}
        hidden = {**given["attributes"], "origin": "generated"}
        exchanged[setting] = {**given, "id": own["id"], "attributes": hidden}
    variables = [exchanged.get(entry["name"], entry) for entry in anew.dae["variables"]]
    return replace(
        model,
        flat={**anew.flat, "model_description": model.flat.get("model_description")},
        solve=anew.with_slots(slots, anew.y_names).solve,
        dae={**anew.dae, "variables": variables},
    )
