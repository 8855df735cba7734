"""Read annotations that rumoca does not pass on from the Modelica source."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress

from fmu_build.codegen.compiled import Span
from fmu_build.codegen.lowered import LoweredModel
from fmu_build.codegen.modelica_source.clauses import components
from fmu_build.codegen.modelica_source.text import STRING, blanked
from fmu_build.codegen.second_reading.operations import UnknownError
from fmu_build.codegen.second_reading.scopes import Library
from fmu_build.support.description import DefaultExperiment, Terminal

_MEMBERS = r"(?:signal|inflow|outflow)\s*\([^()]*\)"
_TERMINAL = rf"(\w+)\s*\((\s*{_MEMBERS}(?:\s*,\s*{_MEMBERS})*\s*)\)"
_ESCAPES = {"n": "\n", "t": "\t", "r": "\r"}


def default_experiment(model: LoweredModel) -> DefaultExperiment:
    """Return the ``experiment`` annotation; attributes that it omits have their default."""
    text = next(_class_texts(model), "")
    match = re.search(r"\bexperiment\s*\(([^()]*)\)", blanked(text))
    settings = dict(re.findall(r"(\w+)\s*=\s*([-+.\deE]+)", match.group(1))) if match else {}
    defaults = DefaultExperiment()
    return DefaultExperiment(
        start_time=float(settings.get("StartTime", defaults.start_time)),
        stop_time=float(settings.get("StopTime", defaults.stop_time)),
        tolerance=float(settings.get("Tolerance", defaults.tolerance)),
        step_size=float(settings.get("Interval", defaults.step_size)),
    )


def documentation(model: LoweredModel) -> str:
    """Return the HTML of the ``Documentation`` annotation, or an empty string if there is none."""
    text = next(_class_texts(model), "")
    match = re.search(rf"\bDocumentation\s*\(\s*info\s*=\s*({STRING})", text, re.DOTALL)
    if match is None:
        return ""
    return re.sub(
        r"\\(.)", lambda m: _ESCAPES.get(m.group(1), m.group(1)), match.group(1)[1:-1], flags=re.DOTALL
    )


def terminals(model: LoweredModel) -> tuple[Terminal, ...]:
    """Return the ``__pyjoystick(terminals(...))`` annotation of the class or of its nearest base class.

    ``__pyjoystick(terminals(shaft(inflow(tau = "T"), signal(phi = "theta"))))`` defines a terminal `shaft`;
    its inflow ``tau`` is the variable ``T``, its signal ``phi`` the variable ``theta``.
    """
    for text in _class_texts(model):
        match = re.search(rf"__pyjoystick\s*\(\s*terminals\s*\(((?:\s*{_TERMINAL}\s*,?)+)\s*\)\s*\)", text)
        if match:
            return tuple(_terminal(*parts) for parts in re.findall(_TERMINAL, match.group(1)))
    return ()


def is_to_be_shown(model: LoweredModel, name: str, declaration: Span) -> bool:
    """Return whether the declaration of this component has the annotation ``HideResult = false``.

    With it, results contain the variable even if it is protected (Modelica 3.5, section 18.3).
    """
    if declaration["source"] not in model.sources:
        return False
    plain = blanked(model.sources[declaration["source"]][1])
    simple = re.escape(name.rpartition(".")[2].partition("[")[0])
    # The span is that of the whole clause, `Real a = 1, b = 2;`. The first component follows its type.
    first, *others = components(plain, model.offset(declaration))
    component = next((one for one in others if re.match(rf"\s*{simple}\b", one)), first)
    return re.search(r"\bannotation\b.*\bHideResult\s*=\s*false\b", component, re.DOTALL) is not None


def _terminal(name: str, members: str) -> Terminal:
    return Terminal(
        name,
        tuple(
            (variable, member, kind)
            for kind, group in re.findall(r"(signal|inflow|outflow)\s*\(([^()]*)\)", members)
            for member, variable in re.findall(r'(\w+)\s*=\s*"([^"]*)"', group)
        ),
    )


def _class_texts(model: LoweredModel) -> Iterator[str]:
    """Yield the source of the model's class, and those of its base classes as far as they are known."""
    with suppress(UnknownError):
        library = Library({number: text for number, (_, text) in model.sources.items()})
        for one in library.lineage(library.class_of(model.name)):
            yield model.sources[one.file][1][one.start : one.end]
