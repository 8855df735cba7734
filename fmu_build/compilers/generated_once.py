"""A cache, in the user's cache folder, of generated models.

The C code of a model depends on neither the FMI version nor the platform. Generating it takes a third of the
time of a build, and most of it for a model that uses the Modelica Standard Library.
"""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Callable, Mapping
from functools import cache
from importlib import metadata
from pathlib import Path

from fmu_build.support.cache import Store
from fmu_build.support.description import GeneratedModel
from fmu_build.support.request import SensitivityRequest

_STORE = Store("models", most=256)


def generated_once(
    texts: Mapping[Path, str],
    model: str,
    sensitivity: SensitivityRequest | None,
    make: Callable[[], tuple[GeneratedModel, str]],
    on_stage: Callable[[str], None],
) -> tuple[GeneratedModel, str]:
    """Return the result of `make` for a model with these source texts, from the cache if it is there.

    A model whose log names a file is not cached, because the same texts may be in other files later.
    """
    sources = sorted((file.parts[-2:], text) for file, text in texts.items())
    made_from = [_generator(), model, sensitivity, sources]
    key = hashlib.sha256(repr(made_from).encode()).hexdigest()
    if (kept := _STORE.read(key)) is not None:
        on_stage("taking the C code from the cache")
        found: tuple[GeneratedModel, str] = pickle.loads(kept)
        return found
    generated, log = make()
    if not any(str(file) in log for file in texts):
        _STORE.write(key, pickle.dumps((generated, log)))
    return generated, log


@cache
def _generator() -> tuple[str, str]:
    """The versions of compiler and code generator, the latter as a digest of this package's files."""
    package = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for file in sorted(package.rglob("*")):
        if file.suffix in (".py", ".jinja", ".toml", ".mo"):
            digest.update(f"{file.relative_to(package)}\0".encode() + file.read_bytes())
    return metadata.version("rumoca"), digest.hexdigest()
