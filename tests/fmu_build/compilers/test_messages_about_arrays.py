"""What the compiler does not support in arrays of components is named in Modelica's terms, with its place."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build.compilers.rumoca import generate_model
from fmu_build.support.errors import BuildError, ModelicaError, UnsupportedModelError
from fmu_build.support.request import BuildRequest

_S = "model S Real y = time; end S;\n"
_P = "package P constant Integer n = 2; end P;\n"
_SIZE = "the size of this array of components is not evaluated; supported are numbers"
_NESTED = "y of components in an array of components that is in an array itself is not supported in a loop"

_CASES = {
    "a size by a constant of an aliased package": (
        f"{_P}{_S}model M import K = P; S s[K.n]; end M;",
        "3:23",
        _SIZE,
    ),
    "a size by a member": (
        f"model A parameter Integer n = 2; end A;\n{_S}model M A a; S s[a.n]; Real q = sum(s.y); end M;",
        "3:14",
        _SIZE,
    ),
    "a size by a parameter with a computed value": (
        f"{_P}{_S}model M parameter Integer m = P.n; S s[m]; end M;",
        "3:9",
        _SIZE,
    ),
    "a size by a constant of the package around": (
        f"{_S}package Q\nconstant Integer n = 2; model D S s[n]; end D; end Q;\nmodel M Q.D d; end M;",
        "3:1",
        _SIZE,
    ),
    "a size by an enumeration": (
        f"type E = enumeration(a, b);\n{_S}model M S s[E]; Real q = sum(s.y); end M;",
        "3:9",
        _SIZE,
    ),
    "a size by the size of an array": (
        f"{_S}model M parameter Real v[2] = {{1, 2}}; S s[size(v, 1)]; Real q = sum(s.y); end M;",
        "2:39",
        _SIZE,
    ),
    "a loop over an array of unknown size": (
        f"{_P}{_S}model M S s[P.n]; Real v[2]; equation for i in 1:2 loop v[i] = s[i].y; end for; end M;",
        "3:9",
        _SIZE,
    ),
    "an element of an array in an array": (
        f"{_S}model C S b[2]; end C;\n"
        "model M C a[2]; Real q[2]; equation for i in 1:2 loop q[i] = a[i].b[1].y; end for; end M;",
        "3:62",
        _NESTED,
    ),
    "a slice of an array in an array": (
        f"{_S}model C S b[3]; end C;\nmodel M C a[2]; Real q = sum(a[1].b[2:3].y); end M;",
        "3:30",
        _NESTED,
    ),
    "an array in an array without subscripts": (
        f"{_S}model C S b[3]; end C;\nmodel M C a[2]; Real q = sum(a.b.y); end M;",
        "3:11",
        "a.b.y, a member of an array of components that is in an array of components itself",
    ),
    "the size of an array of components": (
        f"{_S}model M S s[3]; Real q = size(s, 1); end M;",
        "2:26",
        "size() of the array of components s is not supported; use the number or parameter that is its size",
    ),
    "the last component of an array": (
        f"{_S}model M S s[3]; Real q = s[end].y; end M;",
        "2:26",
        "end is not supported as a subscript of the array of components s; write its size",
    ),
    "a size by a constant of a replaceable package": (
        "partial package B constant Integer nS; end B; package Med extends B(nS = 2); end Med;\n"
        f"{_S}model C replaceable package Medium = Med constrainedby B; S s[Medium.nS]; end C;\n"
        "model M C c; Real q = c.s[1].y; end M;",
        "3:59",
        "the constant nS of a replaceable package is not supported in the size of an array of components",
    ),
    "a type with a computed size": (
        "package P constant Integer n = 2; type V = Real[n]; end P;\n"
        "model M P.V v; Real y = sum(v); equation v = {time, time}; end M;",
        "2:9",
        "the size of a type that is an array is not evaluated here, because it is no number",
    ),
}


def _refused(source: str, folder: Path) -> tuple[type[BuildError], str]:
    (folder / "M.mo").write_text(source)
    with pytest.raises(BuildError) as caught:
        generate_model(BuildRequest("M", folder, folder / "M.mo"))
    return type(caught.value), str(caught.value).replace(f"{folder}/", "")


@pytest.mark.parametrize(("source", "place", "message"), _CASES.values(), ids=list(_CASES))
def test_message(source: str, place: str, message: str, tmp_path: Path) -> None:
    error, told = _refused(source, tmp_path)
    assert error is UnsupportedModelError
    assert told.startswith(f"M.mo:{place}: {message}"), told


def test_a_model_that_is_called(tmp_path: Path) -> None:
    error, told = _refused("model B output Real y = 1; end B;\nmodel M Real z = B(); end M;", tmp_path)
    assert error is ModelicaError
    assert told.startswith("M.mo:2:18: B is called as a function, but is a model"), told
