"""A project of three small steps, in which the engine's behavior can be tested."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from pyjoystick.reports.project.assembling import Assembly
from pyjoystick.reports.project.running import run_assembly
from pyjoystick.reports.project.states import ProjectRun
from pyjoystick.reports.project.steps import Done, Step
from pyjoystick.support import InputFileError, write_text

INPUTS = ("a.txt", "b.txt")


class Toy:
    """Two files in capitals, and both in one; a file that says "bad" is damaged.

    `done` counts what was done since it was last emptied; `hook` is called within every step.
    """

    def __init__(self, root: Path) -> None:
        self.root = root
        self.done: list[str] = []
        self.hook: Callable[[str], None] = lambda place: None
        for name in INPUTS:
            self.write(name, name)

    def write(self, name: str, text: str) -> None:
        (self.root / name).write_text(text, encoding="utf-8")

    def read(self, name: str) -> str:
        return (self.root / name).read_text(encoding="utf-8")

    def assembly(self, settings: Mapping[str, Any] | None = None) -> Assembly:
        first = [self._step(f"make {name}", (name,), f"results/{name}", settings) for name in INPUTS]
        both = self._step("both", tuple(f"results/{name}" for name in INPUTS), "results/both.txt", None)
        return Assembly((*first, both), (), ())

    def run(self, settings: Mapping[str, Any] | None = None) -> ProjectRun:
        self.done.clear()
        return run_assembly(self.root, self.assembly(settings), lambda steps: None)

    def expected(self) -> dict[str, str]:
        """What must be in the results."""
        texts = {f"results/{name}": self.read(name).strip().upper() for name in INPUTS}
        return texts | {"results/both.txt": "".join(texts.values())}

    def _step(
        self, name: str, inputs: tuple[str, ...], output: str, settings: Mapping[str, Any] | None
    ) -> Step:
        def work(tell: Callable[[str], None]) -> Done:
            tell("at it")
            self.done.append(name)
            self.hook("before")
            text = "".join(self.read(one).strip().upper() for one in inputs)
            if "BAD" in text:
                raise InputFileError(self.root / inputs[0], "is damaged")
            # Two files, so that a step can be stopped between them.
            write_text(self.root / output, text)
            self.hook("between")
            write_text(self.root / f"{output}.md", text)
            self.hook("after")
            return Done(files=(output, f"{output}.md"), remark=text, notes=("a note",))

        return Step(name=name, inputs=inputs, outputs=(output,), settings=settings or {}, work=work)
