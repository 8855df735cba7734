"""Extensions of a page by another package: modules, style and data."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any


@dataclass(frozen=True, slots=True)
class Addition:
    """A folder of ES modules and CSS files to include in a page, and data for them.

    The module `entry` (without ``.js``) starts the page instead of ``main.js``; it may import the page's
    modules as if they were in the same folder. The CSS files come after the page's own. `data` must be
    serializable as JSON; modules read it as ``page.addition``.
    """

    assets: Path
    entry: str
    data: Mapping[str, Any]
