"""Classes made of classes, with modifiers of modifiers, in random models.

All classes use the same few names, so that what is meant for one component has every chance to reach another.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from random import Random
from typing import Final, Union

from tests.fuzz.models.writer import Writer

#: By name of a parameter its value or, in an array of components, one for each; by that of a component,
#: modifiers of what is in it.
Modifiers = Mapping[str, Union[float, tuple[float, ...], "Modifiers"]]

_PARAMETERS: Final = ("a", "b", "c")
_COMPONENTS: Final = ("s", "t", "v")
_ELEMENTS: Final = 2
#: Of all parameters of the model, so many are compared.
_OBSERVED: Final = 12


@dataclass(frozen=True)
class _Class:
    name: str
    base: tuple[_Class, Modifiers] | None
    parameters: Mapping[str, float]
    components: Mapping[str, tuple[_Class, bool, Modifiers]] = field(default_factory=dict)

    def names(self) -> set[str]:
        """All parameters, own and inherited."""
        return {*self.parameters, *(self.base[0].names() if self.base else ())}

    def parts(self) -> dict[str, tuple[_Class, bool, Modifiers]]:
        """All components, own and inherited."""
        return {**(self.base[0].parts() if self.base else {}), **self.components}

    def text(self) -> str:
        lines = [f"    extends {self.base[0].name}{_written(self.base[1])};"] if self.base else []
        lines += [f"    parameter Real {name} = {value};" for name, value in self.parameters.items()]
        for name, (kind, is_array, given) in self.components.items():
            size = f"[{_ELEMENTS}]" if is_array else ""
            lines.append(f"    {kind.name} {name}{size}{_written(given)};")
        return "\n".join((f"  model {self.name}", *lines, f"  end {self.name};"))

    def values(self, given: Modifiers) -> Iterator[tuple[str, float]]:
        """The parameters of an instance by name: what is given outside goes before what is given inside."""
        if self.base:
            yield from self.base[0].values(_merged(given, self.base[1]))
        for name, value in self.parameters.items():
            found = given.get(name, value)
            assert isinstance(found, float)
            yield name, found
        for name, (kind, is_array, own) in self.components.items():
            outer = given.get(name, {})
            assert isinstance(outer, Mapping)
            inner = _merged(outer, own)
            for i in range(_ELEMENTS if is_array else 1):
                place = f"{name}[{i + 1}]" if is_array else name
                given_here = _element(inner, i) if is_array else inner
                yield from ((f"{place}.{path}", one) for path, one in kind.values(given_here))


def _merged(outer: Modifiers, inner: Modifiers) -> Modifiers:
    merged = dict(inner)
    for name, value in outer.items():
        own = merged.get(name)
        if isinstance(value, Mapping) and isinstance(own, Mapping):
            value = _merged(value, own)
        merged[name] = value
    return merged


def _element(given: Modifiers, i: int) -> Modifiers:
    """What one element of an array of components is given."""
    found = {name: value[i] if isinstance(value, tuple) else value for name, value in given.items()}
    return {name: _element(one, i) if isinstance(one, Mapping) else one for name, one in found.items()}


def _written(given: Modifiers) -> str:
    parts = []
    for name, value in given.items():
        if isinstance(value, Mapping):
            parts.append(f"{name}{_written(value)}")
        elif isinstance(value, tuple) and len(set(value)) == 1:
            parts.append(f"each {name} = {value[0]}")
        elif isinstance(value, tuple):
            parts.append(f"{name} = {{{', '.join(map(str, value))}}}")
        else:
            parts.append(f"{name} = {value}")
    return f"({', '.join(parts)})" if parts else ""


def _modifiers(random: Random, kind: _Class, *, is_array: bool, depth: int = 0) -> Modifiers:
    """Some for an instance of this class; not of arrays in arrays."""
    found: dict[str, float | tuple[float, ...] | Modifiers] = {}
    for name in sorted(kind.names()):
        if random.random() < 0.3:
            one = _value(random)
            other = _value(random) if random.random() < 0.3 else one
            found[name] = (one, other) if is_array else one
    for name, (inner, inner_is_array, _) in kind.parts().items():
        if depth < 2 and random.random() < 0.4 and not (is_array and inner_is_array):
            given = _modifiers(random, inner, is_array=is_array or inner_is_array, depth=depth + 1)
            found |= {name: given} if given else {}
    return found


def _value(random: Random) -> float:
    return random.randint(10, 999) / 10.0


def _random_class(random: Random, name: str, others: list[_Class]) -> _Class:
    base = None
    if others and random.random() < 0.5:
        one = random.choice(others)
        base = (one, _modifiers(random, one, is_array=False))
    taken = base[0].names() if base else set()
    parameters = {one: _value(random) for one in _PARAMETERS if one not in taken and random.random() < 0.6}
    parts = base[0].parts() if base else {}
    components = {}
    for one in _COMPONENTS:
        if others and one not in parts and random.random() < 0.5:
            kind, is_array = random.choice(others), random.random() < 0.2
            components[one] = (kind, is_array, _modifiers(random, kind, is_array=is_array))
    if base is None:
        parameters.setdefault("a", _value(random))
    return _Class(name, base, parameters, components)


def hierarchy(w: Writer) -> None:
    """Add classes, each of earlier ones, and an instance of the last."""
    classes: list[_Class] = []
    for i in range(w.random.randint(3, 5)):
        classes.append(_random_class(w.random, f"H{i}", classes))
    last = classes[-1]
    given = _modifiers(w.random, last, is_array=False)
    w.package += [one.text() for one in classes]
    w.declarations.append(f"{last.name} tree{_written(given)};")
    values = list(last.values(given))
    for name, value in w.random.sample(values, k=min(len(values), _OBSERVED)):
        w.meaning.steps.append((f"tree.{name}", lambda _, value=value: value))
        w.observed.append(f"tree.{name}")
