"""Bundling of ES modules into one script."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import BuildError
from fmu_build.explore.bundle import bundle


def _modules(folder: Path, **sources: str) -> list[Path]:
    for name, source in sources.items():
        (folder / f"{name}.js").write_text(source)
    return [folder]


def test_modules_come_after_what_they_import(tmp_path: Path) -> None:
    folders = _modules(
        tmp_path,
        main='import { b } from "./b.js";\nimport { c } from "./c.js";\nb(c);\n',
        b='import { c } from "./c.js";\nexport function b() { return c; }\n',
        c="const own = 1;\nexport const c = own;\n",
    )
    script = bundle("main", folders)
    assert script.index("$c = ") < script.index("$b = ") < script.index("$main = ")
    assert script.count("$c = ") == 1
    assert "return { b };" in script
    assert "import" not in script
    assert "export" not in script


@pytest.mark.parametrize(
    ("sources", "message"),
    [
        ({"main": 'import { a } from "./a.js";\n'}, "a.js is missing"),
        ({"main": 'import { a } from "./a.js";\n', "a": 'import { m } from "./main.js";\n'}, "in a circle"),
        ({"main": 'import a from "./a.js";\n'}, "cannot be bundled"),
        ({"main": "export default 1;\n"}, "cannot be bundled"),
    ],
)
def test_faults(tmp_path: Path, sources: dict[str, str], message: str) -> None:
    with pytest.raises(BuildError, match=message):
        bundle("main", _modules(tmp_path, **sources))
