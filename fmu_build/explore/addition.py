"""What another package adds to a page: modules, style and data of its own."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True, slots=True)
class Addition:
    """A folder of ES modules and CSS that a page carries beside its own, and data for them.

    The module `entry` (without ``.js``) starts the page instead of ``main.js``; it may import the page's
    modules as if they lay beside it. Every CSS file of the folder follows the page's own. `data` must be
    what JSON can hold; the modules read it as ``page.addition``.
    """

    assets: Path
    entry: str
    data: Mapping[str, Any]
