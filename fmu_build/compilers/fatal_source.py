"""Source with which rumoca crashes, or writes output that cannot be read."""

from __future__ import annotations

import re
from collections.abc import Container, Mapping
from pathlib import Path

from fmu_build.codegen.modelica_source.places import place_at
from fmu_build.codegen.modelica_source.text import REDECLARE, blanked, declarations
from fmu_build.support.errors import UnsupportedModelError

_EXTENDED = rf"{REDECLARE}(?:model|block|record|connector|class|type|function)\s+(?=extends\b)"
_NAME_WITH_QUOTES = r"'(?:[^'\\\n]|\\.)*\"(?:[^'\\\n]|\\.)*'"
_FATAL = re.compile(f"(?P<extended>{_EXTENDED})|(?P<name>{_NAME_WITH_QUOTES})")


def reject_fatal(texts: Mapping[Path, str], reached: Container[str]) -> None:
    """Raise `UnsupportedModelError` for the first such construct in a class that the model can reach.

    These are classes of models, not of packages, that are redeclared by extending them, and names with
    quotation marks.
    """
    for file, text in texts.items():
        for found in _FATAL.finditer(blanked(text)):
            around = [one for one in declarations(text) if one.start <= found.start() < one.end]
            inside = max(around, key=lambda one: one.start, default=None)
            if inside is None or inside.name not in reached:
                continue
            if found["name"]:
                what = f"the name {found[0]} has a quotation mark, which is not supported"
            elif inside.kind.endswith("package"):
                continue
            else:
                what = (
                    "redeclare ... extends in a model is not supported; give the new class a name of its own"
                )
            raise UnsupportedModelError(f"{place_at(file, text, found.start())}: {what}")
