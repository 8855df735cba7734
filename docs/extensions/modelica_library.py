"""The classes of the Modelica library as their files tell of them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

_STRING = r'"((?:[^"\\]|\\.)*)"'
_HEADER = re.compile(
    rf"^((?:partial )?(?:package|model|block|connector|type|class)) (\w+)[^\"]*{_STRING}", re.M
)
_INFO = re.compile(rf"Documentation\(info\s*=\s*{_STRING}")
_PARAMETER = re.compile(
    rf"^\s*parameter\s+([\w.]+)\s+(\w+(?:\[[^]]*\])?)(?:\([^;]*?\))?(?:\s*=\s*([^\"]+?))?\s*{_STRING}", re.M
)


@dataclass(frozen=True)
class Parameter:
    """A parameter that a class declares: the last part of its type's name, its default as it is written."""

    name: str
    kind: str
    default: str
    description: str


@dataclass(frozen=True)
class ModelicaClass:
    """One .mo file. `documentation` is HTML with links of the scheme ``modelica:``."""

    name: str
    kind: str
    description: str
    documentation: str
    parameters: tuple[Parameter, ...]


def read_packages(folder: Path) -> Iterator[list[ModelicaClass]]:
    """A package, then those inside it: each as itself and its classes, in the order of ``package.order``.

    Raises:
        ValueError: a file does not look as the library's do
    """
    names = (folder / "package.order").read_text(encoding="utf-8").split()
    files = [folder / "package.mo", *(folder / f"{name}.mo" for name in names)]
    yield [_read(file) for file in files if file.is_file()]
    for name in names:
        if (folder / name).is_dir():
            yield from read_packages(folder / name)


def _read(file: Path) -> ModelicaClass:
    text = file.read_text(encoding="utf-8")
    within = re.match(r"within ([\w.]+);", text)
    header, info = _HEADER.search(text), _INFO.search(text)
    if not header or not info:
        raise ValueError(f"{file}: no header with a description, or no documentation")
    kind, name, description = header.groups()
    return ModelicaClass(
        name=f"{within[1]}.{name}" if within else name,
        kind=kind,
        description=_unescaped(description),
        documentation=_unescaped(re.sub(r"\s*</?html>\s*", "", info[1])),
        parameters=tuple(
            Parameter(found[2], found[1].split(".")[-1], (found[3] or "").strip(), _unescaped(found[4]))
            for found in _PARAMETER.finditer(text)
        ),
    )


def _unescaped(text: str) -> str:
    return re.sub(r"\\(.)", r"\1", text)
