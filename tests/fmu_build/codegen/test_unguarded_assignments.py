"""An elsewhen of an algorithm is refused if rumoca would carry it out beside an earlier branch."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.errors import UnsupportedModelError
from fmu_build.support.request import BuildRequest

_AT_ONCE = "elsewhen x > 0.1 and x > 0.25 then b := 1;"


def _generate(clause: str, folder: Path, types: str = "Integer") -> None:
    (folder / "M.mo").write_text(
        "model M\n  Real x(start = 0, fixed = true);\n  Boolean u = x > 0.3;\n"
        f"  discrete {types} a(start = 0, fixed = true), b(start = 0, fixed = true);\n"
        f"equation\n  der(x) = 1;\nalgorithm\n  {clause} end when;\nend M;\n"
    )
    generate_model(BuildRequest("M", folder, folder / "M.mo"))


@pytest.mark.parametrize("types", ["Integer", "Real"])
@pytest.mark.parametrize(
    "clause",
    [
        f"when x > 0.25 then a := 1; {_AT_ONCE}",
        f"when x > 0.25 then if x > 5 then b := 3; end if; a := 1; {_AT_ONCE}",
        f"when x > 0.25 then if x > 5 then b := 3; else a := 1; end if; {_AT_ONCE}",
        f"when x > 0.25 then a := 1; b := 2; elsewhen x > 0.2 then a := 2; {_AT_ONCE}",
        "when x > 0.25 then a := 1; elsewhen x > 0.25 then if x > 0 then b := 1; end if;",
        "when u then a := 1; elsewhen not u and x > 1 then b := 1;",
        "when initial() then a := 1; elsewhen {initial(), x > 1} then b := 1;",
    ],
)
def test_it_may_fire_with_a_branch_that_does_not_assign_the_variable(
    clause: str, types: str, tmp_path: Path
) -> None:
    with pytest.raises(
        UnsupportedModelError, match=r"M\.mo:8:\d+: an elsewhen .* assigns b, .*b := pre\(b\)"
    ):
        _generate(clause, tmp_path, types)


def test_samples(tmp_path: Path) -> None:
    with pytest.raises(UnsupportedModelError, match=r"assigns b, .* common period"):
        _generate(
            "when sample(0, 0.25) then a := pre(a) + 1; elsewhen sample(0, 0.125) then b := 1;", tmp_path
        )


@pytest.mark.parametrize(
    "clause",
    [
        f"when x > 0.25 then a := 1; b := pre(b); {_AT_ONCE}",
        f"when x > 0.25 then a := 1; if x > 5 then b := 3; else b := pre(b); end if; {_AT_ONCE}",
        "when u then a := 1; elsewhen not u then b := 1;",
        "when not u then a := 1; elsewhen u then b := 1;",
        "when initial() then a := 1; elsewhen x > 0.25 then b := 1;",
    ],
)
def test_it_is_accepted_where_it_cannot(clause: str, tmp_path: Path) -> None:
    _generate(clause, tmp_path)
