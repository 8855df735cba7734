"""The messages of assert() and terminate() as calls of snprintf."""

from __future__ import annotations

from fmu_build.codegen.c_function import FunctionBody
from fmu_build.codegen.equations import Action

_FORMATS = {"Real": "%.6g", "Integer": "%.0f", "Enumeration": "%.0f", "Boolean": "%s"}
"""String() of a Real has six significant digits (Modelica 3.4, section 3.7.1.1)."""


def message_call(action: Action, body: FunctionBody) -> tuple[str, list[str]]:
    """The statement that formats the message, and the lines that have to come before it."""
    text = ""
    values: list[str] = []
    for part in action.message:
        if isinstance(part, str):
            text += part.replace("%", "%%")
            continue
        kind, value = part
        text += _FORMATS.get(kind, "%.6g")
        written = body.value(value)
        values.append(f'({written}) != 0.0 ? "true" : "false"' if kind == "Boolean" else written)
    arguments = ", ".join([c_string(text), *values])
    return f"snprintf(text, size, {arguments});", body.lines


def c_string(text: str) -> str:
    """A C string literal; characters beyond ASCII are written as UTF-8 octal escapes."""
    escaped = ""
    for byte in text.encode():
        character = chr(byte)
        if character in '"\\':
            escaped += "\\" + character
        elif 32 <= byte < 127:
            escaped += character
        else:
            escaped += f"\\{byte:03o}"
    return f'"{escaped}"'
