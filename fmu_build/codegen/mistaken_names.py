"""Names that rumoca resolves to other classes than Modelica does.

rumoca keeps one function for each name as the source calls it: `own()` in two models with a function of their
own, or `Medium.h()` where two components have different media, become one function. A class that is declared
in a model, such as a function, is evaluated once for all instances of the model. A function with the name of
a built-in one is not called, and an outer class stands for itself. The leading dot of a global name is lost.
What is called by its full name is right.
"""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Container, Iterator

from fmu_build.codegen.compiled import expressions
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.modelica_source.clauses import component_clauses
from fmu_build.codegen.modelica_source.constructs import Construct, ModelText
from fmu_build.codegen.modelica_source.inheritance import Inheritance, modified_classes
from fmu_build.codegen.modelica_source.modifiers import assigned, closing, values
from fmu_build.codegen.modelica_source.text import REDECLARE

_KIND = r"(?:model|block|class|package|connector|record|function|type)"
_OUTER_CLASS = rf"\bouter\s+(?:replaceable\s+)?(?:partial\s+)?(?={_KIND}\s+\w)"
_ALIAS = re.compile(r"\b(?:package|import)\s+(?P<name>\w+)\s*=\s*(?P<meaning>[\w.]+\s*\(?)")
_REDECLARED_FUNCTION = rf"{REDECLARE}function\s+(?:extends\s+)?(\w+)"
_GLOBAL = r"(?<![\w.\]')])(?<![\w.\]')]\s)\.\s*[A-Za-z_]\w*"
_OF_ITSELF = (
    rf"{REDECLARE}(?:model|block|record|class|type|connector)\s+(\w+)\s*=\s*"
    r"\1\b(?!\s*\.)"
)
_SHORT = re.compile(r"[\w\s]+=\s*(?:\w+\s*\.\s*)*(?P<base>\w+)\s*(?:\[[^\]]*\]\s*)?\(")
_HEAD = re.compile(r"(?<![\w.])[A-Za-z_]\w*(?!\s*\()")
_BUILT_IN = re.compile(
    r"abs|sign|sqrt|div|mod|rem|ceil|floor|integer|a?sin|a?cos|a?tan|atan2|sinh|cosh|tanh|exp|log|log10|min|max|"
    r"sum|product|size|ndims|zeros|ones|fill|identity|diagonal|linspace|transpose|outerProduct|symmetric|cross|"
    r"skew|scalar|vector|matrix|cat|homotopy|semiLinear|delay"
)


def reject_mistaken_names(model: LoweredModel) -> None:
    """Raise `UnsupportedModelError` for the first name that rumoca would resolve wrongly."""
    text = model.classes
    for find in (
        _outer_classes,
        _functions_like_built_in_ones,
        _blind_classes,
        _global_names,
        _classes_of_themselves,
        _short_classes,
    ):
        for why, construct in find(text):
            raise model.unsupported_at(why, construct)
    for why, construct in _ambiguous_aliases(text, model.flat["functions"]):
        raise model.unsupported_at(why, construct)
    _reject_other_functions(model)


def _outer_classes(text: ModelText) -> Iterator[tuple[str, Construct]]:
    for construct in text.find([rf"{_OUTER_CLASS}\w+"]):
        kind = construct.plain.rpartition(" ")[2]
        yield (
            f"outer {kind}: the compiler would use the class of the outer declaration, not that of the inner "
            "one; outer components are supported",
            construct,
        )


def _functions_like_built_in_ones(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield functions with built-in names that are called by these names where they are declared.

    Those of `Modelica.Math` are harmless: they pass their arguments on to the built-in functions.
    """
    for name, kind, own in text.named():
        scope, _, simple = name.rpartition(".")
        call = re.compile(rf"(?<![\w.]){simple}\s*\(")
        if not kind.endswith("function") or not _BUILT_IN.fullmatch(simple) or call.search(own):
            continue
        if any(call.search(user) for inside, _, user in text.named() if f"{inside}.".startswith(f"{scope}.")):
            for construct in text.find([rf"\bfunction\s+{simple}\b"]):
                yield f"{simple}() would call the built-in function; give this one another name", construct


def _global_names(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield names with a leading dot for which an enclosing scope has something of that name too."""
    inner = {name.rpartition(".")[2] for name, _, _ in text.named() if "." in name}
    inner |= {one.name for _, _, own in text.named() for one in component_clauses(own)}
    for construct in text.find([_GLOBAL]):
        name = construct.plain.lstrip(". ")
        if name in inner:
            yield (
                f"the leading dot of .{name} is lost, and it is not the only {name}; import it",
                construct,
            )


def _classes_of_themselves(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield redeclarations by a class of the same name, which rumoca takes for the redeclared one."""
    for construct in text.find([_OF_ITSELF]):
        yield "the class would be redeclared as its own default; give the new one another name", construct


def _short_classes(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield short classes with names in their modifiers that rumoca looks up in the modified class."""
    inheritance = Inheritance(text)
    for name, _, own in text.named():
        short = _SHORT.match(own)
        if short is None:
            continue
        given = values(own[short.end() : closing(own, short.end() - 1) - 1])
        bases = inheritance.ancestry(short["base"])
        members = {one.name for base in bases for one in inheritance.all_components(base)}
        for word in sorted(members & {word for value in given.values() for word in _HEAD.findall(value)}):
            simple = name.rpartition(".")[2]
            what = (
                f"{word} in the modifiers of the short class {simple} would be that of {short['base']}; "
                "write a class that extends it"
            )
            pattern = rf"\b{simple}\s*=\s*(?:\w+\s*\.\s*)*{short['base']}\b"
            yield from ((what, found) for found in text.find([pattern]))


def _blind_classes(text: ModelText) -> Iterator[tuple[str, Construct]]:
    """Yield what is given to names that inner classes of models use: they see what the model declares."""
    used: defaultdict[str, list[tuple[str, str]]] = defaultdict(list)
    for inner, kind, own in _classes_of_models(text):
        for name in _outside(text, inner, own):
            used[name].append((inner, kind))
    if not used:
        return
    for owners, name, construct in _given(text, used):
        for inner, kind in used[name]:
            if owners is None or inner.split(".")[-2] in owners:
                yield (
                    f"the {kind.rpartition(' ')[2]} {inner.rpartition('.')[2]} would not see what is given "
                    f"to {name}; hand {name} to it as an argument or parameter",
                    construct,
                )


def _given(text: ModelText, names: Container[str]) -> Iterator[tuple[set[str] | None, str, Construct]]:
    """Yield what modifiers give to these names: the classes that own it, or None for any, name and place."""
    inheritance = Inheritance(text)
    for modified, modifiers, construct in modified_classes(text):
        for *components, name in assigned(modifiers):
            if name in names:
                owners = inheritance.owners(modified, tuple(components))
                yield set().union(*map(inheritance.ancestry, owners)), name, construct
    for construct in text.find([_REDECLARED_FUNCTION]):
        name = construct.plain.rpartition(" ")[2]
        if name in names:
            yield None, name, construct


def _classes_of_models(text: ModelText) -> Iterator[tuple[str, str, str]]:
    """Yield names, restrictions and texts of classes that are declared in a model or block."""
    kinds = {name: kind for name, kind, _ in text.named()}
    for name, kind, own in text.named():
        if kinds.get(name.rpartition(".")[0], "").endswith(("model", "block", "class")):
            yield name, kind, own


def _outside(text: ModelText, inner: str, own: str) -> set[str]:
    """Return the constants and functions of the enclosing model and its bases that an inner class names.

    The enclosing model is known by its whole name, its bases by their simple ones.
    """
    around = inner.rpartition(".")[0]
    scopes, waiting = set[str](), [around]
    declared: dict[str, set[str]] = {}
    while waiting:
        scope = waiting.pop()
        if scope in scopes:
            continue
        scopes.add(scope)
        for body in text.bodies(scope) if scope == around else text.of(scope):
            for clause in re.findall(r"\bconstant\b[^;]*", body):
                declared |= {one.name: set(re.findall(r"\w+", clause)) for one in component_clauses(clause)}
            waiting += (base.rpartition(".")[2] for base in re.findall(r"\bextends\s+([\w.]+)", body))
    bases = scopes - {around}
    for qualified, kind, _ in text.named():
        scope, _, name = qualified.rpartition(".")
        if kind.endswith("function") and (scope == around or scope.rpartition(".")[2] in bases):
            declared[name] = set()
    of_its_own = {one.name for one in component_clauses(own)} | {inner.rpartition(".")[2]}
    found = declared.keys() & set(re.findall(r"(?<![\w.])[A-Za-z_]\w*", own)) - of_its_own
    while not found.issuperset(
        further := declared.keys() & {word for name in found for word in declared[name]}
    ):
        found |= further
    return found


def _ambiguous_aliases(text: ModelText, functions: dict[str, object]) -> Iterator[tuple[str, Construct]]:
    """Yield package aliases with several meanings through which functions are called."""
    called = {part for name in functions for part in name.split(".")[:-1]}
    meanings: defaultdict[str, dict[str, Construct]] = defaultdict(dict)
    for construct in text.find([_ALIAS.pattern]):
        found = _ALIAS.match(construct.plain)
        assert found is not None  # by the pattern
        meaning = re.sub(r"\s+", "", construct.plain[found.start("meaning") :])
        if meaning != found["name"]:
            meanings[found["name"]].setdefault(meaning, construct)
    for name in sorted(called.intersection(meanings)):
        if len(meanings[name]) > 1:
            yield (
                f"the model calls functions of {name}, which has several meanings in it: "
                f"{', '.join(meanings[name])}; the compiler would take one for all; "
                "call them by their full names",
                list(meanings[name].values())[-1],
            )


def _reject_other_functions(model: LoweredModel) -> None:
    """Reject a function whose declaration differs from the one that a call refers to."""
    functions = model.flat["functions"]
    meant: dict[str, int] = {}
    for call in expressions(model.flat, "FunctionCall"):
        called = call["name"] if "name" in call else call["comp"]  # an expression or a statement
        name, reference = called["name"], called["component_ref"]
        if name not in functions or reference is None:  # a constructor of a record has no reference
            continue
        last = reference["parts"][-1]
        is_other = last["def_id"] != functions[name]["def_id"] and _has_own_text(model, name, last["ident"])
        if is_other or meant.setdefault(name, last["def_id"]) != last["def_id"]:
            raise model.unsupported(
                f"{last['ident']}() would call another function of that name, which the model uses too; "
                "give one of them another name, or call them by their full names",
                last["span"],
            )


def _has_own_text(model: LoweredModel, name: str, simple: str) -> bool:
    """Return whether a function has a declaration of its own and is not an alias."""
    function = model.flat["functions"][name]
    span = next(expressions(function["body"] or function["outputs"], "span"))
    return model.class_around(span).rpartition(".")[2] == simple
