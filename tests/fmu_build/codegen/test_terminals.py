"""Terminals from annotations of a class and its base classes."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from fmu_build.codegen.annotations import terminals
from fmu_build.support.description import Terminal

_SHAFT = 'shaft(inflow(tau = "T"), signal(phi = "theta", w = "omega"))'


def _model(name: str, *texts: str) -> Any:
    return SimpleNamespace(name=name, sources={place: ("", text) for place, text in enumerate(texts)})


def _class(name: str, annotation: str, extends: str = "") -> str:
    base = f"extends {extends};" if extends else ""
    return f"within Lib; model {name} {base} Real x; annotation ({annotation}); end {name};"


def test_an_annotation() -> None:
    model = _model("Lib.A", _class("A", f"__pyjoystick(terminals({_SHAFT}))"))
    members = (("T", "tau", "inflow"), ("theta", "phi", "signal"), ("omega", "w", "signal"))
    assert terminals(model) == (Terminal("shaft", members),)


def test_several_terminals() -> None:
    model = _model("Lib.A", _class("A", f'__pyjoystick(terminals({_SHAFT}, rod(outflow(f = "F"))))'))
    assert [terminal.name for terminal in terminals(model)] == ["shaft", "rod"]


def test_that_of_a_base_class() -> None:
    model = _model(
        "Lib.A", _class("A", "", extends="Base"), _class("Base", f"__pyjoystick(terminals({_SHAFT}))")
    )
    assert [terminal.name for terminal in terminals(model)] == ["shaft"]


@pytest.mark.parametrize("annotation", ["", "__other(terminals(a(signal(b = 1))))", f"// {_SHAFT}\n"])
def test_none(annotation: str) -> None:
    assert terminals(_model("Lib.A", _class("A", annotation, extends="Elsewhere"))) == ()
