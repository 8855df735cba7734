"""Results of sweeps as Parquet or CSV files that include their settings."""

from __future__ import annotations

import csv
import json
from importlib.util import find_spec
from os import PathLike
from pathlib import Path
from typing import Any, Final

import numpy as np
import pandas as pd
from pandas.api.types import is_bool_dtype

from pyjoystick.runs.errors import SweepFileError
from pyjoystick.runs.sweeps.sampling import digest
from pyjoystick.runs.sweeps.sweep import ATTRIBUTE
from pyjoystick.support import MissingPackageError, OutputFileError, replacing

_SUFFIXES: Final = (".parquet", ".csv")


def check_target(path: Path) -> None:
    """Check that the suffix is a format that can be written.

    Raises:
        OutputFileError: another suffix than .parquet or .csv
        MissingPackageError: Parquet without pyarrow
    """
    if path.suffix.lower() not in _SUFFIXES:
        raise OutputFileError(path, f"the name must end in {' or '.join(_SUFFIXES)}")
    if _is_parquet(path) and find_spec("pyarrow") is None:
        raise MissingPackageError("Parquet files", "parquet")


def write_sweep(path: Path, table: pd.DataFrame) -> None:
    """Write the results of a sweep with its settings, atomically.

    Parquet stores the settings as JSON in its metadata, where pandas keeps ``DataFrame.attrs``; CSV in lines
    that start with ``#``.

    Args:
        path: the file, .parquet or .csv
        table: from `Sweep.table`

    Raises:
        OutputFileError: the file cannot be written
    """
    check_target(path)
    with replacing(path) as temporary:
        if _is_parquet(path):
            table.to_parquet(temporary, engine="pyarrow")
        else:
            with temporary.open("w", encoding="utf-8", newline="") as file:
                document = json.dumps(table.attrs[ATTRIBUTE], indent=2)
                file.writelines(f"# {line}\n" for line in document.splitlines())
                # Quoted text may contain a "#" without starting a comment.
                table.to_csv(file, quoting=csv.QUOTE_NONNUMERIC, lineterminator="\n")


def read_sweep(path: str | PathLike[str]) -> pd.DataFrame:
    """Read the results of a sweep, one row per run; ``attrs["sweep"]`` has settings, FMU, versions and units.

    The columns are the varied parameters, the results, ``failed`` and ``message``; the index is ``run``.

    Raises:
        SweepFileError: there is no such file, it is not a result of a sweep, or its runs are not those of its
            settings: some are missing, twice, in another order, or with other parameters or columns
        MissingPackageError: Parquet without pyarrow
    """
    path = Path(path)
    check_target(path)
    try:
        table = pd.read_parquet(path, engine="pyarrow") if _is_parquet(path) else _read_csv(path)
    except FileNotFoundError as error:
        raise SweepFileError(path, "the file does not exist") from error
    except Exception as error:  # pandas and pyarrow raise many types
        raise SweepFileError(path, "is not a result of a sweep, or damaged") from error
    if not isinstance(table.attrs.get(ATTRIBUTE), dict):
        raise SweepFileError(path, "is not a result of a sweep: it has no settings")
    _require_its_runs(path, table)
    return table


def _require_its_runs(path: Path, table: pd.DataFrame) -> None:
    identity = table.attrs[ATTRIBUTE]
    try:
        varied, count = list(identity["settings"]["vary"]), identity["runs"]
        columns = {*identity["units"], "failed", "message"}
        is_whole = table.index.tolist() == list(range(count)) and columns == set(table) >= set(varied)
        if is_whole and is_bool_dtype(table["failed"]) and digest(table[varied]) == identity["runs_sha256"]:
            return
    except (KeyError, TypeError) as error:
        raise SweepFileError(path, "is not a result of a sweep: its settings are damaged") from error
    reason = "its runs are not those of its settings: was the file changed? Make it anew with --overwrite"
    raise SweepFileError(path, reason)


def _is_parquet(path: Path) -> bool:
    return path.suffix.lower() == ".parquet"


def _read_csv(path: Path) -> pd.DataFrame:
    with path.open(encoding="utf-8") as file:
        header = []
        for line in file:
            if not line.startswith("#"):
                break
            header.append(line.removeprefix("#"))
    # Read as text first: Python's conversion restores every digit, whatever the version of pandas.
    text = pd.read_csv(path, comment="#", index_col="run", dtype=str, keep_default_na=False)
    table = text.apply(_converted).set_axis(text.index.astype(np.int64), axis=0).rename_axis("run")
    if not header:
        return table
    document = json.loads("".join(header))
    types, varied = document.get("types", {}), document["settings"]["vary"]
    table = table.astype({name: kind for name, kind in types.items() if name in table and name in varied})
    table.attrs[ATTRIBUTE] = document
    return table


def _converted(column: pd.Series[str]) -> pd.Series[Any]:
    """Convert a column of text to numbers or Booleans, except messages."""
    if column.name == "message":
        return column
    if column.isin(["True", "False"]).all():
        return column == "True"
    if column.str.fullmatch(r"-?\d+").all():
        return pd.Series([int(cell) for cell in column], column.index)
    return column.map(lambda cell: float(cell) if cell else np.nan)
