"""Rewrite models that extend a class declared inside them into a form that rumoca accepts.

rumoca rejects the names that such a base inherits as if they were variables of the enclosing model. An
encapsulated base cannot see that model, so it can be moved next to it.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from pathlib import Path

from fmu_build.codegen.modelica_source.text import Declaration, blanked, declarations

_ENCAPSULATED = re.compile(r"\bencapsulated\s+(?:partial\s+)?$")


def with_bases_beside(texts: Mapping[Path, str]) -> dict[Path, str]:
    """Return the texts of all files, with encapsulated bases moved behind the models that extend them.

    A base that is named elsewhere is not moved. All other code keeps its line number up to the end of the
    model.
    """
    return {file: _separated(text, texts.values()) for file, text in texts.items()}


def _separated(text: str, texts: Iterable[str]) -> str:
    plain = blanked(text)
    if "encapsulated" not in plain:
        return text
    found = {one.name: one for one in declarations(text)}
    for name, base in found.items():
        around, _, own = name.rpartition(".")
        prefix = _ENCAPSULATED.search(plain, 0, base.start)
        model = found.get(around)
        if prefix is None or model is None or "'" in name:
            continue
        is_extended = re.search(rf"\bextends\s+{own}\b", plain[model.start : model.end])
        if is_extended and not any(re.search(rf"\.\s*{own}\b", blanked(other)) for other in texts):
            return _separated(_moved(text, model, base, prefix.start()), texts)
    return text


def _moved(text: str, model: Declaration, base: Declaration, start: int) -> str:
    """Return the text with the base, which begins at `start`, behind the model and renamed after both."""
    own = base.name.rpartition(".")[2]
    new = f"{model.name.rpartition('.')[2]}_{own}"
    end, model_end = (text.index(";", one.end) + 1 for one in (base, model))
    lines = "\n" * text.count("\n", start, end)
    kept = text[model.start : start] + lines + text[end:model_end]
    kept = re.sub(rf"\b(extends\s+){own}\b", rf"\g<1>{new}", kept)
    name = next(re.compile(rf"\b{own}\b").finditer(blanked(text), base.start)).start()
    moved = f"{text[start:name]}{new}{text[name + len(own) : base.end - len(own)]}{new};"
    return f"{text[: model.start]}{kept} {moved}{text[model_end:]}"
