"""Trial compilations: compile a model with other parameter values and observe what changes.

Array sizes, the arguments of ``sample()``, conditions of conditional components and the like are evaluated
when the model is compiled, and rumoca's output does not say which parameters they depend on.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import rumoca

from fmu_build.codegen.compiled import expressions
from fmu_build.codegen.functions.definitions import bodies
from fmu_build.codegen.lowered import LoweredModel, read_mapping
from fmu_build.codegen.probes import probe_values, thresholds
from fmu_build.codegen.source import SETTING_PREFIX, ModelSource, Setting
from fmu_build.codegen.start_values import StartValues

_SUBSCRIPTS = re.compile(r"\[[\d,]+\]")
_TARGET = Path(__file__).parent / "target" / "variant"


@dataclass(frozen=True, slots=True)
class Candidate:
    """Parameters that are set together, with their present values and different ones."""

    names: tuple[str, ...]
    present: Setting
    other: Setting
    probes: tuple[Setting, ...]
    """More values, which may select other branches of the equations; each candidate has equally many."""
    fallback: Candidate | None = None
    """Another way to set these parameters, tried if this one does not prove them free."""

    @property
    def is_real(self) -> bool:
        """Whether the parameters are of type Real."""
        return self.present.type == "Real"


class Trial(NamedTuple):
    """A model with other parameter values; its equations are kept as text, which suffices to compare them."""

    equations: str
    values: dict[str, Any]
    functions: str
    """The DAE if it has functions, else empty."""

    @classmethod
    def read(cls, text: str) -> Trial:
        """Parse the output of the target ``variant``."""
        equations, values, functions = text.split("\n----\n")
        return cls(equations, read_mapping(values)["values"], functions.strip())

    def changed(self, other: Trial) -> set[str]:
        """Return the parameters whose values differ in `other`, except those that trials add."""
        return {
            name
            for name, value in self.values.items()
            if value != other.values.get(name) and not name.startswith(SETTING_PREFIX)
        }

    def computes_as(self, other: Trial) -> bool:
        """Return whether equations and functions are the same."""
        if self.equations != other.equations:
            return False
        mine, yours = (bodies(read_mapping(one.functions)) if one.functions else {} for one in (self, other))
        return mine == yours


class Trials:
    """The trial compilations of one model.

    Attributes:
        kinds: every parameter that can be set unless it is baked, in two groups that are set separately: the
            Reals, then the others, with which the model may not compile
        untried: parameters of some elements of an array of which other elements are computed: no modifier can
            set only these
        computed: the parameters that the model computes from others at initialization
        plain: the unchanged model; None if it does not compile as a base class
    """

    def __init__(self, source: ModelSource, model: LoweredModel, starts: StartValues) -> None:
        self._source = source
        groups = _groups(model)
        self.untried = frozenset(
            entry["name"] for group in groups.values() if not _is_whole(model, group) for entry in group
        )
        candidates = list(_candidates(model, starts, groups))
        self.kinds = tuple([one for one in candidates if one.is_real == kind] for kind in (True, False))
        self.computed = model.computed_parameters
        self._literals = _literals(model)
        self._compiled: dict[tuple[Setting, ...], Trial | None] = {}
        self.plain = self.compiled([])

    def compiled(self, settings: Sequence[Setting]) -> Trial | None:
        """Return the model with other parameter values, or None if it does not compile with them."""
        key = tuple(settings)
        if key not in self._compiled:
            self._compiled[key] = self._trial(key)
        return self._compiled[key]

    def _trial(self, settings: Sequence[Setting]) -> Trial | None:
        try:
            text = self._source.variant(settings).codegen(str(_TARGET)).files[0].content
        except (rumoca.RumocaError, RuntimeError):
            return None
        return Trial.read(text)

    def followers(self, chosen: Sequence[Candidate]) -> set[str]:
        """Return the other parameters whose values the compiler derives from those of the chosen ones.

        A parameter with a value of its own in the source follows nothing, although it may change in a trial:
        setting one member of a record by a modifier resets the others to their defaults.
        """
        literals = {span for one in chosen for name in one.names for span in self._literals.get(name, ())}
        return {
            name
            for name in self._moved(chosen)
            if not (own := self._literals.get(name)) or not literals.isdisjoint(own)
        }

    def _moved(self, chosen: Sequence[Candidate]) -> set[str]:
        """Return the other parameters whose values change with those of the chosen ones."""
        if not chosen or self.plain is None:
            return set()
        others = self.computed | {name for one in chosen for name in one.names}
        trial = self.compiled([one.other for one in chosen])
        if trial is not None:
            if self.plain.changed(trial) <= others:
                return set()
            # A modifier alone may reset neighboring parameters to their defaults, because rumoca loses their
            # modifiers.
            present = self.compiled([one.present for one in chosen])
            if present is not None:
                return present.changed(trial) - others
        if len(chosen) == 1:
            return set()
        middle = len(chosen) // 2
        return self._moved(chosen[:middle]) | self._moved(chosen[middle:])


def _literals(model: LoweredModel) -> dict[str, frozenset[tuple[int, ...]]]:
    """Return the source positions of the literals of those parameters that are given only by literals.

    A literal that rumoca has copied to a dependent parameter keeps its position.
    """
    places: dict[str, frozenset[tuple[int, ...]]] = {}
    for name, variable in model.flat["variables"].items():
        binding = variable["binding"]
        if not any(any(expressions(binding, kind)) for kind in ("VarRef", "FunctionCall", "BuiltinCall")):
            spans = [one["span"] for one in expressions(binding, "Literal")]
            places[name] = frozenset((one["source"], one["start"], one["end"]) for one in spans)
    return places


def _groups(model: LoweredModel) -> dict[str, list[Mapping[str, Any]]]:
    """Return the parameters that can be set, by name; the elements of an array form one group."""
    finals = model.flat.get("variable_final_flags", {})
    groups: dict[str, list[Mapping[str, Any]]] = {}
    for entry in model.dae["variables"]:
        flat = model.flat["variables"].get(entry["name"])
        is_open = flat is not None and not flat["is_protected"] and not finals.get(entry["name"], False)
        is_given = entry["role"] == "parameter" and entry["name"] not in model.computed_parameters
        if is_given and is_open and entry["attributes"]["tunable"]:
            groups.setdefault(_SUBSCRIPTS.sub("", entry["name"]), []).append(entry)
    return groups


def _candidates(
    model: LoweredModel, starts: StartValues, groups: Mapping[str, Sequence[Mapping[str, Any]]]
) -> Iterator[Candidate]:
    compared = thresholds(model.name, {Path(path): content for _, path, content in model.source_files})
    for number, (path, entries) in enumerate(groups.items()):
        probe = (
            partial(probe_values, number=number, compared=compared) if compared is not None else _no_probes
        )
        candidate = _candidate(model, starts, path, entries, probe) if _is_whole(model, entries) else None
        if candidate is not None:
            yield candidate


def _scalars(model: LoweredModel, entries: Sequence[Mapping[str, Any]]) -> list[str]:
    return [scalar for entry in entries for scalar in entry["scalar_names"] if scalar in model.slots]


def _dimensions(entries: Sequence[Mapping[str, Any]]) -> tuple[int, ...]:
    """Return the dimensions of the array formed by these elements."""
    last = [int(n) for group in _SUBSCRIPTS.findall(entries[-1]["name"]) for n in group[1:-1].split(",")]
    return (*last, *entries[0]["value_type"]["dimensions"])


def _is_whole(model: LoweredModel, entries: Sequence[Mapping[str, Any]]) -> bool:
    """Return whether no element before the last is missing; with no scalars there is nothing to set."""
    count = len(_scalars(model, entries))
    return count == 0 or count == math.prod(_dimensions(entries))


def _no_probes(_: float) -> list[float]:
    return []


def _candidate(
    model: LoweredModel,
    starts: StartValues,
    path: str,
    entries: Sequence[Mapping[str, Any]],
    probe: Callable[[float], list[float]],
) -> Candidate | None:
    """Return the candidate for a parameter; one candidate covers all components of an array."""
    values = [starts.of(model.slots[scalar]) for scalar in _scalars(model, entries)]
    texts = [_texts(model, starts, entries[0], value, probe(value)) for value in values]
    if not texts or None in texts:
        return None
    present, other, *probes = zip(*(text for text in texts if text), strict=True)
    dimensions = _dimensions(entries)
    kind = _kind(model, starts, entries[0])
    names = tuple(entry["name"] for entry in entries)
    whole = Candidate(
        names,
        Setting(path, kind, dimensions, _array(present, dimensions)),
        Setting(path, kind, dimensions, _array(other, dimensions)),
        tuple(Setting(path, kind, dimensions, _array(one, dimensions)) for one in probes),
    )
    if len(names) == 1 or len(set(present)) > 1:
        return whole
    # A modifier for the whole array does not replace one that was given with "each".
    one, another, *more = (
        Setting(path, kind, (), value[0], each=True) for value in (present, other, *probes)
    )
    return Candidate(names, one, another, tuple(more), fallback=whole)


def _kind(model: LoweredModel, starts: StartValues, entry: Mapping[str, Any]) -> str:
    """Return the Modelica type name of a parameter."""
    enumeration = starts.enumeration_of(model.flat["variable_type_names"].get(entry["name"], ""))
    kind = entry["value_type"]["scalar"]
    return enumeration.name if kind == "enumeration" and enumeration else kind.capitalize()


def _texts(
    model: LoweredModel, starts: StartValues, entry: Mapping[str, Any], value: float, probes: Sequence[float]
) -> tuple[str, ...] | None:
    """Return the Modelica texts of a value, a different value and the probes; None if no other exists."""
    match entry["value_type"]["scalar"]:
        case "real":
            return tuple(map(repr, (value, value * 1.0625 + 0.03125, *probes)))
        case "integer":
            return tuple(str(round(one)) for one in (value, value + 1, *probes))
        case "boolean":
            return tuple("true" if one else "false" for one in (value, not value, *(p > 0 for p in probes)))
    enumeration = starts.enumeration_of(model.flat["variable_type_names"].get(entry["name"], ""))
    if enumeration is None or len(enumeration.literals) < 2:
        return None
    numbers = [int(value) - 1, int(value), *(int(value) + 1 + i for i in range(len(probes)))]
    literals = enumeration.literals
    return tuple(f"{enumeration.name}.{literals[n % len(literals)][0]}" for n in numbers)


def _array(values: Sequence[str], dimensions: Sequence[int]) -> str:
    """Return values in row-major order as nested array constructors."""
    if not dimensions:
        return values[0]
    size = len(values) // dimensions[0]
    rows = (_array(values[i : i + size], dimensions[1:]) for i in range(0, len(values), size))
    return "{" + ", ".join(rows) + "}"
