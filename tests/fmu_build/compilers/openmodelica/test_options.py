"""The options of the backend."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build import build_fmu
from fmu_build.compilers.openmodelica import OpenModelicaCompiler
from fmu_build.compilers.openmodelica.options import OPTIONS, Options, read_options
from fmu_build.support.errors import BuildError


def test_none_given() -> None:
    assert read_options({}) == Options()


def test_values() -> None:
    given = {"port-file": "/run/p", "timeout": "2.5", "cs-solver": "euler"}
    assert read_options(given) == Options(port_file=Path("/run/p"), timeout=2.5, cs_solver="euler")
    assert read_options({"omc": "here"}).omc == Path("here")
    assert read_options({"docker": "image:1"}).docker == "image:1"


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"omc": "a", "docker": "b"}, "omc and docker exclude each other"),
        ({"omc": ""}, "the option omc has no value; it takes the path of omc"),
        ({"timeout": "soon"}, "timeout=soon: the option takes a positive number of seconds"),
        ({"timeout": "-1"}, "timeout=-1: the option takes a positive"),
        ({"timeout": "inf"}, "timeout=inf: the option takes a positive"),
        ({"cs-solver": "rk4"}, "cs-solver=rk4: the option takes cvode or euler"),
    ],
)
def test_values_that_are_not_allowed(given: dict[str, str], message: str) -> None:
    with pytest.raises(BuildError, match=message):
        read_options(given)


@pytest.mark.parametrize(
    ("compiler", "known"), [("openmodelica", "it has omc, port-file, docker"), ("rumoca", "it has none")]
)
def test_unknown_options_are_refused(compiler: str, known: str, tmp_path: Path) -> None:
    with pytest.raises(BuildError, match=f"the compiler {compiler} has no option 'speed'; {known}"):
        build_fmu("M", tmp_path, compiler=compiler, options={"speed": "fast"})


def test_the_compiler_tells_its_options() -> None:
    assert OpenModelicaCompiler().options is OPTIONS
