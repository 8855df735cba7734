"""The page on batches is run as it is printed."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

PAGE = (Path(__file__).parents[2] / "docs" / "batches.md").read_text(encoding="utf-8")


@pytest.mark.usefixtures("fmus_by_name")
def test_the_program_runs(capsys: pytest.CaptureFixture[str]) -> None:
    (program,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    exec(compile(program, "batches.md", "exec"), {})
    out = capsys.readouterr().out
    assert "(200, 901, 3) 0 failed" in out
    assert "[200 rows x 4 columns]" in out
