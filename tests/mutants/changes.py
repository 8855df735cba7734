"""Changes of a Python or C file that keep it valid: of an operator, a constant or a statement."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

#: Replacements of operators.
_OPPOSITES: Final = (
    *(("<", "<="), (">", ">="), ("==", "!="), ("+", "-"), ("+=", "-=")),
    *(("&&", "||"), ("and", "or")),
)
_OTHERS: Final = {"*": "+", "/": "*", "is not": "is", "not in": "in"}
_OPERATORS: Final = dict(_OPPOSITES) | {after: before for before, after in _OPPOSITES} | _OTHERS
#: Searched for with texts and comments blanked. Without blanks around it, it may be a sign or a pointer.
_OPERATOR: Final = re.compile(r"(?<= )(?:[<>=!]=|[+-]=|&&|\|\||[<>+*/-]|and|or|is not|not in)(?= )")
_NUMBER: Final = re.compile(r"(?<![\w.])\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.])")
_TRUTH: Final = re.compile(r"\b(?:True|False|true|false)\b")
_TRUTHS: Final = {"True": "False", "False": "True", "true": "false", "false": "true"}
_C_TEXT: Final = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.DOTALL)
_C_PREPROCESSOR: Final = re.compile(r"^[ \t]*#(?:[^\n\\]|\\.)*", re.MULTILINE | re.DOTALL)
_C_DECLARED: Final = "return|break|continue|goto|const |static |double |int |size_t |bool "
_C_STATEMENT: Final = re.compile(rf"^[ \t]+(?!{_C_DECLARED})[\w>.\[\]*()-]+ ?[^;{{}}\n]*;$", re.MULTILINE)


@dataclass(frozen=True)
class Change:
    """One change of a text.

    Attributes:
        at: offset in the text
        line: number of the line, from 1
        before: text at this place
        after: text that replaces it
    """

    at: int
    line: int
    before: str
    after: str


def changes(file: Path) -> list[Change]:
    """Return all possible changes of a file."""
    text = file.read_text("utf-8")
    is_c = file.suffix == ".c"
    code = _c_code(text) if is_c else _python_code(text)
    found = [(one.start(), one[0], _OPERATORS[one[0]]) for one in _OPERATOR.finditer(code)]
    found += [(one.start(), one[0], _other_number(one[0])) for one in _NUMBER.finditer(code)]
    found += [(one.start(), one[0], _TRUTHS[one[0]]) for one in _TRUTH.finditer(code)]
    found += _c_statements(text, code) if is_c else _python_statements(text)
    return [Change(at, text.count("\n", 0, at) + 1, before, after) for at, before, after in sorted(found)]


def _other_number(number: str) -> str:
    if number.isdecimal():
        return str(int(number) + 1)
    return f"{float(number) * 1.5 or 1.0!r}"


def _blanked(text: str, parts: Iterator[tuple[int, int]]) -> str:
    for start, end in parts:
        text = text[:start] + re.sub(r"[^\n]", " ", text[start:end]) + text[end:]
    return text


def _c_code(text: str) -> str:
    code = _blanked(text, (one.span() for one in _C_TEXT.finditer(text)))
    return _blanked(code, (one.span() for one in _C_PREPROCESSOR.finditer(code)))


def _c_statements(text: str, code: str) -> list[tuple[int, str, str]]:
    return [(one.start(), text[one.start() : one.end()], ";") for one in _C_STATEMENT.finditer(code)]


def _offsets(text: str) -> list[int]:
    """Return the offset of each line."""
    return [0, *(one.end() for one in re.finditer("\n", text))]


def _place(node: ast.AST, text: str, lines: list[int]) -> tuple[int, int]:
    """Return where a node begins and ends; ast counts the bytes of a line."""

    def at(line: int, column: int) -> int:
        start = lines[line - 1]
        return start + len(text[start:].split("\n", 1)[0].encode()[:column].decode())

    assert isinstance(node, ast.expr | ast.stmt)
    assert node.end_lineno is not None
    assert node.end_col_offset is not None
    return at(node.lineno, node.col_offset), at(node.end_lineno, node.end_col_offset)


def _python_code(text: str) -> str:
    """Blank texts, comments and annotations, which the tests do not run."""
    lines, parts = _offsets(text), []
    for node in ast.walk(ast.parse(text)):
        is_text = isinstance(node, ast.Constant) and isinstance(node.value, str | bytes)
        if is_text or isinstance(node, ast.JoinedStr):
            parts.append(_place(node, text, lines))
        noted = [getattr(node, "annotation", None), getattr(node, "returns", None)]
        parts += [_place(one, text, lines) for one in noted if isinstance(one, ast.expr)]
    code = _blanked(text, iter(parts))
    return _blanked(code, (one.span() for one in re.finditer("#[^\n]*", code)))


def _python_statements(text: str) -> list[tuple[int, str, str]]:
    """Return assignments and calls within functions, each to be replaced by ``pass``."""
    lines, found = _offsets(text), []
    for function in ast.walk(ast.parse(text)):
        if not isinstance(function, ast.FunctionDef):
            continue
        for node in ast.walk(function):
            is_call = isinstance(node, ast.Expr) and isinstance(node.value, ast.Call)
            if is_call or isinstance(node, ast.AugAssign | ast.Assign):
                start, end = _place(node, text, lines)
                found.append((start, text[start:end], "pass"))
    return sorted(set(found))
