"""The figure of the default run."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import matplotlib as mpl
from lxml import etree

from fmu_build.packaging.default_run import DefaultRun
from fmu_build.packaging.figures import default_run_svg
from fmu_build.support.description import ModelDescription, Variable

_RUN = DefaultRun((0.0, 1.0, 2.0), {"F": (0.0, 1.0, 1.0)}, {"x": (0.0, 0.5, 0.1), "E": (0.0, 2.0, 1.0)})


def _texts(svg: bytes) -> list[str]:
    found: Iterable[etree._Element] = etree.fromstring(svg).iter("{http://www.w3.org/2000/svg}text")
    return ["".join(element.itertext()).strip() for element in found]


def test_a_panel_for_each_unit(description: ModelDescription) -> None:
    texts = _texts(default_run_svg(_RUN, description))
    assert [text for text in texts if text in ("N", "m", "J")] == ["N", "m", "J"]
    assert {"F", "x", "E", "time in s"} <= set(texts)


def test_the_same_run_gives_the_same_bytes(description: ModelDescription) -> None:
    svg = default_run_svg(_RUN, description)
    assert default_run_svg(_RUN, description) == svg
    assert default_run_svg(replace(_RUN, time=(0.0, 1.0, 3.0)), description) != svg
    with mpl.rc_context({"font.size": 20, "axes.grid": False}):
        assert default_run_svg(_RUN, description) == svg
    assert b"<dc:date>" not in svg
    assert b"Matplotlib" not in svg


def test_names_are_no_formulas(description: ModelDescription) -> None:
    names = ("_a", "b_c$d$", "'e^f'")
    variables = tuple(Variable(name, "Real", "output", "continuous", None, None) for name in names)
    run = DefaultRun((0.0, 1.0), {}, dict.fromkeys(names, (0.0, 1.0)))
    assert set(names) <= set(_texts(default_run_svg(run, replace(description, variables=variables))))
