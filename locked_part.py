"""Print the part of requirements.lock that some extras need: ``python locked_part.py build openmodelica``.

It runs before anything is installed. Below each package the lock names who needs it (``# via``).
"""

from __future__ import annotations

import re
import sys
import tomllib
from pathlib import Path

_ROOT = Path(__file__).parent
# A package has a block for each version that its markers choose between.
_BLOCK = re.compile(r"^(?P<name>[A-Za-z0-9._-]+)==.*\n(?:[ ]+.*\n)*", re.MULTILINE)
_USER = re.compile(r"^ +# (?:via)? *([A-Za-z0-9._-]+)", re.MULTILINE)
# FMPy asks for CMake (87 MB) to compile foreign FMUs from their sources, which nothing here has it do.
_UNUSED = {"cmake"}


def locked_part(project: str, lock: str, extras: list[str]) -> str:
    """Return the lines of a lock that a project, its build system and its extras need, with their hashes.

    They are to be installed without asking for what they depend on, as that is among them but for the unused.
    """
    table = tomllib.loads(project)
    asked = [*table["project"]["dependencies"], *table["build-system"]["requires"]]
    for extra in extras:
        asked += table["project"]["optional-dependencies"][extra]
    needed = {_normalized(re.split(r"[^A-Za-z0-9._-]", requirement)[0]) for requirement in asked}
    blocks = [(_normalized(match["name"]), match[0]) for match in _BLOCK.finditer(lock)]
    missing = needed - {name for name, _ in blocks}
    if missing:
        raise SystemExit(f"requirements.lock lacks {', '.join(sorted(missing))}: run make lock")
    users = {
        name: {_normalized(user) for key, block in blocks if key == name for user in _USER.findall(block)}
        for name, _ in blocks
    }
    while added := {name for name, by in users.items() if name not in needed and by & needed}:
        needed |= added
    return "".join(block for name, block in blocks if name in needed - _UNUSED)


def _normalized(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()


if __name__ == "__main__":
    files = (_ROOT / name for name in ("pyproject.toml", "requirements.lock"))
    sys.stdout.write(locked_part(*(file.read_text(encoding="utf-8") for file in files), sys.argv[1:]))
