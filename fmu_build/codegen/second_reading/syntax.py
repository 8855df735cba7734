"""The classes of Modelica source as trees: elements, modifiers, and expressions and equations as tokens.

A class that is not understood is not certain, so that nothing is concluded from it.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Final

from fmu_build.codegen.modelica_source.text import blanked

TOKEN: Final = re.compile(
    r"'(?:[^'\\\n]|\\.)*'|[A-Za-z_]\w*|\d+(?:\.\d*)?(?:[eE][-+]?\d+)?|:=|==|<>|<=|>=|\.[-+*/^]|[^\s]"
)
_KINDS: Final = frozenset(
    ("model", "block", "class", "package", "function", "record", "connector", "type", "operator")
)
_CLASS_PREFIXES: Final = frozenset(("encapsulated", "partial", "expandable", "pure", "impure"))
_PREFIXES: Final = frozenset(
    (
        "flow",
        "stream",
        "discrete",
        "parameter",
        "constant",
        "input",
        "output",
        "final",
        "inner",
        "outer",
        "replaceable",
        "redeclare",
    )
)
_SECTIONS: Final = frozenset(("equation", "algorithm", "initial", "external"))
_OPERATORS: Final = frozenset(("then", "else", "and", "or", "not", "in"))
_OPENING: Final = {"(": ")", "[": "]", "{": "}"}

Tokens = tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Modifier:
    """What a name is given: a value, values of what is in it, another type, or an unknown redeclaration."""

    value: Tokens = ()
    inner: Mapping[str, Modifier] = field(default_factory=dict)
    each: bool = False
    final: bool = False
    type: str = ""
    redeclares: bool = False


@dataclass(frozen=True, slots=True)
class Component:
    """A component as declared.

    `dimensions` are the subscripts of its type and its name, outermost first; `constraint` is what its
    constraining clause gives, None if it has no such clause.
    """

    name: str
    type: str
    dimensions: tuple[Tokens, ...]
    prefixes: frozenset[str]
    modifier: Modifier
    condition: Tokens = ()
    constraint: Modifier | None = None


@dataclass(frozen=True, slots=True)
class Section:
    """Equations or an algorithm; `places` are the offsets of the tokens, with the end of the last one."""

    tokens: Tokens
    places: tuple[int, ...]
    is_initial: bool

    def between(self, start: int, end: int) -> Tokens:
        """Return the tokens between two offsets."""
        pairs = zip(self.tokens, self.places, strict=False)
        return tuple(token for token, place in pairs if start <= place < end)


@dataclass(slots=True)
class Class:
    """A class: its own elements in their order, and the classes declared in it.

    Attributes:
        file: the number of the text in which it stands, from the offset `start` to `end`
        bases: names of base classes with their modifiers; for a short class, the class that it stands for
        first: how many of its components are declared before each extends clause
        dimensions: subscripts of the class for which a short class stands
        imports: qualified names by the name under which they are known; "*" for unqualified imports
        constraint: what its constraining clause gives, None if it has no such clause
        is_certain: whether all its elements were understood
    """

    name: str
    kind: str
    around: Class | None
    prefixes: frozenset[str] = frozenset()
    bases: list[tuple[str, Modifier]] = field(default_factory=list)
    first: list[int] = field(default_factory=list)
    components: list[Component] = field(default_factory=list)
    classes: dict[str, Class] = field(default_factory=dict)
    imports: list[tuple[str, str]] = field(default_factory=list)
    dimensions: tuple[Tokens, ...] = ()
    sections: list[Section] = field(default_factory=list)
    algorithms: list[Section] = field(default_factory=list)
    literals: tuple[str, ...] = ()
    constraint: Modifier | None = None
    tokens: Tokens = field(default=(), repr=False)
    file: int = 0
    start: int = 0
    end: int = 0
    is_short: bool = False
    is_enumeration: bool = False
    is_certain: bool = True

    @property
    def qualified(self) -> str:
        """Its name with those of the classes around it."""
        around = self.around.qualified if self.around is not None else ""
        return f"{around}.{self.name}" if around else self.name

    def contains(self, file: int, offset: int) -> bool:
        """Return whether something at an offset into a file stands in it, and in no class inside."""
        if file != self.file or not self.start <= offset < self.end:
            return False
        return not any(one.start <= offset < one.end for one in self.classes.values())


def read_classes(text: str, file: int = 0) -> Iterator[tuple[str, Class]]:
    """Yield the classes of a file with the package that it is within; raises `SyntaxError` if it cannot."""
    parser = _Parser(blanked(text), file)
    within = parser.within()
    while parser.here:
        found = parser.class_or_none(
            None, frozenset(parser.take_all(_CLASS_PREFIXES | {"final", "replaceable"}))
        )
        if found is None:
            raise SyntaxError(f"a class is expected, not {parser.here}")
        yield within, found
        parser.skip_to_semicolon()


class _Parser:
    def __init__(self, plain: str, file: int) -> None:
        found = list(TOKEN.finditer(plain))
        self._tokens = [token.group() for token in found]
        self._places = [token.start() for token in found] + [len(plain)]
        self._file = file
        self._place = 0

    @property
    def here(self) -> str:
        return self.ahead(0)

    def ahead(self, count: int) -> str:
        place = self._place + count
        return self._tokens[place] if place < len(self._tokens) else ""

    def take(self) -> str:
        if not self.here:
            raise SyntaxError("the file ends within a class")
        self._place += 1
        return self._tokens[self._place - 1]

    def take_if(self, token: str) -> bool:
        found = self.here == token
        self._place += found
        return found

    def take_all(self, tokens: frozenset[str]) -> list[str]:
        found = []
        while self.here in tokens:
            found.append(self.take())
        return found

    def expect(self, token: str) -> None:
        if not self.take_if(token):
            raise SyntaxError(f"{token} is expected, not {self.here}")

    def within(self) -> str:
        if not self.take_if("within"):
            return ""
        name = "" if self.here == ";" else self.name()
        self.expect(";")
        return name

    def name(self) -> str:
        """A qualified name; a leading dot is kept."""
        found = self.take() if self.here == "." else ""
        found += self.take()
        while self.here == "." and self.ahead(1) not in ("*", "{"):
            found += self.take() + self.take()
        return found

    def skip_to_semicolon(self) -> None:
        while not self.take_if(";"):
            self._balanced()

    def _balanced(self) -> Tokens:
        """Take one token, or everything up to the bracket that closes it."""
        first = self.take()
        found = [first]
        if first in _OPENING:
            while self.here != _OPENING[first]:
                found += self._balanced()
            found.append(self.take())
        return tuple(found)

    def class_or_none(self, around: Class | None, prefixes: frozenset[str]) -> Class | None:
        if self.here not in _KINDS:
            return None
        first = self._place
        kind = self.take()
        while self.here in _KINDS:  # operator record
            kind = self.take()
        extends = self.take_if("extends")
        is_certain = not extends or kind == "function"
        found = Class(self.take(), kind, around, prefixes, file=self._file, is_certain=is_certain)
        inner = self._arguments() if self.here == "(" else {}
        if extends:
            found.bases.append((found.name, Modifier(inner=inner)))
        if self.take_if("="):
            self._short(found)
        else:
            self._composition(found)
        found.constraint = self._constraint()
        found.tokens = tuple(self._tokens[first : self._place])
        found.start, found.end = self._places[first], self._places[self._place]
        return found

    def _short(self, found: Class) -> None:
        found.is_short = True
        prefixes = self.take_all(_PREFIXES)
        if self.here == "enumeration":
            found.is_enumeration = True
            self.take()
            found.literals = self._literals()
            return
        if self.here == "der":
            found.is_certain = False
            self.take()
            self._balanced()
            return
        base = self.name()
        found.prefixes |= frozenset(prefixes)
        found.dimensions = self._subscripts()
        found.bases.append((base, Modifier(inner=self._arguments() if self.here == "(" else {})))

    def _literals(self) -> tuple[str, ...]:
        """The names in an enumeration, which may have comments and annotations."""
        inner = self._balanced()
        names = [after for before, after in itertools.pairwise(inner) if before in "(,"]
        return tuple(name for name in names if name.isidentifier()) if "annotation" not in inner else ()

    def _composition(self, found: Class) -> None:
        while True:
            if self.here == "end" and self.ahead(1) == found.name:
                self.take()
                self.take()
                return
            if self.here in ("public", "protected"):
                self.take()
            elif self.here in _SECTIONS:
                self._section(found)
            elif self.here == "annotation":
                self.skip_to_semicolon()
            else:
                self._element(found)
                if self.here == "annotation" or not self.take_if(";"):
                    self.skip_to_semicolon()

    def _section(self, owner: Class) -> None:
        is_initial = self.take_if("initial")
        kind = self.take()
        first = self._place
        while not self._is_next_section() and (self.here, self.ahead(1)) != ("end", owner.name):
            self._balanced()
        tokens, places = self._tokens[first : self._place], self._places[first : self._place + 1]
        section = Section(tuple(tokens), tuple(places), is_initial)
        if kind == "equation":
            owner.sections.append(section)
        elif kind == "algorithm":
            owner.algorithms.append(section)

    def _is_next_section(self) -> bool:
        is_call = self.here == "initial" and self.ahead(1) == "("
        return self.here in _SECTIONS | {"public", "protected"} and not is_call

    def _element(self, owner: Class) -> None:
        if self.take_if("import"):
            self._import(owner)
        elif self.take_if("extends"):
            base = self.name()
            owner.first.append(len(owner.components))
            owner.bases.append((base, Modifier(inner=self._arguments() if self.here == "(" else {})))
        elif self.here != ";":
            prefixes = frozenset(self.take_all(_PREFIXES | _CLASS_PREFIXES))
            inner = self.class_or_none(owner, prefixes)
            if inner is not None:
                owner.classes[inner.name] = inner
                # Functions change neither variables nor equations of the class.
                is_short = inner.is_short and not inner.dimensions and not inner.is_enumeration
                is_certain = ("redeclare" not in prefixes or is_short) and inner.is_certain
                owner.is_certain &= inner.kind == "function" or is_certain
            else:
                self._components(owner, prefixes)

    def _import(self, owner: Class) -> None:
        name = self.name()
        if self.take_if("="):
            owner.imports.append((name, self.name()))
        elif self.take_if(".*"):
            owner.imports.append(("*", name))
        elif self.take_if("."):
            if self.take_if("*"):
                owner.imports.append(("*", name))
            else:
                owner.imports += [(one, f"{name}.{one}") for one in self._balanced() if one.isidentifier()]
        else:
            owner.imports.append((name.rpartition(".")[2], name))

    def _components(self, owner: Class, prefixes: frozenset[str]) -> None:
        kind = self.name()
        common = self._subscripts()
        while True:
            name = self.take()
            own = self._subscripts()
            inner = self._arguments() if self.here == "(" else {}
            value = self._expression() if self.take_if("=") or self.take_if(":=") else ()
            condition = self._expression() if self.take_if("if") else ()
            modifier = Modifier(value, inner, final="final" in prefixes)
            constraint = self._constraint()
            while self.here not in (",", ";"):
                self._balanced()
                constraint = constraint or self._constraint()
            owner.components.append(
                Component(name, kind, own + common, prefixes, modifier, condition, constraint)
            )
            if not self.take_if(","):
                return

    def _constraint(self) -> Modifier | None:
        """What a constraining clause gives, if it follows."""
        if not self.take_if("constrainedby"):
            return None
        self.name()
        return Modifier(inner=self._arguments() if self.here == "(" else {})

    def _subscripts(self) -> tuple[Tokens, ...]:
        if not self.take_if("["):
            return ()
        found = [self._expression()]
        while self.take_if(","):
            found.append(self._expression())
        self.expect("]")
        return tuple(found)

    def _arguments(self) -> dict[str, Modifier]:
        """The modifiers between parentheses, by name; dotted names are refused before."""
        found: dict[str, Modifier] = {}
        self.expect("(")
        while not self.take_if(")"):
            prefixes = self.take_all(frozenset(("each", "final")))
            if self.here in ("redeclare", "replaceable"):
                name, redeclared = self._redeclared()
                found[name] = redeclared
            else:
                name = self.name()
                inner = self._arguments() if self.here == "(" else {}
                value = self._expression() if self.take_if("=") else ()
                found[name] = Modifier(value, inner, each="each" in prefixes, final="final" in prefixes)
            while self.here not in (",", ")"):
                self._balanced()
            self.take_if(",")
        return found

    def _redeclared(self) -> tuple[str, Modifier]:
        """The name of what is redeclared, and as what; nothing is known of redeclared arrays."""
        self.take_all(_PREFIXES | _CLASS_PREFIXES | {"each"})
        if self.here in _KINDS:
            return self._redeclared_class()
        kind = self.name()
        common = self._subscripts()
        name = self.take()
        is_unknown = bool(common or self._subscripts())
        inner = self._arguments() if self.here == "(" else {}
        value = self._expression() if self.take_if("=") else ()
        return name, Modifier(value, self._with_constraint(inner), type=kind, redeclares=is_unknown)

    def _with_constraint(self, inner: Mapping[str, Modifier]) -> Mapping[str, Modifier]:
        """What a redeclaration gives with its constraining clause, which its own modifiers override."""
        constraint = self._constraint()
        return inner if constraint is None else {**constraint.inner, **inner}

    def _redeclared_class(self) -> tuple[str, Modifier]:
        self.take()
        name = self.take()
        if not self.take_if("=") or self.here in _PREFIXES | {"enumeration"}:
            return name, Modifier(redeclares=True)
        kind = self.name()
        is_unknown = self.here == "["
        inner = self._arguments() if self.here == "(" else {}
        return name, Modifier(inner=self._with_constraint(inner), type=kind, redeclares=is_unknown)

    def _expression(self) -> Tokens:
        """Tokens up to a comma, a closing bracket, a semicolon, or a condition or annotation behind it."""
        found: list[str] = []
        while self.here and self.here not in ",;)]}" and self.here not in ("annotation", "constrainedby"):
            if self.here == "if" and found and _ends_operand(found[-1]):
                break
            found += self._balanced()
        return tuple(found)


def _ends_operand(token: str) -> bool:
    return token not in _OPERATORS and (token[-1].isalnum() or token[-1] in ")]}'_")
