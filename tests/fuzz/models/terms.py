"""Random Modelica expressions, each with a Python function of its meaning in the specification."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from random import Random
from typing import Any, Final

Values = Mapping[str, Any]
#: Length of all vectors.
N: Final = 3


@dataclass(frozen=True)
class Term:
    """An expression: its text, and its value from those of the names in it."""

    text: str
    value: Callable[[Values], Any]


@dataclass(frozen=True)
class Function:
    """A Modelica function of scalars and vectors, as `kinds` says, with a Real result."""

    name: str
    kinds: tuple[str, ...]
    call: Callable[..., Any]


@dataclass(frozen=True)
class Scope:
    """The names that expressions may use, by what they are, and the functions that they may call."""

    reals: tuple[str, ...] = ()
    integers: tuple[str, ...] = ()
    booleans: tuple[str, ...] = ()
    vectors: tuple[str, ...] = ()
    functions: tuple[Function, ...] = ()
    is_smooth: bool = False
    """Nothing that jumps or has a kink."""

    def more(self, **names: tuple[str, ...]) -> Scope:
        """This and other names."""
        return replace(self, **{kind: getattr(self, kind) + new for kind, new in names.items()})


@dataclass
class Terms:
    """Makes expressions from a scope."""

    random: Random
    scope: Scope
    _loops: int = field(default=0)

    def real(self, depth: int) -> Term:
        """An expression of type Real; its values stay moderate."""
        if depth <= 0 or self.random.random() < 0.1:
            return self._real_leaf()
        rules = [self._sum, self._product, self._quotient, self._power, self._elementary, self._of_integers]
        rules += [self._of_vector, self._unary, self._reduction, self._without_parentheses]
        if self.scope.functions:
            rules += [self._call, self._call]
        if not self.scope.is_smooth:
            rules += [self._conditional, self._conditional, self._stepwise, self._extremum]
            rules += [self._semi_linear]
        return self.random.choice(rules)(depth - 1)

    def integer(self, depth: int) -> Term:
        """An expression of type Integer."""
        choice = self.random.randrange(7 if depth > 0 else 2)
        if choice == 0 or (choice == 1 and not self.scope.integers):
            return self._literal(self.random.randint(1, 7))
        if choice == 1:
            return self._name(self.scope.integers)
        if choice == 2:
            operator = self.random.choice("+-*")
            return self._infix(operator, self.integer(depth - 1), self.integer(depth - 1))
        if choice == 3:
            name = self.random.choice(("div", "mod", "rem"))
            below = self._literal(self.random.choice((-4, -3, 2, 3, 5)))
            return _called(name, _WHOLE[name], self.integer(depth - 1), below)
        if choice == 4 and not self.scope.is_smooth:
            return _called("integer", math.floor, self.real(depth - 1))
        if choice == 5:
            return _called("abs", abs, self.integer(depth - 1))
        a, b = self.integer(depth - 1), self.integer(depth - 1)
        return _called("max", max, a, b) if self.random.random() < 0.5 else _called("min", min, a, b)

    def boolean(self, depth: int) -> Term:
        """An expression of type Boolean."""
        choice = self.random.randrange(6 if depth > 0 else 2)
        if choice == 0 and self.scope.booleans:
            return self._name(self.scope.booleans)
        if choice <= 2:
            return self._infix(
                self.random.choice(("<", "<=", ">", ">=")), self.real(depth - 1), self.real(depth - 1)
            )
        if choice == 3:
            operator = self.random.choice(("==", "<>", "<", ">="))
            return self._infix(operator, self.integer(depth - 1), self.integer(depth - 1))
        if choice == 4:
            a = self.boolean(depth - 1)
            return Term(f"(not {a.text})", lambda v: not a.value(v))
        return self._infix(
            self.random.choice(("and", "or")), self.boolean(depth - 1), self.boolean(depth - 1)
        )

    def vector(self, depth: int) -> Term:
        """An expression of type Real[3]."""
        if depth <= 0:
            if self.scope.vectors and self.random.random() < 0.7:
                return self._name(self.scope.vectors)
            parts = [self._real_leaf() for _ in range(N)]
            return Term(
                "{" + ", ".join(one.text for one in parts) + "}", lambda v: [one.value(v) for one in parts]
            )
        rules = [self._added, self._scaled, self._elementwise, self._mapped, self._transformed]
        # What the compiler often refuses is rare.
        rules = 4 * [*rules, self._picked, self._filled] + [self._comprehension, self._crossed]
        if not self.scope.is_smooth:
            rules += 4 * [self._chosen]
        return self.random.choice(rules)(depth - 1)

    # Scalars

    def _literal(self, value: float) -> Term:
        return Term(str(value) if value >= 0 else f"({value})", lambda _: value)

    def _name(self, names: Sequence[str]) -> Term:
        name = self.random.choice(names)
        return Term(name, lambda v: v[name])

    def _real_leaf(self) -> Term:
        names = self.scope.reals
        if names and self.random.random() < 0.7:
            return self._name(names)
        return self._literal(
            self.random.choice((0.5, 1.25, 2.0, 3.0, 1e-1, 0.7, round(self.random.uniform(0.1, 3.0), 3)))
        )

    def _infix(self, operator: str, a: Term, b: Term) -> Term:
        meaning = _INFIX[operator]
        return Term(f"({a.text} {operator} {b.text})", lambda v: meaning(a.value(v), b.value(v)))

    def _sum(self, depth: int) -> Term:
        return self._infix(self.random.choice("+-"), self.real(depth), self.real(depth))

    def _product(self, depth: int) -> Term:
        return self._infix("*", self.real(depth), _bounded(self.real(depth)))

    def _quotient(self, depth: int) -> Term:
        a, b = self.real(depth), self.real(depth)
        return Term(f"({a.text})/(1.5 + sin({b.text}))", lambda v: a.value(v) / (1.5 + math.sin(b.value(v))))

    def _power(self, depth: int) -> Term:
        a = self.real(depth)
        if self.random.random() < 0.5:
            return Term(f"(sin({a.text}))^2", lambda v: math.sin(a.value(v)) ** 2)
        b = self._real_leaf()
        if self.scope.is_smooth:
            # A large exponent makes a rate of change that swings faster than any integrator can follow.
            b = _called("tanh", math.tanh, b)
        return Term(f"(2 + cos({a.text}))^{b.text}", lambda v: (2.0 + math.cos(a.value(v))) ** b.value(v))

    def _elementary(self, depth: int) -> Term:
        a = self.real(depth)
        text, meaning = self.random.choice(_ELEMENTARY)
        return Term(text.format(a.text), lambda v: meaning(a.value(v)))

    def _of_integers(self, depth: int) -> Term:
        """The quotient of Integers is Real, and so is a power."""
        a, b = self.integer(depth), self.random.choice((2, 3, 4, 7))
        if self.random.random() < 0.3:
            return Term(f"(1 + abs({a.text}))^0.5", lambda v: (1 + abs(a.value(v))) ** 0.5)
        return Term(f"({a.text}/{b})", lambda v: a.value(v) / b)

    def _unary(self, depth: int) -> Term:
        a = self.real(depth)
        return Term(f"(-{a.text})", lambda v: -a.value(v))

    def _without_parentheses(self, _: int) -> Term:
        """What binds how strongly."""
        a, b, c = (self._real_leaf() for _ in range(3))
        forms: list[tuple[str, Callable[[float, float, float], float]]] = [
            ("({0} - {1} - {2})", lambda x, y, z: x - y - z),
            ("({0} - {1} + {2})", lambda x, y, z: x - y + z),
            ("({0}/(1 + {1}^2)*{2})", lambda x, y, z: x / (1 + y**2) * z),
            ("({0}*{1}/(1 + {2}^2))", lambda x, y, z: x * y / (1 + z**2)),
            ("(-{0}^2 + {1}*{2})", lambda x, y, z: -(x**2) + y * z),
            ("({0} - {1}*{2}^2)", lambda x, y, z: x - y * z**2),
        ]
        text, meaning = self.random.choice(forms)
        return Term(
            text.format(a.text, b.text, c.text), lambda v: meaning(a.value(v), b.value(v), c.value(v))
        )

    def _conditional(self, depth: int) -> Term:
        c, a, b = self.boolean(depth), self.real(depth), self.real(depth)
        if self.random.random() < 0.3:
            d, e = self.boolean(depth), self.real(depth)
            text = f"(if {c.text} then {a.text} elseif {d.text} then {e.text} else {b.text})"
            return Term(
                text, lambda v: a.value(v) if c.value(v) else e.value(v) if d.value(v) else b.value(v)
            )
        form = self.random.choice(("(if {} then {} else {})", "noEvent(if {} then {} else {})"))
        return Term(form.format(c.text, a.text, b.text), lambda v: a.value(v) if c.value(v) else b.value(v))

    def _stepwise(self, depth: int) -> Term:
        a = self.real(depth)
        name = self.random.choice(("floor", "ceil", "sign", "mod", "rem", "div"))
        if name in _WHOLE:
            below = self._literal(self.random.choice((0.75, 1.3, 2.0, -0.6)))
            return _called(name, _WHOLE[name], a, below)
        return _called(name, _STEPS[name], a)

    def _semi_linear(self, depth: int) -> Term:
        """Section 3.7.2.5: the first slope holds for positive flow, and for none it does not matter."""
        x, a, b = self.real(depth), self._real_leaf(), self._real_leaf()
        return _called("semiLinear", lambda x, a, b: a * x if x >= 0 else b * x, x, a, b)

    def _extremum(self, depth: int) -> Term:
        if self.random.random() < 0.3:
            return _called("abs", abs, self.real(depth))
        name = self.random.choice(("max", "min"))
        return _called(name, max if name == "max" else min, self.real(depth), self.real(depth))

    def _reduction(self, depth: int) -> Term:
        """``sum(... for i in a:b)`` and its kin."""
        index, inner = self._looped()
        body = inner.real(depth)
        name = self.random.choice(
            ("sum", "product") if self.scope.is_smooth else ("sum", "product", "max", "min")
        )
        first, last, step = self.random.choice(((1, 3, 1), (2, 4, 1), (1, 5, 2), (3, 1, -1)))
        steps = f"{first}:{last}" if step == 1 else f"{first}:{step}:{last}"
        meaning = _REDUCTIONS[name]
        numbers = range(first, last + (1 if step > 0 else -1), step)
        return Term(
            f"{name}(sin({body.text}) for {index} in {steps})",
            lambda v: meaning([math.sin(body.value({**v, index: i})) for i in numbers]),
        )

    def _looped(self) -> tuple[str, Terms]:
        """The name of a new index, and expressions that may use it."""
        index = f"i{self._loops + 1}"
        return index, Terms(self.random, self.scope.more(integers=(index,)), self._loops + 1)

    def _call(self, depth: int) -> Term:
        function = self.random.choice(self.scope.functions)
        arguments = [self.vector(depth) if kind == "vector" else self.real(depth) for kind in function.kinds]
        return _called(function.name, function.call, *arguments)

    def _of_vector(self, depth: int) -> Term:
        a = self.vector(depth)
        choice = self.random.randrange(4)
        if choice == 0 and self.scope.vectors:
            name = self.random.choice(self.scope.vectors)
            place = self.random.choice(("1", "2", "3", "end", "end - 1"))
            number = {"end": N, "end - 1": N - 1}.get(place) or int(place)
            return Term(f"{name}[{place}]", lambda v: v[name][number - 1])
        if choice == 1:
            b = self.vector(depth)
            text = f"tanh(({a.text})*({b.text}))"
            return Term(
                text, lambda v: math.tanh(sum(x * y for x, y in zip(a.value(v), b.value(v), strict=True)))
            )
        name = self.random.choice(
            ("sum", "product") if self.scope.is_smooth else ("sum", "product", "max", "min")
        )
        return Term(f"sin({name}({a.text}))", lambda v: math.sin(_REDUCTIONS[name](a.value(v))))

    # Vectors

    def _added(self, depth: int) -> Term:
        a, b, operator = self.vector(depth), self.vector(depth), self.random.choice(("+", "-", ".+", ".-"))
        meaning = _INFIX[operator[-1]]
        return Term(
            f"({a.text} {operator} {b.text})",
            lambda v: [meaning(x, y) for x, y in zip(a.value(v), b.value(v), strict=True)],
        )

    def _scaled(self, depth: int) -> Term:
        a, s = self.vector(depth), _bounded(self.real(depth))
        text = self.random.choice(("({1}*{0})", "({0}*{1})", "({0}/(2 + {1}))"))
        divides = "/" in text
        return Term(
            text.format(a.text, s.text),
            lambda v: [x / (2 + s.value(v)) if divides else x * s.value(v) for x in a.value(v)],
        )

    def _elementwise(self, depth: int) -> Term:
        a, b = self.vector(depth), self.vector(depth)
        return Term(
            f"(sin({a.text}) .* {b.text})",
            lambda v: [math.sin(x) * y for x, y in zip(a.value(v), b.value(v), strict=True)],
        )

    def _mapped(self, depth: int) -> Term:
        a = self.vector(depth)
        return Term(f"(-cos({a.text}))", lambda v: [-math.cos(x) for x in a.value(v)])

    def _comprehension(self, depth: int) -> Term:
        index, inner = self._looped()
        body = inner.real(depth)
        return Term(
            f"{{{body.text} for {index} in 1:{N}}}",
            lambda v: [body.value({**v, index: i}) for i in range(1, N + 1)],
        )

    def _transformed(self, depth: int) -> Term:
        a = self.vector(depth)
        numbers = [[float(self.random.randint(-2, 2)) for _ in range(N)] for _ in range(N)]
        rows = "{" + ", ".join("{" + ", ".join(map(str, row)) + "}" for row in numbers) + "}"
        flat = "[" + "; ".join(", ".join(map(str, row)) for row in numbers) + "]"
        turned = self.random.random() < 0.4
        matrix = self.random.choice((rows, flat))
        if turned:
            matrix, numbers = f"transpose({matrix})", [list(column) for column in zip(*numbers, strict=True)]
        return Term(
            f"({matrix}*{a.text})",
            lambda v: [sum(m * x for m, x in zip(row, a.value(v), strict=True)) for row in numbers],
        )

    def _picked(self, depth: int) -> Term:
        if not self.scope.vectors:
            return self._filled(depth)
        a, b = self.random.choice(self.scope.vectors), self.random.choice(self.scope.vectors)
        forms: list[tuple[str, Callable[[Any, Any], Any]]] = [
            (f"{a}[{{3, 1, 2}}]", lambda x, _: [x[2], x[0], x[1]]),
            (f"cat(1, {a}[2:3], {b}[1:1])", lambda x, y: [x[1], x[2], y[0]]),
            (f"{a}[3:-1:1]", lambda x, _: x[::-1]),
            (f"({a}[:] + {b})", lambda x, y: [p + q for p, q in zip(x, y, strict=True)]),
            (f"(diagonal({a})*{b})", lambda x, y: [p * q for p, q in zip(x, y, strict=True)]),
        ]
        text, meaning = self.random.choice(forms)
        return Term(text, lambda v: meaning(v[a], v[b]))

    def _filled(self, depth: int) -> Term:
        s, t = self.real(depth), self.real(depth)
        forms: list[tuple[str, Callable[[float, float], Any]]] = [
            (f"fill({s.text}, {N})", lambda x, _: [x] * N),
            (f"{{{s.text}, {t.text}, {s.text}}}", lambda x, y: [x, y, x]),
            (f"({s.text}*ones({N}) + zeros({N}))", lambda x, _: [x] * N),
            (f"(identity({N})*{{{s.text}, {t.text}, 0.5}})", lambda x, y: [x, y, 0.5]),
        ]
        text, meaning = self.random.choice(forms)
        return Term(text, lambda v: meaning(s.value(v), t.value(v)))

    def _crossed(self, depth: int) -> Term:
        a, b = self.vector(depth), self.vector(depth)
        form = self.random.choice(("cross({}, {})", "(skew({})*{})"))

        def value(v: Values) -> list[float]:
            (x, y, z), (p, q, r) = a.value(v), b.value(v)
            return [y * r - z * q, z * p - x * r, x * q - y * p]

        return Term(form.format(a.text, b.text), value)

    def _chosen(self, depth: int) -> Term:
        c, a, b = self.boolean(depth), self.vector(depth), self.vector(depth)
        return Term(
            f"(if {c.text} then {a.text} else {b.text})", lambda v: a.value(v) if c.value(v) else b.value(v)
        )


def _called(name: str, meaning: Callable[..., Any], *arguments: Term) -> Term:
    texts = ", ".join(one.text for one in arguments)
    return Term(f"{name}({texts})", lambda v: meaning(*(one.value(v) for one in arguments)))


def _bounded(a: Term) -> Term:
    """Products stay moderate."""
    return Term(f"sin({a.text})", lambda v: math.sin(a.value(v)))


def _div(x: float, y: float) -> float:
    """Rounded toward zero, section 3.7.2."""
    return math.trunc(x / y)


def _rem(x: float, y: float) -> float:
    return x - _div(x, y) * y


def _mod(x: float, y: float) -> float:
    return x - math.floor(x / y) * y


_WHOLE: Final = {"div": _div, "rem": _rem, "mod": _mod}
_STEPS: Final = {
    "floor": math.floor,
    "ceil": math.ceil,
    "sign": lambda x: (x > 0) - (x < 0),
}
_REDUCTIONS: Final[dict[str, Callable[[Sequence[float]], float]]] = {
    "sum": sum,
    "product": math.prod,
    "max": max,
    "min": min,
}
_ELEMENTARY: Final[tuple[tuple[str, Callable[[float], float]], ...]] = (
    ("sin({})", math.sin),
    ("cos({})", math.cos),
    ("atan({})", math.atan),
    ("tanh({})", math.tanh),
    ("exp(sin({}))", lambda x: math.exp(math.sin(x))),
    ("log(2 + cos({}))", lambda x: math.log(2.0 + math.cos(x))),
    ("log10(2 + cos({}))", lambda x: math.log10(2.0 + math.cos(x))),
    ("sqrt(1 + ({})^2)", lambda x: math.sqrt(1.0 + x * x)),
    ("asin(0.9*sin({}))", lambda x: math.asin(0.9 * math.sin(x))),
    ("acos(0.9*cos({}))", lambda x: math.acos(0.9 * math.cos(x))),
    ("sinh(sin({}))", lambda x: math.sinh(math.sin(x))),
    ("cosh(sin({}))", lambda x: math.cosh(math.sin(x))),
    ("tan(sin({}))", lambda x: math.tan(math.sin(x))),
    ("atan2(sin({}), 0.5)", lambda x: math.atan2(math.sin(x), 0.5)),
)
_INFIX: Final[dict[str, Callable[[Any, Any], Any]]] = {
    "+": lambda a, b: a + b,
    "-": lambda a, b: a - b,
    "*": lambda a, b: a * b,
    "<": lambda a, b: a < b,
    "<=": lambda a, b: a <= b,
    ">": lambda a, b: a > b,
    ">=": lambda a, b: a >= b,
    "==": lambda a, b: a == b,
    "<>": lambda a, b: a != b,
    "and": lambda a, b: a and b,
    "or": lambda a, b: a or b,
}
