"""What the site is made with, importable as its own settings import it."""

from __future__ import annotations

import sys

from tests.docs.pages import DOCS

sys.path.append(str(DOCS))
