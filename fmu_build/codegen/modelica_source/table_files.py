"""Turn tables in text files into parameters of their blocks before a model is compiled.

The format is that of ``Modelica.Blocks.Tables.CombiTable1Ds`` in the Modelica Standard Library: first ``#1``,
then matrices as ``double name(rows,columns)`` followed by their numbers row by row; ``#`` starts a comment.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

from fmu_build.codegen.modelica_source.modifiers import closing
from fmu_build.codegen.modelica_source.places import place_at
from fmu_build.codegen.modelica_source.text import blanked
from fmu_build.support.errors import ModelicaError, UnsupportedModelError

_BLOCK = re.compile(
    r"\b(?P<kind>CombiTable1Ds|CombiTable1Dv|CombiTable2Ds|CombiTable2Dv|CombiTimeTable)\s+\w+\s*(?P<open>\()"
)
_ON_FILE = re.compile(r"\btableOnFile\s*=\s*true\b")
_TABLE_NAME = re.compile(r'\btableName\s*=\s*"(?P<text>[^"\\]*)"')
_STRING = r'"([^"\\]*)"'
_FILE_NAME = re.compile(rf"\bfileName\s*=\s*(?P<value>{_STRING}|[\w.]*\bloadResource\s*\(\s*{_STRING}\s*\))")
_URI = re.compile(r"modelica://(?P<library>\w+)/(?P<path>.+)")
_MATRIX = re.compile(
    r"\b(?:double|float)\s+(?P<name>[^\s,()]+)\s*\(\s*(?P<rows>\d+)\s*,\s*(?P<columns>\d+)\s*\)"
    r"(?P<numbers>[-+.\deE\s,;]*)"
)


def with_tables_from_files(file: Path, text: str, libraries: Mapping[str, Path]) -> str:
    """Return a text in which blocks with ``tableOnFile = true`` have the table itself as a parameter instead.

    The parameter fileName becomes the plain name, without loadResource(), which is an external function. A
    block whose tableOnFile is not a literal is left alone: `fmu_build.codegen.tables` refuses it.

    Args:
        file: file of the text; a relative fileName starts from its folder.
        text: Modelica source.
        libraries: folders of libraries by name, for ``modelica://`` URIs.

    Raises:
        ModelicaError: the file, or the table in it, does not exist; names the position of the block
        UnsupportedModelError: tableName or fileName is neither a string nor loadResource() of one
    """
    plain = blanked(text)
    blocks = [(found.start(), found.end("open"), found["kind"]) for found in _BLOCK.finditer(plain)]
    for on_file in reversed([*_ON_FILE.finditer(plain)]):
        place = place_at(file, text, on_file.start())
        around = [one for one in blocks if one[1] <= on_file.start() < closing(plain, one[1] - 1)]
        _, start, kind = around[-1] if around else (0, on_file.start(), "")
        end = closing(plain, start - 1) - 1 if around else start
        name, source = (pattern.search(text, start, end) for pattern in (_TABLE_NAME, _FILE_NAME))
        if name is None or source is None:
            raise UnsupportedModelError(
                f"{place}: tableOnFile = true: the build reads the file, so beside it tableName must be a "
                "string, and fileName a string or loadResource() of a string"
            )
        path = source[2] if source[2] is not None else source[3]
        try:
            rows = read_table(_path(path, file, libraries), name["text"])
        except ModelicaError as error:
            raise ModelicaError(f"{place}: {error}") from error
        added = f", table = [{'; '.join(', '.join(map(repr, row)) for row in rows)}]"
        if not kind.startswith("CombiTable2") and not re.search(r"\bcolumns\b", plain[start:end]):
            added += ", columns = {2}"  # the default is 2:size(table, 2), of a table that has not been read
        value = on_file.end() - len("true"), on_file.end(), "false"
        edits = [(end, end, added), (*source.span("value"), f'"{path}"'), value]
        for first, last, new in sorted(edits, reverse=True):
            text = text[:first] + new + text[last:]
    return text


def _path(name: str, file: Path, libraries: Mapping[str, Path]) -> Path:
    uri = _URI.fullmatch(name)
    if uri is None:
        return file.parent / name
    if uri["library"] not in libraries:
        raise ModelicaError(f"{name}: there is no library {uri['library']}")
    return libraries[uri["library"]] / uri["path"]


def read_table(file: Path, name: str) -> list[list[float]]:
    """Return a matrix in a text file, row by row.

    Raises `ModelicaError` with the file if it cannot be read, has another format, or lacks the matrix.
    """
    try:
        text = file.read_text("utf-8-sig")
    except (OSError, ValueError) as error:
        raise ModelicaError(f"cannot read the table file {file}: {error}") from error
    if not text.startswith("#1"):
        raise ModelicaError(f"{file}: not a table file: its first characters must be #1 (text format)")
    matrices = {found["name"]: found for found in _MATRIX.finditer(re.sub(r"#[^\n]*", "", text))}
    if name not in matrices:
        raise ModelicaError(f"{file}: there is no table {name!r}; there are {', '.join(matrices) or 'none'}")
    matrix = matrices[name]
    rows, columns = int(matrix["rows"]), int(matrix["columns"])
    try:
        numbers = [float(number) for number in re.split(r"[\s,;]+", matrix["numbers"].strip())]
    except ValueError as error:
        raise ModelicaError(f"{file}: in the table {name}: {error}") from error
    if len(numbers) != rows * columns or not numbers:
        raise ModelicaError(f"{file}: the table {name}({rows},{columns}) has {len(numbers)} numbers")
    return [numbers[i : i + columns] for i in range(0, len(numbers), columns)]
