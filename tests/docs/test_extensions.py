"""The site's Sphinx extensions: formulas, docstrings, the Modelica library, the drawing of the rooms."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
import typer

from pyjoystick import cli
from pyjoystick.reports import schemas
from tests.docs.commands import command_lines, read
from tests.docs.pages import blocks
from tests.modelica.library import MSL_ROOT, ROOT as LIBRARY, library_classes

pytest.importorskip("sphinx", reason="the extra docs is not installed")

from docutils.utils.math import MathError
from extensions import docstrings, mathml
from extensions.command_line import command_text, commands
from extensions.documents import document_text
from extensions.imports import PACKAGES, arrows
from extensions.modelica_library import read_packages
from extensions.rooms import direct, drawing, layers


def test_a_function_is_set_apart_from_its_argument_and_bars_from_nothing() -> None:
    formula = mathml._mathml(r"a\,\lvert\tan\theta\rvert + \ln(x)", as_block=True)
    assert '<mi>tan</mi>\n  <mspace width="0.17em"></mspace>' in formula
    assert formula.count("&ApplyFunction;") == 1
    assert formula.index('form="prefix"') < formula.index("tan") < formula.index('form="postfix"')


def test_what_mathml_has_not_is_an_error() -> None:
    with pytest.raises(MathError):
        mathml._mathml(r"\nothing{x}", as_block=True)


DOCSTRING = """Peaks of |theta| in `x*y`, by n_.

Attributes:
    A, n: both
        of them
    time: a ratio: less than 1

Returns:
    by name: the value

Raises:
    KeyError, ValueError: it is not there
"""


def test_docstrings_are_plain_text_with_sections() -> None:
    lines = DOCSTRING.splitlines()
    docstrings._process(None, "class", "x", None, None, lines)
    assert lines[0] == r"Peaks of \|theta\| in `x*y`, by n\_."
    text = "\n".join(lines)
    assert "- **A, n**: both\n" in text
    assert "- **time**: a ratio: less than 1" in text
    assert ":returns: by name: the value" in text
    assert ":raises KeyError, ValueError: it is not there" in text


def test_errors_of_another_function() -> None:
    lines = ["Run it.", "", "Raises:", "    as `fit`"]
    docstrings._process(None, "function", "x", None, None, lines)
    assert ":raises: as `fit`" in lines


def test_signatures_are_python() -> None:
    signature, returns = docstrings._readable(
        None,
        "class",
        "x",
        None,
        None,
        "(x: Callable[[TypeAliasForwardRef('FloatArray')], int], y: list = <factory>)",
        None,
    )
    assert signature == "(x: Callable[[FloatArray], int], y: list = ...)"
    assert returns is None


@pytest.mark.parametrize("library", [LIBRARY, MSL_ROOT], ids=lambda library: library.name)
def test_every_class_of_a_library_is_there(library: Path) -> None:
    read = [one for package in read_packages(library) for one in package]
    assert sorted(one.name for one in read) == sorted(one.qualified for one in library_classes(library))
    assert all(one.documentation.startswith("<") for one in read)


def test_every_parameter_is_there() -> None:
    read = {one.name: one for package in read_packages(LIBRARY) for one in package}
    for one in library_classes():
        declared = [text for text in one.declarations if text.startswith("parameter ")]
        assert len(read[one.qualified].parameters) == len(declared), one.qualified
    (spring,) = [
        p for p in read["PreloadedSprings.Springs.RestrainedPreloadedSpring"].parameters if p.name == "F_0"
    ]
    assert spring.kind == "Force"
    assert spring.description


PROGRAM = typer.main.get_command(cli.app)
COMMANDS = list(commands("pyjoystick", PROGRAM))


def test_a_command_as_text() -> None:
    text = command_text("pyjoystick fit", PROGRAM.commands["fit"].load())
    assert text.startswith("## pyjoystick fit\n\nFit parameters")
    assert "| `RECORD.csv` | One file per release" in text
    assert "| `--parameters`, `-p` `FILE` |" in text
    assert "`--damping` `constant, power-law`" in text
    assert "[-20deg]" in command_text("a", PROGRAM.commands["free-oscillation"].load())


@pytest.mark.parametrize(("name", "command"), COMMANDS, ids=[name for name, _ in COMMANDS])
def test_examples_of_the_command_line_are_accepted(name: str, command: Any) -> None:
    """Blocks of other lines than commands are settings."""
    lines = []
    for block in blocks(command_text(name, command)):
        if "pyjoystick" in block.text:
            lines += command_lines(block.text)
        else:
            assert tomllib.loads(block.text)
    assert any(line.startswith(name) for line in lines)
    for line in lines:
        read(line)


def test_arrows_that_others_imply_are_not_drawn() -> None:
    graph = {"a": set(), "b": {"a"}, "c": {"a"}, "d": {"a", "b", "c", "elsewhere"}}
    assert direct(graph) == {"a": set(), "b": {"a"}, "c": {"a"}, "d": {"b", "c"}}
    assert layers(graph) == [["a"], ["b", "c"], ["d"]]


def test_a_circle_cannot_be_drawn() -> None:
    with pytest.raises(ValueError, match="a circle of imports among a, b"):
        layers({"a": {"b"}, "b": {"a"}, "c": set()})


@pytest.mark.parametrize("package", PACKAGES)
def test_the_drawing_has_every_room_and_arrow(package: str) -> None:
    graph = arrows(package)
    drawn = ElementTree.fromstring(drawing(package, graph))
    centers = {}
    for text in drawn.iter("text"):
        centers[text.text] = float(text.attrib["x"]), float(text.attrib["y"])
    assert set(centers) == set(graph)
    lines = [
        tuple(float(line.attrib[key]) for key in ("x1", "y1", "x2", "y2")) for line in drawn.iter("line")
    ]

    def nearest(x: float, y: float) -> str:
        return min(centers, key=lambda room: math.dist(centers[room], (x, y)))

    found = {(nearest(x1, y1), nearest(x2, y2)) for x1, y1, x2, y2 in lines}
    assert found == {(room, target) for room, targets in direct(graph).items() for target in targets}
    assert all(y2 < y1 for _, y1, _, y2 in lines)


def test_the_commands_stand_in_the_order_of_the_help() -> None:
    help_ = list(PROGRAM.list_commands(None))
    assert list(dict.fromkeys(words.split()[1] for words, _ in COMMANDS)) == help_
    assert help_.index("import") < help_.index("peaks")


def test_what_documents_say_as_text() -> None:
    """Units, tables within tables, keys that may be missing, and one of two forms."""
    found = schemas()["document.schema.json"]["definitions"]
    text = document_text("free-oscillation", found["free-oscillation"])
    assert text.startswith("### free-oscillation\n")
    assert (
        "| `peaks` | list of `time` (s), `theta` (rad), `half_period` "
        "(since the peak before, if on the other side, in s) |" in text
    )
    assert "| `trusted_until`? | " in text
    assert "made_with" not in text
    torque = document_text("torque", found["torque"])
    assert "`flat` or `kind`, `file`" in torque
    assert "`total` (`highest` (N.m), " in torque
    assert not [name for name, one in found.items() if "|  |" in document_text(name, one)], "no meaning"
