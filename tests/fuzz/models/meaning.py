"""The expected values over time of a random model's variables, by Python and SciPy."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from scipy.integrate import solve_ivp

from tests.fuzz.models.terms import Term

Number = float | int | bool
Values = dict[str, Any]


@dataclass(frozen=True)
class When:
    """A when-clause.

    Attributes:
        times: when it is due
        crosses: the state that makes it due by crossing a level upward, and the level
        actions: the variables that it sets, and their values from those just before, ``pre(d)``
    """

    times: tuple[float, ...]
    crosses: tuple[str, float] | None
    actions: tuple[tuple[str, Term], ...]


@dataclass
class Meaning:
    """How the values of a model follow from each other.

    Attributes:
        fixed: parameters in an order in which each follows from those before
        starts: start values of states and discrete variables
        states: derivatives
        whens: when-clauses
        steps: algebraic variables in an order in which each follows from those before
    """

    fixed: list[tuple[str, Callable[[Values], Any]]] = field(default_factory=list)
    starts: dict[str, Term] = field(default_factory=dict)
    states: dict[str, Term] = field(default_factory=dict)
    whens: list[When] = field(default_factory=list)
    steps: list[tuple[str, Callable[[Values], Any]]] = field(default_factory=list)

    def values(self, parameters: Mapping[str, Number], times: Sequence[float]) -> list[Values]:
        """The values of all variables at the times, with some parameters set."""
        return list(_Run(self, parameters).at(times))


class _Run:
    def __init__(self, meaning: Meaning, parameters: Mapping[str, Number]) -> None:
        self._meaning = meaning
        self._values: Values = {"time": 0.0}
        for name, value in meaning.fixed:
            self._values[name] = parameters[name] if name in parameters else value(self._values)
        self._values |= {name: start.value(self._values) for name, start in meaning.starts.items()}
        self._crossings = [(one, *one.crosses) for one in meaning.whens if one.crosses is not None]
        self._above = [self._values[name] > level for _, name, level in self._crossings]

    def at(self, times: Sequence[float]) -> Iterator[Values]:
        """The values at the times."""
        for until in sorted({t for one in self._meaning.whens for t in one.times} | set(times)):
            self._move(until)
            self._act(one for one in self._meaning.whens if until in one.times)
            while due := self._crossed():
                self._act(due)
            if until in times:
                now = dict(self._values)
                for name, value in self._meaning.steps:
                    now[name] = value(now)
                yield now

    def _act(self, due: Iterable[When]) -> None:
        before = {**self._values, **{f"pre({name})": value for name, value in self._values.items()}}
        for one in due:
            self._values |= {name: value.value(before) for name, value in one.actions}

    def _crossed(self) -> list[When]:
        """The clauses that a jump has made due."""
        found = []
        for i, (one, name, level) in enumerate(self._crossings):
            is_above = self._values[name] > level
            if is_above and not self._above[i]:
                found.append(one)
            self._above[i] = is_above
        return found

    def _move(self, until: float) -> None:
        """Integrate the states up to a time, through their crossings on the way."""
        names = list(self._meaning.states)
        while names and self._values["time"] < until:
            start = [self._values[name] for name in names]
            run = solve_ivp(
                self._rates,
                (self._values["time"], until),
                start,
                "DOP853",
                events=[self._event(i, names.index(name)) for i, (_, name, _) in enumerate(self._crossings)],
                rtol=1e-11,
                atol=1e-12,
            )
            self._values |= {
                "time": float(run.t[-1]),
                **dict(zip(names, map(float, run.y[:, -1]), strict=True)),
            }
            for i, hits in enumerate(run.t_events):
                if len(hits):
                    self._above[i] = not self._above[i]
                    self._act([self._crossings[i][0]] if self._above[i] else [])
        self._values["time"] = until

    def _rates(self, t: float, x: Any) -> list[float]:
        now = {**self._values, "time": t, **dict(zip(self._meaning.states, x, strict=True))}
        return [rate.value(now) for rate in self._meaning.states.values()]

    def _event(self, number: int, place: int) -> Callable[[float, Any], float]:
        level = self._crossings[number][2]

        def event(_: float, x: Any) -> float:
            return float(x[place] - level)

        event.terminal = True  # type: ignore[attr-defined]
        event.direction = -1.0 if self._above[number] else 1.0  # type: ignore[attr-defined]
        return event
