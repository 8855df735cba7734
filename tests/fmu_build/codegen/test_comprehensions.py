"""Array comprehensions: those that the compiler counts correctly are built, others are refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import UnsupportedModelError, build_fmu
from pyjoystick.fmu import Fmu

_CLASSES = "record R Real x; Real z = 0; end R; model S parameter Real a; Real y = a + time; end S;"


def _library(folder: Path, declarations: str) -> Path:
    file = folder / "M.mo"
    file.write_text(f"model M {_CLASSES}\n {declarations} end M;", "utf-8")
    return file


@pytest.mark.parametrize(
    ("declarations", "output", "value"),
    [
        ("parameter Real g[2] = {6, 7}; S s[2](a = {g[3 - i] for i in 1:2});", "s[2].y", 6.0),
        ("S s[2](a = {10*sum(k for k in 3:i + 2) for i in 1:2});", "s[2].y", 70.0),
        ("S s[2](a = {10*i for i});", "s[2].y", 20.0),
        ("Real v[2] = {10*i*time for i in 4:-1:3}; Real y = v[1] + 1;", "y", 1.0),
        ("parameter Real g[3] = {6, 7, 8}; parameter Real h[2] = {g[i] for i in 2:3};", "h[2]", 8.0),
        ("R r[3](x = {6, 7, 8}); R q[2] = {r[i + 1] for i in 1:2}; Real y = q[2].x;", "y", 8.0),
    ],
)
def test_values(declarations: str, output: str, value: float, tmp_path: Path) -> None:
    with Fmu(build_fmu("M", tmp_path, library=_library(tmp_path, declarations)).path) as fmu:
        assert fmu.run([0.0, 1.0], outputs=[output])[output].iloc[0] == value


@pytest.mark.parametrize(
    "declarations",
    [
        "S s[2](a = {10*i for i in {2, 1}});",
        "S s[2](a = {10*i for i in 3:2:5});",
        "S s[2](a = {10*i for i in 0.5:1.5});",
        "S s[2, 2](a = {10*i + j for i in 1:2, j in 1:2});",
        "model Q S s[2](each a = 3); end Q; Q q(s(a = {10*i for i in 3:4}));",
        "model Q S s[2](each a = 3); end Q; Q p, q[2](s(a = {{10*i + j for j in 2:3} for i in 3:4}));",
        "model Q parameter Real v[2]; end Q; extends Q(v = {10*i for i in 3:4});",
        "R r[3](x = {6, 7, 8}); R q[2] = {r[i] for i in 2:3};",
        "R q[2] = {R(10*i, 1) for i in {5, 4}};",
    ],
)
def test_what_the_compiler_miscounts_is_refused(declarations: str, tmp_path: Path) -> None:
    with pytest.raises(UnsupportedModelError, match=r"M\.mo:2:\d+: for \w in .* may count from 1 here"):
        build_fmu("M", tmp_path, library=_library(tmp_path, declarations))
