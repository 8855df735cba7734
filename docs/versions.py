"""Put a built site beside those of other versions: ``python docs/versions.py build/docs SITE VERSION``.

SITE is what is published: a folder for each version, ``versions.json``, which lists them for the menu in the
pages, and a first page that leads to the newest release. Built with ``SITE_VERSION=VERSION make docs``, the
pages have that menu.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
from pathlib import Path

#: The version of the main branch.
DEVELOPMENT = "dev"
_VERSION = re.compile(rf"{DEVELOPMENT}|\d+(?:\.\d+)*")
_FIRST_PAGE = """<!doctype html>
<meta charset="utf-8">
<title>pyjoystick</title>
<meta http-equiv="refresh" content="0; url={version}/">
<a href="{version}/">pyjoystick {version}</a>
"""


def add(built: Path, site: Path, version: str) -> list[str]:
    """Replace `version` in the folder `site` by the one in `built`; return all versions, the newest first.

    Raises ValueError for a version that is neither numbers with dots nor ``dev``, and FileNotFoundError if
    `built` holds no site.
    """
    if not _VERSION.fullmatch(version):
        raise ValueError(f"the version must be {DEVELOPMENT} or numbers with dots, not {version!r}")
    if not (built / "index.html").is_file():
        raise FileNotFoundError(f"{built} holds no site: make docs")
    if (site / version).is_dir():
        shutil.rmtree(site / version)
    shutil.copytree(built, site / version, ignore=shutil.ignore_patterns(".buildinfo", ".doctrees"))
    names = sorted(
        (path.name for path in site.iterdir() if path.is_dir() and _VERSION.fullmatch(path.name)),
        key=_age,
        reverse=True,
    )
    newest = next((name for name in names if name != DEVELOPMENT), DEVELOPMENT)
    (site / "versions.json").write_text(json.dumps(names), encoding="utf-8")
    (site / "index.html").write_text(_FIRST_PAGE.format(version=newest), encoding="utf-8")
    return names


def _age(name: str) -> tuple[float, ...]:
    """Return what grows with the version; the main branch is ahead of all releases."""
    return (float("inf"),) if name == DEVELOPMENT else tuple(float(part) for part in name.split("."))


def main() -> None:
    """Read the command line."""
    parser = argparse.ArgumentParser(description="Put a built site beside those of other versions.")
    parser.add_argument("built", type=Path, help="folder of the built site, such as build/docs")
    parser.add_argument("site", type=Path, help="folder that is published")
    parser.add_argument("version", help=f"{DEVELOPMENT}, or that of a release, such as 0.1.0")
    options = parser.parse_args()
    try:
        print(*add(options.built, options.site, options.version))
    except (ValueError, FileNotFoundError) as error:
        parser.error(str(error))


if __name__ == "__main__":
    main()
