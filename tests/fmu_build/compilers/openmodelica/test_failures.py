"""What a failed build is told as."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build.compilers.openmodelica.failures import failure
from fmu_build.compilers.openmodelica.messages import read_messages
from fmu_build.support.errors import BuildError, ModelicaError, ToolchainError, UnsupportedModelError
from tests.fmu_build.compilers.openmodelica import recorded

FILE = Path("/home/user/lib/M.mo")


@pytest.mark.parametrize(
    ("text", "kind", "message"),
    [
        (recorded.SYNTAX_ERROR, ModelicaError, "/home/user/lib/bad.mo:4:1: Missing token: SEMICOLON"),
        (
            recorded.TYPE_ERROR,
            ModelicaError,
            '/home/user/lib/M5.mo:1:10: Type mismatch in binding x = "a", expected subtype of Real, '
            "got type String.",
        ),
        (
            recorded.UNKNOWN_VARIABLE,
            ModelicaError,
            "/home/user/lib/M2.mo:1:27: Variable y not found in scope M2.",
        ),
        (
            recorded.TOO_FEW_EQUATIONS,
            ModelicaError,
            "/home/user/lib/M.mo: Too few equations, under-determined system. The model has 1 equation(s) "
            "and 2 variable(s). (model M)\n/home/user/lib/M4.mo:1:18: Variable y does not have any remaining "
            "equation to be solved in.\n  The original equations were:",
        ),
        (
            recorded.UNKNOWN_CLASS,
            ModelicaError,
            "/home/user/lib/M.mo: Class NoSuch.Model not found in scope <TOP>. (model M)",
        ),
        (
            recorded.UNKNOWN_FMI_VERSION,
            UnsupportedModelError,
            "M: Unknown FMU version 3.0. Only version 1.0 & 2.0 are supported.",
        ),
    ],
)
def test_errors_with_the_place_that_omc_gives(text: str, kind: type[BuildError], message: str) -> None:
    error = failure(read_messages(text), "M", FILE)
    assert type(error) is kind
    assert str(error) == message


def test_the_c_compiler_has_failed() -> None:
    error = failure(read_messages(recorded.MISSING_C_COMPILER), "M", FILE)
    assert type(error) is ToolchainError
    assert "make: no-such-cc: Permission denied" in str(error)


def test_what_omc_does_not_support() -> None:
    text = "[M.mo:2:3-2:9:writable] Error: The language feature overloading is not supported.\n"
    assert type(failure(read_messages(text), "M", FILE)) is UnsupportedModelError


def test_no_reason_at_all() -> None:
    """A name of an FMU that does not exist, and warnings alone."""
    error = failure(read_messages(recorded.WARNINGS), "M", FILE)
    assert type(error) is BuildError
    assert str(error) == "/home/user/lib/M.mo: omc made no FMU and gave no reason (model M)"
