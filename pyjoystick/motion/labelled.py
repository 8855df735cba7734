"""Conversion of tables of runs to xarray, with units."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pandas as pd

from pyjoystick.motion.tables import unit_of
from pyjoystick.support import MissingPackageError

if TYPE_CHECKING:
    import xarray


def to_xarray(table: pd.DataFrame) -> xarray.Dataset:
    """Convert the table of a run to an xarray Dataset over ``time``, with ``units`` and ``long_name``.

    Args:
        table: indexed by time, such as from `make_table`

    Raises:
        MissingPackageError: xarray is not installed
    """
    try:
        found: xarray.Dataset = table.to_xarray()
    except ImportError as error:
        raise MissingPackageError("xarray's datasets", "xarray") from error
    descriptions: dict[str, Any] = table.attrs.get("descriptions", {})
    for name in found.variables:
        text = str(name)
        known = {"units": unit_of(table, text), "long_name": descriptions.get(text, "")}
        found[name].attrs |= {key: value for key, value in known.items() if value}
    return found
