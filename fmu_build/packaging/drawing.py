"""How pictures come out alike wherever they are drawn."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import matplotlib as mpl


@contextmanager
def own_settings(settings: Mapping[Any, Any]) -> Iterator[None]:
    """Matplotlib as it comes, but for these settings: not as this user or this program has set it."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(settings)
        yield
