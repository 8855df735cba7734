"""Every change leaves the file valid and different from before."""

from __future__ import annotations

import ast
from pathlib import Path

from tests.mutants.changes import changes

_PYTHON = """def f(x: int = 3, *more: float) -> str:
    # 1 + 2
    y = x + 1 if x < 2 and x is not None else -x
    print(f"{y} == 4")
    return "a and b"
"""
_C = """#include <math.h>
#define N 3
double f(double *x, int n) /* 1 + 2 */
{
    double sum = 0.0;
    for (int i = 0; i < n && x[i] >= 1e-3; ++i)
        sum += x[i] * 2;
    x[0] = sum;
    return sum;
}
"""


def _changed(text: str, suffix: str, folder: Path) -> dict[str, str]:
    file = folder / f"file{suffix}"
    file.write_text(text, "utf-8")
    found = {}
    for one in changes(file):
        assert text[one.at : one.at + len(one.before)] == one.before
        assert text.splitlines()[one.line - 1].find(one.before.strip().splitlines()[0]) >= 0
        found[f"{one.line}: {one.before.strip()}"] = (
            text[: one.at] + one.after + text[one.at + len(one.before) :]
        )
    return found


def test_changes_of_python(tmp_path: Path) -> None:
    found = _changed(_PYTHON, ".py", tmp_path)
    for text in found.values():
        assert ast.dump(ast.parse(text)) != ast.dump(ast.parse(_PYTHON))
    small = {key.removeprefix("3: ") for key in found if key.startswith("3: ")}
    assert {"+", "1", "<", "2", "and", "is not"} < small
    assert not any(key.startswith(("2:", "5:")) for key in found)
    assert '4: print(f"{y} == 4")' in found


def test_changes_of_c(tmp_path: Path) -> None:
    found = _changed(_C, ".c", tmp_path)
    assert set(found) == {
        *("5: 0.0", "6: 0", "6: <", "6: &&", "6: >=", "6: 1e-3"),
        *("7: +=", "7: *", "7: 2", "7: sum += x[i] * 2;", "8: 0", "8: x[0] = sum;"),
    }
