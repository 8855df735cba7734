"""The script form, ``omc file.mos``: a run of omc for a list of statements, open to the root user too."""

from __future__ import annotations

import uuid
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from fmu_build.compilers.openmodelica.messages import Answer, read_answers, watched
from fmu_build.compilers.openmodelica.process import run


@dataclass(frozen=True, slots=True)
class ScriptSession:
    """Runs each list of statements in an omc of its own, so that nothing is kept from one to the next.

    `command` is what runs omc, `folder` where the scripts are written and run.
    """

    command: Sequence[str]
    folder: Path
    environment: Mapping[str, str]
    timeout: float

    def run(self, statements: Sequence[str]) -> list[Answer]:
        """The answers; the last one has the reason where there are fewer of them than statements.

        Raises `ToolchainError` where omc cannot be run or does not end in time.
        """
        marker = uuid.uuid4().hex
        script = self.folder / f"{marker}.mos"
        script.write_text("".join(f"{watched(s, marker)};\n" for s in statements), encoding="utf-8")
        code, output = run(
            [*self.command, "--locale=C", str(script)],
            folder=self.folder,
            log=self.folder / f"{marker}.log",
            environment=self.environment,
            timeout=self.timeout * len(statements),
        )
        if code != 0:
            output = f"{output.rstrip()}\nError: omc ended with exit code {code}"
        return read_answers(output, marker, len(statements))
