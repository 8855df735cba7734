"""Checks every Modelica file of the project for syntax, and compiles every model of the library.

``python -m tests.lint.modelica``
"""

from __future__ import annotations

import sys
from pathlib import Path

import rumoca

from fmu_build.compilers.library import MODEL_KINDS, default_library, entry_file, read_classes

ROOT = Path(__file__).parents[2]


def main() -> int:
    """Returns the number of findings."""
    findings = [*_syntax(), *_models()]
    for finding in findings:
        print(finding, file=sys.stderr)
    return len(findings)


def _syntax() -> list[str]:
    files = sorted((ROOT / "modelica").rglob("*.mo"))
    findings = [
        f"{file.relative_to(ROOT)}:{diagnostic.line}: {diagnostic.message}"
        for file in files
        for diagnostic in rumoca.validate(file)
        if diagnostic.level in ("error", "warning")
    ]
    print(f"{len(files)} Modelica files, {len(findings)} findings")
    return findings


def _models() -> list[str]:
    library = default_library()
    findings = []
    models = [
        c for c in read_classes(library).values() if c.kind in MODEL_KINDS and not _is_partial(c.file, c.name)
    ]
    for model in models:
        try:
            rumoca.Session().load(str(entry_file(library)), model=model.name)
        except rumoca.RumocaError as error:
            findings.append(f"{model.file.relative_to(ROOT)}: {error}")
    print(f"{len(models)} models compiled, {len(findings)} findings")
    return findings


def _is_partial(file: Path, name: str) -> bool:
    return f"partial model {name.rpartition('.')[2]}" in file.read_text()


if __name__ == "__main__":
    sys.exit(main())
