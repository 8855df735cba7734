"""Bundle ES modules into one script without Node; a page opened from a file cannot import modules.

Only these forms are supported: named imports from neighboring files, and ``export`` before a declaration at
the start of a line. Each module becomes a function that returns its exports, so that names in different
modules do not collide.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

from fmu_build.support.errors import BuildError

_IMPORT = re.compile(r'^import \{([^}]*)\} from "\./([\w-]+)\.js";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export ((?:async )?function\*?|class|const|let) (\w+)", re.MULTILINE)
_OTHER = re.compile(r"^(import|export)\b.*", re.MULTILINE)


def bundle(entry: str, folders: Sequence[Path]) -> str:
    """Return one script with the module `entry` (without ``.js``) and all modules that it imports, in order.

    The folders are searched in turn. Raises `BuildError` if a module is missing, an import is circular, or an
    import or export has an unsupported form.
    """
    done: dict[str, str] = {}
    _add(entry, folders, done, ())
    return "\n".join(done.values())


def _add(name: str, folders: Sequence[Path], done: dict[str, str], path: tuple[str, ...]) -> None:
    if name in path:
        raise BuildError(f"JavaScript modules import in a circle: {' -> '.join([*path, name])}")
    if name in done:
        return
    file = next((folder / f"{name}.js" for folder in folders if (folder / f"{name}.js").is_file()), None)
    if file is None:
        raise BuildError(f"the JavaScript module {name}.js is missing in {', '.join(map(str, folders))}")
    source = file.read_text("utf-8")
    for imported in _IMPORT.finditer(source):
        _add(imported[2], folders, done, (*path, name))
    exports = [match[2] for match in _EXPORT.finditer(source)]
    body = _IMPORT.sub(lambda match: f"const {{{match[1]}}} = ${_identifier(match[2])};\n", source)
    body = _EXPORT.sub(r"\1 \2", body)
    if other := _OTHER.search(body):
        raise BuildError(f"{file}: {other[0]!r} has a form that cannot be bundled")
    returned = f"return {{ {', '.join(exports)} }};\n" if exports else ""
    done[name] = f"const ${_identifier(name)} = (() => {{\n{body}{returned}}})();\n"


def _identifier(name: str) -> str:
    return name.replace("-", "_")
