"""Restore dependencies between parameters: rumoca copies a literal in a modifier to everything bound to it.

In ``Joystick joystick(J = 0.002)``, the handle's inertia, bound to the joystick's J, becomes the number
0.002, so that setting J at run time would not change it. If the modifier names a parameter instead, the
inertia is computed from it. The model is therefore recompiled with additional parameters, which then take the
names of the originals.
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
    """Return the model with these dependencies restored; None if there is nothing to restore."""
    followers = {name for kind in trials.kinds for name in followers_of(trials, kind)}
    leaders = (one for kind in trials.kinds for one in _leaders(trials, kind, followers))
    kept = [one.present for one in leaders if len(one.names) == 1 and _is_open(trials, one)]
    if not kept:
        return None
    try:
        anew = source.keeping(kept)
        return anew, _named(model, lower(anew.variant([])), anew.names([]))
    except (BuildError, rumoca.RumocaError):
        return None  # The parameters stay constant.


def _leaders(trials: Trials, group: Sequence[Candidate], followers: set[str]) -> Iterator[Candidate]:
    """Yield the candidates that others depend on and that depend on none.

    A dependent has moved in every trial that set its candidate, unless the trial set the dependent as well.
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
    """Return whether no other equation depends on it, and setting its present value has no effect."""
    present, other = trials.compiled([one.present]), trials.compiled([one.other])
    if trials.plain is None or present is None or other is None or trials.plain.changed(present):
        return False
    return present.computes_as(other)


def _named(model: LoweredModel, anew: LoweredModel, settings: Mapping[str, str]) -> LoweredModel:
    """Swap the names of the new parameters and the originals."""
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
