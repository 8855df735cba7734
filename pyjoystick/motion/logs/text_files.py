"""Tables in text files: encoding, delimiter and decimal mark are detected if unambiguous."""

from __future__ import annotations

import codecs
import re
from collections.abc import Sequence
from itertools import groupby, pairwise
from pathlib import Path
from typing import Final

from charset_normalizer import from_bytes

from pyjoystick.motion.logs.grid import Candidate, find_table
from pyjoystick.motion.logs.headings import meaning, understood
from pyjoystick.motion.logs.layout import Layout
from pyjoystick.motion.logs.row_widths import Row
from pyjoystick.motion.records.errors import RecordError
from pyjoystick.motion.stumps import require_no_zeros
from pyjoystick.motion.table_files import cells_of_line, is_blank, is_comment
from pyjoystick.support import is_number_text

_DELIMITERS: Final = {"comma": ",", "semicolon": ";", "tab": "\t", "bar": "|", "space": " "}
_REMARKS: Final = ("#", "%", "//")
_BOMS: Final = {
    codecs.BOM_UTF8: "utf-8-sig",
    codecs.BOM_UTF32_LE: "utf-32",
    codecs.BOM_UTF32_BE: "utf-32",
    codecs.BOM_UTF16_LE: "utf-16",
    codecs.BOM_UTF16_BE: "utf-16",
}
#: Usual encodings of headings; digits are the same in all of them.
_ENCODINGS: Final = ["cp1252", "cp1250", "cp1251", "mac_roman", "cp437", "shift_jis", "gb18030", "euc_kr"]
#: Number of bytes used to detect the encoding.
_ENOUGH: Final = 1 << 16
#: Number of lines that may contain the headings.
_FIRST_LINES: Final = 100
_SEPARATOR: Final = re.compile(r"[,;\t|]")
#: The part of neighboring lines of which one is empty where all lines are separated.
_NEARLY_ALL: Final = 0.9
_DOS_END: Final = "\x1a"
_LABVIEW_END: Final = "***End_of_Header***"
#: A heading with its unit, if spaces separate the columns.
_WORD: Final = re.compile(r"[^\s(\[]+(?:\s*[(\[][^)\]]*[)\]])?")


def decoded(path: Path, data: bytes, encoding: str) -> tuple[str, str]:
    """Decode a file; returns the text and its encoding.

    Args:
        path: the file, for messages
        data: its content
        encoding: its encoding; empty to detect it

    Raises:
        RecordError: the file is not text, or not in this encoding
    """
    try:
        for name in [encoding] if encoding else _encodings(data):
            try:
                text = data.decode(name).rstrip(_DOS_END)
            except UnicodeDecodeError:
                continue
            require_no_zeros(str(path), text)
            return text, name
    except LookupError:
        pass
    if not encoding and b"\n" in data.partition(b"\0")[0]:
        require_no_zeros(str(path), data.decode("latin-1"))
    reason = (
        f"is not text in {encoding}" if encoding else "is not UTF-8 text, nor in an encoding that is known"
    )
    raise RecordError(str(path), reason, "export it as CSV in UTF-8, or name its encoding: --encoding cp1252")


def _encodings(data: bytes) -> list[str]:
    for mark, name in _BOMS.items():
        if data.startswith(mark):
            return [name]
    if b"\0" in data:
        odd, even = data[1::2].count(0), data[::2].count(0)
        return ["utf-16-le" if odd > even else "utf-16-be"] if max(odd, even) > len(data) // 4 else []
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        # A single degree sign does not identify the encoding: prefer the most usual one among those that fit,
        # unless another turns the headings into more words that are known.
        best = next((one for names in (_ENCODINGS[:1], _ENCODINGS) if (one := _best(data, names))), "cp1252")
        return [max((best, *_ENCODINGS), key=lambda one: _known_words(data, one)), "latin-1"]
    return ["utf-8"]


def _best(data: bytes, encodings: list[str]) -> str:
    found = from_bytes(data[:_ENOUGH], cp_isolation=encodings).best()
    return found.encoding if found else ""


def _known_words(data: bytes, encoding: str) -> int:
    """How many words beyond ASCII in the first lines are the name of a quantity in this encoding."""
    lines = data[:_ENOUGH].decode(encoding, errors="ignore").splitlines()[:_FIRST_LINES]
    cells = (cell.strip(" \"'") for line in lines for cell in _SEPARATOR.split(line) if not cell.isascii())
    names = (understood(cell).name for cell in cells)
    return sum(not name.isascii() and meaning(name) is not None for name in names)


def find_in_text(path: Path, text: str, layout: Layout) -> tuple[Candidate | None, tuple[str, ...]]:
    """The table in a text, and its comments; None if there is none with two columns of numbers.

    Raises:
        RecordError: more than one delimiter or decimal mark is possible
    """
    numbered = enumerate(re.split("\r\n|\r|\n", text), start=1)
    lines = _without_double_spacing([(number, line.strip(" ")) for number, line in numbered])
    remarks = [(number, line.lstrip("#%/ ")) for number, line in lines if is_comment(line, _REMARKS)]
    lines = _after_labview_headers(
        path, [(number, line) for number, line in lines if not is_comment(line, _REMARKS)]
    )
    comments = tuple(line.strip() for _, line in remarks)
    given = _DELIMITERS.get(layout.delimiter, "\t" if layout.delimiter == "\\t" else layout.delimiter)
    # Spreadsheets write rows of delimiters below a table.
    while lines and is_blank(lines[-1][1], "".join(_DELIMITERS.values()) + given):
        lines.pop()
    # Some lines in the second half show the delimiter, even if one of them is damaged.
    shown = [lines[len(lines) * i // 8 - 1][1] for i in range(5, 9)] if lines else []
    found: list[Candidate] = []
    for one in [given] if given else _DELIMITERS.values():
        # Tables with other delimiters contain spaces too: they separate only if nothing else does.
        if any(one in line for line in shown) and not (one == " " and found and not given):
            cells = _split(path, lines, one)
            marks = [layout.decimal] if layout.decimal else [".", ","]
            aside = _split(path, remarks, one)
            is_given = bool(layout.decimal)
            tables = [find_table(cells, aside, one, mark, is_given=is_given) for mark in marks]
            found += _of_best_mark(path, [table for table in tables if table is not None])
    flawless = [one for one in found if not one.faults]
    found = flawless or found
    if len(found) > 1:
        names = [name for name, one in _DELIMITERS.items() if one in {table.delimiter for table in found}]
        advice = f"say which: --delimiter {' or --delimiter '.join(names)}"
        raise RecordError(str(path), f"may be separated by {' or '.join(names)}", advice)
    if found and found[0].doubtful and not layout.decimal:
        _require_certain(path, found[0])
    if found and not text.endswith(("\n", "\r")):
        found[0] = found[0].without_stump()
    return (found[0] if found else None), comments


def find_in_rows(path: Path, rows: list[Row], typed: bool, layout: Layout) -> Candidate | None:
    """The table in the rows of a sheet; None if there is none with two columns of numbers.

    Args:
        path: the file
        rows: its rows
        typed: whether numbers are stored as numbers, whose decimal mark is a point
        layout: known layout

    Raises:
        RecordError: more than one decimal mark is possible
    """
    marks = ["."] if typed else [layout.decimal] if layout.decimal else [".", ","]
    tables = [find_table(rows, [], "", mark) for mark in marks]
    found = _of_best_mark(path, [table for table in tables if table is not None])
    if found and found[0].doubtful and not (typed or layout.decimal):
        _require_certain(path, found[0])
    return found[0] if found else None


def delimiter_name(delimiter: str) -> str:
    """Name of a delimiter."""
    return next((name for name, one in _DELIMITERS.items() if one == delimiter), repr(delimiter))


def _without_double_spacing(lines: Sequence[tuple[int, str]]) -> list[tuple[int, str]]:
    """The lines; without the empty ones if these separate nearly all others, as after a wrong conversion.

    Other empty lines may be samples that were lost.
    """
    is_empty = [not line.strip() for _, line in lines]
    separated = sum(one or other for one, other in pairwise(is_empty))
    if separated < _NEARLY_ALL * (len(lines) - 1):
        return list(lines)
    found: list[tuple[int, str]] = []
    for empty, group in groupby(lines, lambda line: not line[1].strip()):
        those = list(group)
        # Of three, the one in the middle is a line itself.
        found += those[1 : 1 + (len(those) - 1) // 2] if empty else those
    return found


def is_labview_measurement(text: str) -> bool:
    """Whether a text is a LabVIEW measurement file (.lvm)."""
    return _LABVIEW_END in text


def _after_labview_headers(path: Path, lines: list[tuple[int, str]]) -> list[tuple[int, str]]:
    """The lines after the headers of a LabVIEW measurement file (.lvm); all lines of another file.

    The last heading, Comment, is dropped with the comments below it, which rows without one lack.

    Raises:
        RecordError: the file holds several measurements
    """
    ends = [i for i, (_, line) in enumerate(lines) if line.startswith(_LABVIEW_END)]
    if not ends:
        return lines
    if len(ends) > 2:
        reason = f"holds {len(ends) - 1} measurements, each with a header"
        raise RecordError(str(path), reason, "keep one of them", rows=[lines[ends[2]][0]])
    found = lines[ends[-1] + 1 :]
    while found and not found[0][1].strip():
        del found[0]
    last = re.search(r"([\t,;])Comment$", found[0][1]) if found else None
    if last is not None:
        columns = found[0][1].count(last[1])
        found = [(number, _without_comment(line, last[1], columns)) for number, line in found]
    return found


def _without_comment(line: str, delimiter: str, columns: int) -> str:
    """The cells of the columns; the whole line if a number is behind them, where no comment is."""
    cells = line.split(delimiter)
    has_number = any(is_number_text(cell.replace(",", ".")) for cell in cells[columns:])
    return line if has_number else delimiter.join(cells[:columns])


def _split(path: Path, lines: Sequence[tuple[int, str]], delimiter: str) -> list[Row]:
    """Split lines into cells; typographic minus signs are replaced."""
    if delimiter != " ":
        return [
            (
                number,
                [
                    cell.replace("\N{MINUS SIGN}", "-")
                    for cell in cells_of_line(path, number, line, delimiter)
                ],
            )
            for number, line in lines
        ]
    return [(n, _WORD.findall(line) if "(" in line or "[" in line else line.split()) for n, line in lines]


def _of_best_mark(path: Path, tables: list[Candidate]) -> list[Candidate]:
    """The table with the most numbers among those with one delimiter."""
    flawless = [table for table in tables if not table.faults] or tables
    most = max((len(table.numeric) for table in flawless), default=0)
    best = [table for table in flawless if len(table.numeric) == most]
    if len({table.numeric for table in best}) > 1:
        _require_certain(path, best[0])
    return best[:1]


def _require_certain(path: Path, table: Candidate) -> None:
    for number, cells in table.rows:
        for i in table.numeric:
            if table.decimal in cells[i]:
                raise RecordError(
                    str(path),
                    "may be a decimal mark or separate thousands",
                    "say which is the decimal mark: --decimal , or --decimal .",
                    rows=[number],
                    value=repr(cells[i]),
                )
