"""Tables of runs as xarray's labelled arrays, with their units."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pandas as pd

from pyjoystick.motion.tables import unit_of
from pyjoystick.support import MissingPackageError

if TYPE_CHECKING:
    import xarray


def to_xarray(table: pd.DataFrame) -> xarray.Dataset:
    """A table of a run as an xarray Dataset over ``time``, each variable with ``units`` and ``long_name``.

    Args:
        table: indexed by time, such as `make_table` makes

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
