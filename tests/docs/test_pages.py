"""The pages are correct: their code runs and their commands are accepted."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from tests.docs.code import PageRun
from tests.docs.commands import CommandError, command_lines, read
from tests.docs.pages import PAGES, ROOT, blocks

#: Pages whose commands are typed by a test of their own, which judges the results too; here they are read.
ELSEWHERE = {"your-joystick": ROOT / "tests" / "test_your_joystick.py"}


@pytest.fixture
def checkout(tmp_path: Path, fmus_by_name: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The working folder: as in a checkout, paths lead to the FMUs and scenarios."""
    (tmp_path / "build").mkdir()
    (tmp_path / "build" / "fmi2").symlink_to(fmus_by_name)
    (tmp_path / "scenarios").symlink_to(ROOT / "scenarios")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_page_from_top_to_bottom(page: Path, checkout: Path) -> None:
    run = PageRun(page, checkout)
    for block in blocks(page.read_text(encoding="utf-8")):
        run.do(replace(block, not_run="elsewhere") if page.stem in ELSEWHERE else block)


@pytest.mark.parametrize("page", ELSEWHERE)
def test_pages_of_other_tests_have_one(page: str) -> None:
    assert f"{page}.md" in ELSEWHERE[page].read_text(encoding="utf-8")


PAGE = """
Text.

    pyjoystick parameters -o joystick.toml  # a comment

```python
value = 1 + 1
```

- A list

  ```python
  assert value == 2
  ```

<!-- not run: needs
a printer -->
```python
print_it()
```

```{toctree}
batches
```
"""


def test_blocks_and_their_marks(checkout: Path) -> None:
    found = list(blocks(PAGE))
    assert [block.language for block in found] == ["", "python", "python", "python"]
    assert [block.not_run for block in found] == ["", "", "", "needs a printer"]
    run = PageRun(Path("page.md"), checkout)
    for block in found:
        run.do(block)
    assert (checkout / "joystick.toml").is_file()


@pytest.mark.parametrize(
    ("page", "message"),
    [
        ("```\ntext\n```", "without a language"),
        ("```cobol\ntext\n```", "nothing checks the language cobol"),
        ("```python\nraise KeyError(3)\n```", "3"),
        ("```toml\n[fmu]\npath = 'Joystick'\n```", "no program reads a file with the tables fmu"),
        ("```toml\n[body]\nmass = 1\n```", r"\[body\] m: is missing"),
        ("```modelica\nmodel A\n  PreloadedSprings.Nothing nothing;\nend A;\n```", "Nothing"),
        ("    pyjoystick sweep nowhere.toml -o a.csv", "exit code 1"),
    ],
)
def test_what_is_wrong_on_a_page_fails(page: str, message: str, checkout: Path) -> None:
    run = PageRun(Path("page.md"), checkout)
    with pytest.raises(Exception, match=message):
        all(run.do(block) for block in blocks(page))


@pytest.mark.parametrize(
    "command",
    [
        "pyjoystick swep a.toml",
        "pyjoystick free-oscillation --angle 3",
        "pyjoystick import marker a.c3d",
        "python -m fmu_build A --output b --compiler none",
        "python -m benchmarks.none",
        "python scenarios/none.py",
        "make coffee",
        "rm -rf build",
    ],
)
def test_wrong_commands_are_refused(command: str) -> None:
    with pytest.raises(CommandError):
        read(command)


def test_command_lines() -> None:
    text = "make run     # the first\n\npyjoystick fit a.csv \\\n    b.csv\n# nothing\n"
    assert list(command_lines(text)) == ["make run", "pyjoystick fit a.csv      b.csv"]
