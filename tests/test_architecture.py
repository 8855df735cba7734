"""The import graph matches docs/architecture.md, uses the doors of rooms, and has no cycles."""

from __future__ import annotations

import re
from graphlib import TopologicalSorter

import pytest
from extensions.imports import PACKAGES, ROOT, imports, module_of, modules, room_of, rooms

ARCHITECTURE = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
#: What may use every room: the command line and the package's own face.
ENTRANCES = {"__init__", "__main__", "cli"}


def _table() -> dict[tuple[str, str], set[str]]:
    """The table of arrows: by package and room, the rooms that it may import."""
    rows = re.findall(r"^\| `(\w+)/(\w+)` \|[^|]*\|([^|]*)\|$", ARCHITECTURE, re.MULTILINE)
    return {(package, room): set(re.findall(r"`(\w+)`", arrows)) for package, room, arrows in rows}


def test_the_table_is_short_and_names_every_room() -> None:
    found = {(package, room) for package in PACKAGES for room in rooms(package)}
    assert set(_table()) == found
    assert len(found) <= 15
    assert len([path for path in (ROOT / "pyjoystick").iterdir() if path.name != "__pycache__"]) <= 14


@pytest.mark.parametrize("package", PACKAGES)
def test_imports_follow_the_table(package: str) -> None:
    table = _table()
    unexpected = []
    for module, path in modules().items():
        if not module.startswith(f"{package}.") or room_of(module) in ENTRANCES:
            continue
        allowed = {room_of(module), *table[package, room_of(module)]}
        for named, _ in imports(path):
            target = room_of(named) if named.startswith(package) else named.split(".")[0]
            if target not in allowed:
                unexpected.append(f"{module} imports {named}")
    assert not unexpected


def test_rooms_stand_above_what_they_lean_on() -> None:
    for package in PACKAGES:
        order = [room for owner, room in _table() if owner == package]
        for (owner, room), arrows in _table().items():
            if owner == package and room not in ENTRANCES:
                assert arrows - {"fmu_build"} <= set(order[: order.index(room)]), (
                    f"{room} leans on what stands above it"
                )


def test_rooms_are_entered_by_their_doors() -> None:
    inside = [
        f"{module} imports {named}"
        for module, path in modules().items()
        for named, _ in imports(path)
        if module.startswith("pyjoystick.")
        and named.startswith("pyjoystick.")
        and room_of(module) != room_of(named)
        and named.count(".") > 1
    ]
    assert not inside


def test_there_are_no_cycles() -> None:
    graph = {
        name: {module_of(home) or home for _, home in imports(path)} - {name}
        for name, path in modules().items()
    }
    list(TopologicalSorter(graph).static_order())


def test_storeys_of_the_fit_lean_on_those_above() -> None:
    inside = "pyjoystick.identification."
    order = re.findall(r"^\| `(fitting[.\w]*)` \|", ARCHITECTURE, re.MULTILINE)
    assert len(order) == 4

    def storey(module: str) -> int:
        name = module.removeprefix(inside)
        return next(i for i, one in enumerate(order) if name.startswith(f"{one}."))

    climbing = [
        f"{module} imports {named}"
        for module, path in modules().items()
        for named, _ in imports(path)
        if all(one.startswith(f"{inside}fitting.") for one in (module, named))
        and storey(module) < storey(f"{named}.")
    ]
    assert not climbing
