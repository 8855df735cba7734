"""Draw every figure into this folder: ``python -m figures`` in docs/."""

from __future__ import annotations

from figures import DRAWINGS, FOLDER

for name, draw in DRAWINGS.items():
    (FOLDER / f"{name}.svg").write_text(draw().svg(), encoding="utf-8")
