"""The tables of the Modelica Standard Library without its C functions.

The blocks keep their interface and public parameters. The rest, an external object and calls of C functions
with it, is replaced by calls of the Modelica functions in ``FmuBuildTables.mo``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from fmu_build.codegen.modelica_source.table_objects import without_table_objects
from fmu_build.codegen.modelica_source.text import blanked

_FUNCTIONS = Path(__file__).with_name("FmuBuildTables.mo")

_WARNING = (
    "assert(not (verboseExtrapolation and Integer(extrapolation) <= 2) or noEvent({inside}),"
    ' "The table is extrapolated: {name} (=" + String({0}) + ") is not in the range from " + String({1})'
    ' + " to " + String({2}), level = AssertionLevel.warning);'
)
_ERROR = (
    "assert(Integer(extrapolation) <> 4 or noEvent({inside}),"
    ' "The table must not be extrapolated: {name} (=" + String({0}) + ") is not in the range from "'
    ' + String({1}) + " to " + String({2}));'
)
_COLUMNS = (
    'assert(min(columns) >= 1 and max(columns) <= size(table, 2), "columns must be those of the table");'
)
_ONE_INPUT = f"""
final parameter Real u_min = table[1, 1]; final parameter Real u_max = table[size(table, 1), 1];
protected
final parameter Real leastStep = FmuBuildTables.leastRowStep(1, table);
equation
assert(leastStep > 0, "The first column of the table must increase strictly");
{_COLUMNS}
"""
_TWO_INPUTS = """
assert(Integer(smoothness) == 1 or Integer(smoothness) == 3,
  "Tables with two inputs are supported with smoothness LinearSegments and ConstantSegments");
"""
_VALUE_1D = "FmuBuildTables.value1D(columns[i], table, Integer(smoothness), Integer(extrapolation), {0});"
_VALUE_2D = "FmuBuildTables.value2D(Integer(smoothness), Integer(extrapolation), table, {0}, {1});"


def _checked(variable: str, least: str, most: str, inside: str = "{0} >= {1} and {0} <= {2}") -> str:
    names = variable, least, most
    name = variable.replace("[i]", '[" + String(i) + "]')
    return (_WARNING + _ERROR).format(*names, name=name, inside=inside.format(*names))


_TIME_INSIDE = "stop == 0 or reached >= {1} and 2*{0} - reached <= {2}"
_ENDS = {
    "CombiTable1Ds": _ONE_INPUT
    + _checked("u", "u_min", "u_max")
    + f"for i in 1:nout loop y[i] = {_VALUE_1D.format('u')} end for;",
    "CombiTable1Dv": _ONE_INPUT
    + f"for i in 1:n loop {_checked('u[i]', 'u_min', 'u_max')} y[i] = {_VALUE_1D.format('u[i]')} end for;",
    "CombiTable2DBase": """
final parameter Real u_min[2] = {table[2, 1], table[1, 2]};
final parameter Real u_max[2] = {table[size(table, 1), 1], table[1, size(table, 2)]};
protected
final parameter Real leastStep1 = FmuBuildTables.leastRowStep(2, table);
final parameter Real leastStep2 = FmuBuildTables.leastColumnStep(table);
equation
assert(leastStep1 > 0 and leastStep2 > 0,
  "The first column and the first row of the table must increase strictly");
"""
    + _TWO_INPUTS,
    "CombiTable2Ds": "equation\n"
    + _checked("u1", "u_min[1]", "u_max[1]")
    + _checked("u2", "u_min[2]", "u_max[2]")
    + f"y = {_VALUE_2D.format('u1', 'u2')}",
    "CombiTable2Dv": "equation\nfor i in 1:n loop\n"
    + _checked("u1[i]", "u_min[1]", "u_max[1]")
    + _checked("u2[i]", "u_min[2]", "u_max[2]")
    + f"y[i] = {_VALUE_2D.format('u1[i]', 'u2[i]')} end for;",
    "CombiTimeTable": f"""
final parameter Real t_minScaled = table[1, 1]; final parameter Real t_maxScaled = table[size(table, 1), 1];
final parameter Real t_min = t_minScaled*timeScale; final parameter Real t_max = t_maxScaled*timeScale;
protected
final parameter Real p_offset[nout] = if size(offset, 1) == 1 then ones(nout)*offset[1] else offset;
discrete Real nextTimeEvent(start = 0, fixed = true);
discrete Integer periods(start = 0, fixed = true);
discrete Integer first(start = 1, fixed = true);
discrete Integer stop(start = 0, fixed = true);
Real timeScaled = time/timeScale - shiftTime/timeScale;
Real timeInside = timeScaled - periods*(t_maxScaled - t_minScaled);
Real reached "Time, or later by its rounding error";
final parameter Real leastStep = FmuBuildTables.leastRowStep(1, table);
equation
assert(leastStep > 0 or leastStep == 0 and (Integer(smoothness) == 1 or Integer(smoothness) == 3),
  "The first column of the table must increase");
assert(Integer(extrapolation) <> 3 or size(table, 1) == 1 or t_maxScaled > t_minScaled,
  "The period must be positive");
{_COLUMNS}
{_checked("timeScaled", "t_minScaled", "t_maxScaled", _TIME_INSIDE)}
reached = timeScaled
  + 1e-14*(abs(timeScaled) + abs(shiftTime/timeScale) + abs(t_minScaled) + abs(t_maxScaled));
when {{time >= pre(nextTimeEvent), initial()}} then
periods = FmuBuildTables.periods(Integer(extrapolation), table, reached);
stop = FmuBuildTables.stopRow(Integer(smoothness), table, Integer(timeEvents),
  startTime/timeScale - shiftTime/timeScale, reached, reached - periods*(t_maxScaled - t_minScaled));
first = FmuBuildTables.firstRow(Integer(smoothness), Integer(timeEvents), table, stop);
nextTimeEvent = FmuBuildTables.eventTime(table, stop, periods, startTime, shiftTime, timeScale);
end when;
for i in 1:nout loop y[i] = p_offset[i] + FmuBuildTables.valueInInterval(
  columns[i], table, Integer(smoothness), Integer(extrapolation), first, stop, timeInside); end for;
""",
}
_BLOCK = re.compile(rf"\bblock\s+(?P<name>{'|'.join(_ENDS)})\b(?P<body>.*?)\bend\s+(?P=name)\s*;", re.DOTALL)
_END = re.compile(
    r"\b(?:final\s+parameter\s+[\w.]+\s+[tu]_min\b|equation\b).*?(?=\bannotation\b|\Z)", re.DOTALL
)
"""From the first variable that depends on the external object to the annotation of the block."""
_FIXED = re.compile(
    r"\bparameter\s+(?:Integer\s+columns|Boolean\s+tableOnFile)\b[^;]*?(?:(?P<annotation>\bannotation\s*\()|(?=;))"
)
"""Parameters that cannot be set in the FMU: few other columns would be valid, and files are read at build
time.
"""
_EXTERNAL_OBJECT = re.compile(r"\bExternalCombi(?:TimeTable|Table[12]D)\b")


def with_own_tables(texts: Mapping[Path, str]) -> dict[Path, str]:
    """Return the texts with table blocks that call Modelica functions, adding those functions if needed.

    Lines outside the rewritten parts stay in place.
    """
    changed = {file: _own_tables(text) for file, text in texts.items()}
    if changed != texts:
        changed[_FUNCTIONS] = _FUNCTIONS.read_text("utf-8")
    return changed


def _own_tables(text: str) -> str:
    if not _EXTERNAL_OBJECT.search(text):
        return text
    plain = blanked(text)
    for block in reversed([*_BLOCK.finditer(plain)]):
        body = block.span("body")
        end = _END.search(plain, *body)
        if end is None:
            continue
        lines = "\n" * text.count("\n", *end.span())
        text = text[: end.start()] + " ".join(_ENDS[block["name"]].split("\n")) + lines + text[end.end() :]
        for one in reversed([*_FIXED.finditer(plain, body[0], end.start())]):
            fixed = "Evaluate = true, " if one["annotation"] else " annotation (Evaluate = true)"
            text = text[: one.end()] + fixed + text[one.end() :]
    return without_table_objects(text)
