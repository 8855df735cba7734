"""Reading XLSX, ODS, MATLAB and Parquet tables as rows of cells; formats are detected by content."""

from __future__ import annotations

import datetime
import importlib
import pickle
import subprocess
import sys
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd

from pyjoystick.motion.logs.grid import is_thousands
from pyjoystick.motion.logs.row_widths import Row
from pyjoystick.motion.logs.workbooks import read_ods, read_xlsx
from pyjoystick.motion.records.errors import RecordError
from pyjoystick.support import ARCHIVE_ERRORS, archive_problem, is_number_text

_SECOND: Final = datetime.timedelta(seconds=1)
_LONGEST: Final = 10_000_000
#: In which a MATLAB file is read, or not at all.
_SECONDS: Final = 120.0


def form_of(path: Path, head: bytes) -> str:
    """Format of a file by its first bytes: xlsx, ods, matlab, matlab 7.3, parquet, or empty for text.

    Raises:
        RecordError: the format is not supported; the message says what to do
    """
    suffix = path.suffix.casefold()
    if head.startswith(b"PK\3\4"):
        names = _names_in_archive(path)
        return (
            "xlsx" if "xl/workbook.xml" in names else "ods" if "content.xml" in names else _refuse_zip(path)
        )
    if head.startswith((b"\x89HDF", b"MATLAB 7.3")):
        return "matlab 7.3"
    if head.startswith(b"MATLAB 5.0") or suffix == ".mat":
        return "matlab"
    if head.startswith(b"PAR1"):
        return "parquet"
    markers = suffix == ".c3d" or (suffix == ".trc" and b"\t" in head) or head.startswith(b"PathFileType")
    if markers or head.removeprefix(b"\xef\xbb\xbf").startswith(b"Trajectories"):
        advice = f"make a record of the angle from them: pyjoystick import markers {path}"
        raise RecordError(str(path), "holds markers, not an angle", advice)
    if head.startswith(b"\xd0\xcf\x11\xe0"):
        raise RecordError(str(path), "is a workbook of Excel 97 to 2003", "save it as .xlsx")
    return ""


def _names_in_archive(path: Path) -> list[str]:
    try:
        with zipfile.ZipFile(path) as archive:
            return archive.namelist()
    except ARCHIVE_ERRORS as error:
        reason = f"is a damaged archive: {archive_problem(error)}"
        raise RecordError(str(path), reason, "copy or save the file again") from error


def _refuse_zip(path: Path) -> str:
    raise RecordError(str(path), "is an archive but not a workbook", "unpack it and give the table inside")


def load(path: Path, form: str, sheet: str) -> tuple[list[Row], bool]:
    """Rows of a file that is not text, and whether its numbers are stored as numbers.

    Args:
        path: the file
        form: from `form_of`
        sheet: name of the sheet or structure; if empty, there must be only one

    Raises:
        RecordError: the package for this format is missing, the file is damaged, or has several sheets
    """
    package, extra, reader = _READERS[form]
    try:
        importlib.import_module(package)
    except ImportError as error:
        advice = f"pip install {package_of(package)}, or pip install 'pyjoystick[{extra}]'"
        raise RecordError(str(path), f"needs the package {package_of(package)} to be read", advice) from error
    try:
        tables = reader(path)
    except Exception as error:  # packages raise many types for damaged files
        reason = f"cannot be read as {form}: {error}"
        raise RecordError(str(path), reason, "save the file again, or export it as CSV") from error
    name = _chosen(path, tables, sheet)
    rows = list(tables[name].itertuples(index=False, name=None))
    typed = any(isinstance(cell, int | float) and cell == cell for row in rows for cell in row)
    doubtful = _columns_of_doubtful_texts(rows) if typed else frozenset()
    cells = [
        [f"'{cell}" if i in doubtful and is_thousands(cell) else _text_of(cell) for i, cell in enumerate(row)]
        for row in rows
    ]
    return list(enumerate(cells, start=1)), typed


def _columns_of_doubtful_texts(rows: Sequence[tuple[object, ...]]) -> frozenset[int]:
    """The columns in which all texts with points, as ``1.527``, may be numbers with separated thousands.

    Such a text gets an apostrophe, as Excel writes a text: it is none of the numbers in its column.
    """
    texts = [
        (i, cell)
        for row in rows
        for i, cell in enumerate(row)
        if isinstance(cell, str) and is_number_text(cell)
    ]
    plain = {i for i, cell in texts if "." in cell and not is_thousands(cell)}
    return frozenset(i for i, _ in texts) - plain


def _text_of(value: object) -> str:
    """Text of a typed value: times of day, dates and durations in ISO 8601."""
    if value is None:
        return ""
    if isinstance(value, datetime.timedelta):
        return f"PT{value / _SECOND:.9f}S"
    if isinstance(value, bool):
        return str(value)
    if isinstance(value, datetime.date | datetime.time):
        return value.isoformat()
    if isinstance(value, bytes):
        return value.decode(errors="replace")
    return repr(value) if isinstance(value, float) else str(value).strip()


def _chosen(path: Path, tables: Mapping[str, pd.DataFrame], sheet: str) -> str:
    if sheet:
        if sheet not in tables:
            raise RecordError(
                str(path), f"has no sheet {sheet!r}", f"there are {', '.join(map(repr, tables))}"
            )
        return sheet
    filled = [name for name, table in tables.items() if table.size]
    if len(filled) == 1:
        return filled[0]
    if not filled:
        raise RecordError(str(path), "holds no table", "write headings, then one sample per row")
    advice = f"say which: {' or '.join(f'--sheet {name!r}' for name in filled)}"
    raise RecordError(str(path), f"has {len(filled)} sheets with content", advice)


def package_of(module: str) -> str:
    """The package to install for a module."""
    return {"odf": "odfpy"}.get(module, module)


def _parquet(path: Path) -> dict[str, pd.DataFrame]:
    frame = pd.read_parquet(path, engine="pyarrow")
    if frame.index.name is not None:
        frame = frame.reset_index()
    return {"": _headed({str(name): frame[name] for name in frame.columns})}


def _matlab(path: Path, form: str = "matlab") -> dict[str, pd.DataFrame]:
    """Tables in a MATLAB file, which another process reads, because a damaged one can end it."""
    script = Path(__file__).with_name("matlab_script.py")
    command = [sys.executable, "-P", str(script), form, str(path)]
    try:
        done = subprocess.run(
            command, stdin=subprocess.DEVNULL, capture_output=True, timeout=_SECONDS, check=False
        )
    except subprocess.TimeoutExpired as error:
        raise ValueError(f"that takes more than {_SECONDS:g} s") from error
    if done.returncode != 0:
        lines = done.stderr.decode(errors="replace").strip().splitlines()
        raise ValueError(lines[-1] if lines and done.returncode == 1 else "it is damaged")
    return _tables(pickle.loads(done.stdout))  # of this project's script


def _matlab_7_3(path: Path) -> dict[str, pd.DataFrame]:
    return _matlab(path, "matlab 7.3")


def _tables(variables: Mapping[str, Any]) -> dict[str, pd.DataFrame]:
    """Tables in MATLAB variables: one of the vectors, and one per structure, if the vectors match."""
    columns = dict(_vectors(variables, ""))
    if len({len(column) for column in columns.values()}) == 1:
        return {"": _headed(columns)}
    parts = {name: dict(_vectors(one, "")) for name, one in variables.items() if isinstance(one, Mapping)}
    parts[""] = {name: one for name, one in columns.items() if "." not in name}
    lengths = {name: {len(column) for column in part.values()} for name, part in parts.items()}
    if any(len(found) > 1 for found in lengths.values()):
        sizes = ", ".join(f"{name} {len(column)}" for name, column in columns.items())
        raise ValueError(f"its vectors have different lengths ({sizes}); save the vectors of one record only")
    return {name: _headed(part) for name, part in parts.items() if part}


def _vectors(value: Any, name: str) -> Iterator[tuple[str, Any]]:
    """Vectors in a variable with their names, including columns of a matrix; others are skipped."""
    if isinstance(value, Mapping):
        for field, one in value.items():
            yield from _vectors(one, f"{name}.{field}" if name else field)
        return
    array = np.asarray(value)
    if array.dtype.kind not in "iufb" or array.size < 2 or array.ndim > 2:
        return
    if array.size > _LONGEST:
        raise ValueError(f"its variable {name} has {array.size} values; at most {_LONGEST} are read")
    if array.ndim == 2:
        columns = array if array.shape[0] >= array.shape[1] else array.T
        yield from ((f"{name} #{i + 1}", column) for i, column in enumerate(columns.T))
    else:
        yield name, array


def _headed(columns: Mapping[str, Any]) -> pd.DataFrame:
    """Columns below a row of their names, as in a sheet."""
    if not columns:
        return pd.DataFrame()
    cells = {
        i: pd.Series([name, *one.tolist()], dtype=object) for i, (name, one) in enumerate(columns.items())
    }
    return pd.DataFrame(cells)


_READERS: Final[Mapping[str, tuple[str, str, Callable[[Path], dict[str, pd.DataFrame]]]]] = {
    "xlsx": ("openpyxl", "excel", read_xlsx),
    "ods": ("odf", "ods", read_ods),
    "matlab": ("scipy", "matlab", _matlab),
    "matlab 7.3": ("h5py", "matlab", _matlab_7_3),
    "parquet": ("pyarrow", "parquet", _parquet),
}
