"""Components that interpolate with a table object of their own, as friction elements of MSL 4.1 do.

The object, an external object with C functions, is replaced by its arguments, and calls with it by calls of
the Modelica function in ``FmuBuildTables.mo``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from fmu_build.codegen.modelica_source.text import blanked

_OBJECT = re.compile(
    r"\bfinal\s+parameter\s+(?:[\w.]+\.)?ExternalCombiTable1D\s+(?P<name>\w+)\s*=\s*"
    r"(?:[\w.]+\.)?ExternalCombiTable1D\s*(?P<open>\()"
)
_CALL = r"(?<![\w.])(?:[\w.]+\.)?getTable1DValue(?:NoDer2?)?\s*(?P<open>\()\s*NAME\s*,"
_VALUE = "FmuBuildTables.value1D({column}, {table}, {smoothness}, {extrapolation}, {u})"
#: rumoca does not accept Integer() of an enumeration literal in a call.
_NUMBERS = {"HoldLastPoint": "1", "LastTwoPoints": "2", "Periodic": "3", "NoExtrapolation": "4"}
_PARAMETER = re.compile(
    r"\b(?:final\s+)?parameter\s+(?P<declared>[\w.]+\s+(?P<name>\w+)\s*(?:\([^()]*\))?)\s*=(?P<value>[^;]*);"
)
#: A choice between calls by smoothness; a single call suffices, because they now have the same callee.
_CHOICE = re.compile(
    r"\bif\s+[\w.]+\s*==\s*[\w.]+\s+then\s+(?P<call>FmuBuildTables\.value1D\([^;]*?)\s+else\s*if\s+[\w.]+\s*=="
    r"\s*[\w.]+\s+then\s+(?P=call)\s+else\s+(?P=call)(?!\w)"
)


def without_table_objects(text: str) -> str:
    """Return the text with calls of Modelica functions in place of table objects; line numbers do not change.

    An object is kept if it reads a file, or if it is used for anything but values.
    """
    while (found := _first(text)) is not None:
        text = found
    return _with_equations(_CHOICE.sub(lambda choice: choice["call"] + "\n" * _lost(choice), text))


def _with_equations(text: str) -> str:
    """Turn bindings of parameters that depend on a table, which rumoca does not accept, into equations."""
    taken = ["FmuBuildTables.value1D"]
    while (found := _dependent(plain := blanked(text), taken)) is not None:
        section = re.compile(r"\bequation\b").search(plain, found.end())
        if section is None:
            break
        taken.append(found["name"])
        value = found["value"].rstrip()
        end = found.start("value") + len(value)
        declared = text[slice(*found.span("declared"))] + "\n" * value.count("\n") + text[end : found.end()]
        equation = f" {found['name']} = {' '.join(value.split())};"
        text = (
            text[: found.start()]
            + declared
            + text[found.end() : section.end()]
            + equation
            + text[section.end() :]
        )
    return text


def _dependent(plain: str, names: Sequence[str]) -> re.Match[str] | None:
    """Return the first parameter whose value contains one of the names."""
    pattern = re.compile(rf"(?<![\w.])(?:{'|'.join(map(re.escape, names))})(?!\w)")
    parameters = (one for one in _PARAMETER.finditer(plain) if len(_parts(one["value"], one["value"])) == 1)
    return next((one for one in parameters if pattern.search(one["value"])), None)


def _first(text: str) -> str | None:
    """Return the text without the first object that can be replaced; None if there is none."""
    plain = blanked(text)
    for declared in _OBJECT.finditer(plain):
        end = _closing(plain, declared.start("open"))
        arguments = dict(
            part.strip().partition("=")[::2]
            for part in _parts(text[declared.end() : end], plain[declared.end() : end])
        )
        given = {name.strip(): value.strip() for name, value in arguments.items()}
        is_inside = all(given.get(name) == '"NoName"' for name in ("tableName", "fileName"))
        if not is_inside or not {"table", "columns", "smoothness", "extrapolation"} <= given.keys():
            continue
        name = declared["name"]
        semicolon = plain.index(";", end)
        lines = "\n" * text.count("\n", declared.start(), semicolon)
        kept = f"final parameter Integer {name}_columns[:] = {given['columns']}{lines}"
        replaced = text[: declared.start()] + kept + text[semicolon:]
        replaced = _with_values(replaced, name, given)
        if not re.search(rf"(?<![\w.]){name}(?!\w)", blanked(replaced)):
            return replaced
    return None


def _with_values(text: str, name: str, given: dict[str, str]) -> str:
    call = re.compile(_CALL.replace("NAME", name))
    while (found := call.search(plain := blanked(text))) is not None:
        end = _closing(plain, found.start("open"))
        column, u = (part.strip() for part in _parts(text[found.end() : end], plain[found.end() : end]))
        kinds = {kind: _number(given[kind]) for kind in ("smoothness", "extrapolation")}
        value = _VALUE.format(column=f"{name}_columns[{column}]", table=given["table"], u=u, **kinds)
        text = text[: found.start()] + value + text[end + 1 :]
    return text


def _number(value: str) -> str:
    return _NUMBERS.get(value.rpartition(".")[2], f"Integer({value})")


def _lost(choice: re.Match[str]) -> int:
    return choice[0].count("\n") - choice["call"].count("\n")


def _closing(plain: str, opening: int) -> int:
    """Return the position of the parenthesis that closes the one at `opening`, or the end."""
    depth = 0
    for place in range(opening, len(plain)):
        depth += {"(": 1, ")": -1}.get(plain[place], 0)
        if depth == 0:
            return place
    return len(plain) - 1


def _parts(text: str, plain: str) -> Sequence[str]:
    """Split arguments at the commas between them."""
    depth, parts, begin = 0, [], 0
    for place, character in enumerate(plain):
        depth += {"(": 1, "{": 1, "[": 1, ")": -1, "}": -1, "]": -1}.get(character, 0)
        if character == "," and depth == 0:
            parts.append(text[begin:place])
            begin = place + 1
    return [*parts, text[begin:]]
