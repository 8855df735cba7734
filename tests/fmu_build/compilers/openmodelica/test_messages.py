"""Parsing of omc's output, and the errors derived from it."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_build.codegen.modelica_source.places import Place
from fmu_build.compilers.openmodelica.messages import (
    Message,
    errors,
    failure,
    quoted,
    read_answers,
    read_messages,
    unquoted,
    watched,
)
from fmu_build.support.errors import BuildError, ModelicaError, ToolchainError, UnsupportedModelError
from tests.fmu_build.compilers.openmodelica import recorded


def test_an_error_with_its_place() -> None:
    (message,) = read_messages(recorded.SYNTAX_ERROR)
    assert message == Message("error", "Missing token: SEMICOLON", Place("/home/user/lib/bad.mo", 4, 1))
    assert str(message) == "/home/user/lib/bad.mo:4:1: error: Missing token: SEMICOLON"


def test_messages_with_and_without_place_and_quotation_marks() -> None:
    first, second = read_messages(recorded.TYPE_ERROR)
    assert first.place == Place("/home/user/lib/M5.mo", 1, 10)
    assert first.text == 'Type mismatch in binding x = "a", expected subtype of Real, got type String.'
    assert second == Message("error", "Error occurred while flattening model M5")


def test_lines_that_belong_to_the_message_before() -> None:
    error, warning = read_messages(recorded.TOO_FEW_EQUATIONS)
    assert (error.level, warning.level) == ("error", "warning")
    assert warning.text.endswith("solved in.\n  The original equations were:")
    (build,) = read_messages(recorded.MISSING_C_COMPILER)
    assert build.text.endswith("Error 127")
    assert len(build.text.splitlines()) == 3


def test_warnings_are_no_errors() -> None:
    messages = read_messages(recorded.WARNINGS)
    assert [message.level for message in messages] == ["warning", "warning"]
    assert errors(messages) == []


def test_nothing_printed_is_no_message() -> None:
    assert read_messages("") == ()
    assert read_messages("\n") == ()


def test_text_without_a_level_is_an_error() -> None:
    messages = read_messages(recorded.NOT_PARSED)
    assert messages[0] == Message("error", "Error occurred building AST\nSyntax Error")
    assert messages[1].text == "Parser error: Unexpected token near: 1 (UNSIGNED_INTEGER)"


def test_a_message_that_comes_twice_is_told_once() -> None:
    assert len(read_messages(recorded.SYNTAX_ERROR * 2)) == 1


def test_answers_of_a_script() -> None:
    version, option, load, build = read_answers(recorded.SCRIPT_OUTPUT, "MARK", 4)
    assert version.text == "OMCompiler v1.14.2"
    assert not option.succeeded
    assert [m.text for m in option.messages] == ["Unknown option --fmiFlags."]
    assert load.succeeded
    assert load.messages == ()
    assert build.text == ""
    assert [m.text for m in build.messages] == [m.text for m in read_messages(recorded.TYPE_ERROR)]


def test_what_a_tool_prints_before_the_value_does_not_hide_it() -> None:
    (answer,) = read_answers('make: entering\ntrue\n"MARK"\n""\n"MARK"\n', "MARK", 1)
    assert answer.succeeded


@pytest.mark.parametrize(
    ("output", "reason"),
    [
        ('true\n"MARK"\n""\n"MARK"\nError: Stack overflow\n', "Stack overflow"),
        ('true\n"MARK"\n""\n"MARK"\n', "omc stopped without a message"),
        ('true\n"MARK"\n""\n"MARK"\n""\n"MARK"\n"Error: abou', "Error: abou"),
    ],
)
def test_omc_gives_up_on_the_way(output: str, reason: str) -> None:
    answers = read_answers(output, "MARK", 3)
    assert [answer.succeeded for answer in answers] == [True, False]
    assert reason in "".join(str(message) for message in answers[-1].messages)
    assert errors(answers[-1].messages)


def test_a_server_that_cannot_parse() -> None:
    (answer,) = read_answers(recorded.NOT_PARSED, "MARK", 1)
    assert "Parser error" in answer.messages[-1].text


@pytest.mark.parametrize("text", ["", "plain", 'a "quoted" word', r"C:\temp\new", "Übung 1/ä", "two\nlines"])
def test_quoted_and_back(text: str) -> None:
    assert unquoted(quoted(text)) == text


def test_what_is_no_string_stays() -> None:
    assert unquoted("true") == "true"
    assert unquoted('"') == '"'


def test_a_statement_is_followed_by_its_messages() -> None:
    assert watched("loadFile(1)", "m") == 'loadFile(1); "m"; getErrorString(); "m"'


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
