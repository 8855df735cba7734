"""What another release of rumoca changes: its intermediate forms, and the tests that fail with it.

``make try-rumoca`` tries the newest release, ``make try-rumoca RUMOCA=0.10.1`` another. The code generator
depends on these forms and on little else of rumoca; the list of changes says where to look.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import rumoca

from fmu_build.codegen.lowered import TARGET, read_mapping

_ROOT = Path(__file__).parents[1]
_MODELS = _ROOT / "tests" / "fmu_build" / "models"
_TESTS = ("tests/fmu_build/codegen", "tests/fmu_build/models", "tests/modelica")
#: Parts of the forms that are not read here: other ways to write the same equations, and derivatives of them.
_UNREAD = ("artifacts", "scalar_plan", "residual")
#: Mappings by the names of variables and the like.
_BY_NAME = (
    *("bindings", "name_to_idx", "variables", "functions", "variable_type_names", "instance_relations"),
    *("record_instances", "enum_literal_ordinals", "effective_types", "type_ids_by_def_id"),
    *("variable_final_flags", "component_class_types"),
)


def main() -> int:
    """Print what differs with the release that is the argument; return the result of its tests."""
    with tempfile.TemporaryDirectory() as folder:
        wanted = f"rumoca{''.join(f'=={version}' for version in sys.argv[1:2])}"
        install = (sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--target", folder, wanted)
        subprocess.run(install, check=True)
        other = {**os.environ, "PYTHONPATH": folder}
        pinned, tried = (_forms_of(environment) for environment in (dict(os.environ), other))
        print(f"rumoca {pinned.pop(0)} is pinned, {tried.pop(0)} is tried")
        for sign, lines in (("-", set(pinned) - set(tried)), ("+", set(tried) - set(pinned))):
            for line in sorted(lines):
                print(sign, line)
        command = (sys.executable, "-m", "pytest", "--numprocesses", "2", *_TESTS)
        return subprocess.run(command, cwd=_ROOT, env=other, check=False).returncode


def _forms_of(environment: dict[str, str]) -> list[str]:
    """The version, and every form that the models of the tests have, with the rumoca of an environment."""
    program = "from tests.rumoca_release import print_forms; print_forms()"
    command = (sys.executable, "-c", program)
    result = subprocess.run(
        command, cwd=_ROOT, env=environment, check=True, stdout=subprocess.PIPE, text=True
    )
    return result.stdout.splitlines()


def print_forms() -> None:
    """Print the installed version, then the forms, a line each."""
    found: set[str] = set()
    for file in sorted(_MODELS.glob("*.mo")):
        for name in re.findall(r"^  model (\w+)", file.read_text(), re.M):
            try:
                model = rumoca.Session().load(str(file), model=f"{file.stem}.{name}")
                stages = read_mapping(model.codegen(str(TARGET)).files[0].content)
            except (rumoca.RumocaError, RuntimeError):
                continue  # parts of other models
            found.update(_forms(stages, ""), _forms(model.to_dict("flat"), "flat"))
    print(rumoca.version(), *sorted(found), sep="\n")


def _forms(value: Any, path: str) -> Iterator[str]:
    match value:
        case dict():
            for key, inner in value.items():
                if path.endswith(_BY_NAME):
                    yield from _forms(inner, f"{path}.*")
                elif len(value) == 1 and key[:1].isupper():
                    # An operation or a kind of node, which is the same wherever it stands.
                    yield from _forms(inner, f"{path.split('.')[0].split(' ')[0]} {key}")
                elif key not in _UNREAD:
                    yield from _forms(inner, f"{path}.{key}".lstrip("."))
        case list():
            for inner in value:
                yield from _forms(inner, f"{path}[]")
        case str() if path.endswith((".op", ".kind")):
            yield f"{path} = {value}"
        case _:
            yield f"{path}: {type(value).__name__}"


if __name__ == "__main__":
    sys.exit(main())
