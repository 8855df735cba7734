"""The library's text, class by class, and its models as compiled by rumoca."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Protocol

import numpy as np
import rumoca
from numpy.typing import NDArray

MODELICA_PATH = Path(__file__).parents[2] / "modelica"
ROOT = MODELICA_PATH / "PreloadedSprings"
MSL_ROOT = MODELICA_PATH / "PreloadedSpringsMSL"

_STRING = r'"(?:[^"\\]|\\.)*"'
_HEADER = re.compile(
    rf"^(?P<partial>partial )?(?P<kind>package|model|block|connector|type|class) (?P<name>\w+)"
    rf"(?:\s+{_STRING}|\s*=(?:{_STRING}|[^;\"])*)",
    re.MULTILINE,
)


class SimulationFailedError(Exception):
    """A simulation did not reach its end; the message is the compiler's."""


class Simulate(Protocol):
    """How the tests simulate, whichever compiler does it."""

    event_error: float
    """How far (s) from a kink the compiler's solver may put its event, in theory exact."""

    def __call__(
        self, component: str, stop_time: float, step: float = 1e-3, equations: str = ""
    ) -> dict[str, NDArray[np.float64]]:
        """Results of a model that declares `component`, sampled every `step` (s) and at its events.

        `component` is the text of declarations, such as ``PreloadedSprings.Parts.Fixed wall;``. Raises
        `SimulationFailedError`.
        """
        ...


@dataclass(frozen=True)
class LibraryClass:
    """One .mo file."""

    library: str
    name: str
    """Qualified, without the library's own name; empty for the library itself."""
    kind: str
    partial: bool
    file: Path
    text: str

    @property
    def qualified(self) -> str:
        """The name that a compiler takes."""
        return ".".join(filter(None, [self.library, self.name]))

    @property
    def code(self) -> str:
        """The text without annotations."""
        return without_annotations(self.text)

    @property
    def declarations(self) -> list[str]:
        """The declarations of components and constants, without annotations."""
        sections = re.split(r"^(?:initial )?equation\b", self.code, maxsplit=1, flags=re.MULTILINE)
        statements = split_statements(sections[0])
        found = [re.sub(r"^(protected|public)\s+", "", statement) for statement in statements[2:]]
        return [s for s in found if s and not re.match(r"(extends|end|import)\b", s)]


@cache
def library_classes(root: Path = ROOT) -> tuple[LibraryClass, ...]:
    """Every class of a library, by default that which needs no other."""
    return tuple(_read(file, root) for file in sorted(root.rglob("*.mo")))


def concrete_models() -> list[str]:
    """The qualified names of all models and blocks that are not partial."""
    return [c.qualified for c in library_classes() if c.kind in ("model", "block") and not c.partial]


def examples() -> list[str]:
    """The qualified names of the examples."""
    return [name for name in concrete_models() if re.fullmatch(r"PreloadedSprings\.Examples\.\w+", name)]


def msl_examples() -> list[str]:
    """The qualified names of the examples that use the Modelica Standard Library."""
    return [c.qualified for c in library_classes(MSL_ROOT) if c.kind == "model" and "Examples" in c.name]


def comparison_signals(example: str) -> list[str]:
    """The variables of an example by which tools compare their results, without the time."""
    folders = example.split(".")
    time, *names = (
        MODELICA_PATH.joinpath(folders[0], "Resources", "Reference", *folders, "comparisonSignals.txt")
        .read_text()
        .splitlines()
    )
    assert time == "time", example
    return names


@cache
def compiled(name: str) -> rumoca.Model:
    """A model of the library; raises where it is not balanced or uses a name that does not exist."""
    return rumoca.Session().load(str(ROOT / "package.mo"), model=name)


@cache
def flat_variables(name: str) -> dict[str, dict[str, Any]]:
    """The flat variables of a model with their attributes."""
    variables: dict[str, dict[str, Any]] = compiled(name).to_dict("flat")["variables"]
    return variables


class RumocaSimulate:
    """`Simulate` by rumoca's own solver."""

    event_error = 0.0

    def __call__(
        self, component: str, stop_time: float, step: float = 1e-3, equations: str = ""
    ) -> dict[str, NDArray[np.float64]]:
        """See `Simulate`."""
        source = f"model Bench {component} equation {equations} end Bench;"
        model = rumoca.Session(roots=[str(MODELICA_PATH)]).loads(source, model="Bench")
        try:
            result = model.simulate(stop_time, config=rumoca.SimConfig(rtol=1e-10, atol=1e-12, dt=step))
        except rumoca.SimulationError as error:
            raise SimulationFailedError(str(error)) from error
        return {"time": np.asarray(result.time), **{name: np.asarray(result[name]) for name in result.names}}


def without_annotations(text: str) -> str:
    """Modelica text with every annotation(...) taken out."""
    result = ""
    position = 0
    for match in re.finditer(rf"{_STRING}|\bannotation\s*(?=\()", text):
        if match.start() >= position and match.group().startswith("annotation"):
            result += text[position : match.start()]
            position = _closing_parenthesis(text, match.end())
    return result + text[position:]


def split_statements(text: str) -> list[str]:
    """What stands before a class's header, the header to its description, and each statement after it."""
    header = _HEADER.search(text)
    assert header, text[:200]
    # The rows of a matrix are parted by semicolons too.
    body = re.findall(rf"((?:{_STRING}|\[[^\]\"]*\]|[^;\"\[])*);", text[header.end() :])
    return [text[: header.start()].strip(), header.group(), *(statement.strip() for statement in body)]


def _closing_parenthesis(text: str, start: int) -> int:
    depth = 0
    for match in re.finditer(rf"{_STRING}|[()]", text[start:]):
        depth += {"(": 1, ")": -1}.get(match.group(), 0)
        if depth == 0:
            return start + match.end()
    raise AssertionError(f"no closing parenthesis after {text[start : start + 60]!r}")


def _read(file: Path, root: Path) -> LibraryClass:
    text = file.read_text()
    header = _HEADER.search(text)
    assert header, file
    parts = file.relative_to(root).with_suffix("").parts
    name = ".".join(parts[:-1] if parts[-1] == "package" else parts)
    return LibraryClass(root.name, name, header["kind"], bool(header["partial"]), file, text)
