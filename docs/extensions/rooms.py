"""The directives ``rooms``, a drawing of the import graph, and ``room``, the reference of one room's door."""

from __future__ import annotations

import inspect
import re
from collections.abc import Mapping, Sequence
from html import escape
from importlib import import_module
from types import UnionType
from typing import Any, Final, get_origin

from docutils import nodes
from sphinx.addnodes import pending_xref
from sphinx.application import Sphinx
from sphinx.environment import BuildEnvironment
from sphinx.pycode import ModuleAnalyzer
from sphinx.util.docutils import SphinxDirective
from sphinx.util.typing import ExtensionMetadata

from extensions.docstrings import escaped
from extensions.imports import PACKAGES, arrows, door, modules, rooms

# Lengths in pixels; two boxes and their margins fit the narrowest phone.
_BOX: Final = (132.0, 30.0)
_GAP: Final = (24.0, 34.0)
_MARGIN: Final = 6.0
_HEAD: Final = (
    '<svg width="0" height="0" aria-hidden="true"><marker id="arrow-head" viewBox="0 0 8 8" refX="7" '
    'refY="4" markerWidth="8" markerHeight="8" markerUnits="userSpaceOnUse" orient="auto">'
    '<path d="M0,0 L8,4 L0,8 Z"/></marker></svg>'
)


class Rooms(SphinxDirective):
    """The rooms of each package and what they import, as SVG in the colors of the page."""

    def run(self) -> list[nodes.Node]:
        """One figure a package, side by side where there is room."""
        figures = "".join(
            f"<figure>{drawing(package, arrows(package))}"
            f"<figcaption><code>{package}</code></figcaption></figure>"
            for package in PACKAGES
        )
        return [nodes.raw(text=f'<div class="rooms">{_HEAD}{figures}</div>', format="html")]


def drawing(package: str, graph: Mapping[str, set[str]]) -> str:
    """A layered drawing of rooms: each below what it imports, arrows that follow from others left out."""
    rows = layers(graph)
    widest = max(map(len, rows))
    width = widest * _BOX[0] + (widest - 1) * _GAP[0] + 2 * _MARGIN
    height = len(rows) * _BOX[1] + (len(rows) - 1) * _GAP[1] + 2 * _MARGIN
    centers = {
        room: (
            width / 2 + (column - (len(row) - 1) / 2) * (_BOX[0] + _GAP[0]),
            _MARGIN + _BOX[1] / 2 + level * (_BOX[1] + _GAP[1]),
        )
        for level, row in enumerate(rows)
        for column, room in enumerate(row)
    }
    shown = direct(graph)
    said = "; ".join(f"{room} imports {', '.join(sorted(shown[room]))}" for room in centers if shown[room])
    shapes = [_arrow(centers[room], centers[target]) for room in centers for target in sorted(shown[room])]
    shapes += [_box(room, centers[room]) for room in centers]
    return (
        f'<svg viewBox="0 0 {width:g} {height:g}" width="{width:g}" role="img" '
        f'aria-label="{escape(f"Rooms of {package}: {said}")}">{"".join(shapes)}</svg>'
    )


def layers(graph: Mapping[str, set[str]]) -> list[list[str]]:
    """Rooms by the longest way to one that imports nothing, those of a row beside what they import."""
    inner = {room: targets & set(graph) for room, targets in graph.items()}
    level: dict[str, int] = {}
    while len(level) < len(inner):
        ready = [room for room in sorted(inner) if room not in level and inner[room] <= set(level)]
        if not ready:
            raise ValueError(f"a circle of imports among {', '.join(sorted(set(inner) - set(level)))}")
        level |= {room: 1 + max((level[target] for target in inner[room]), default=-1) for room in ready}
    rows = [[room for room in inner if level[room] == n] for n in range(1 + max(level.values()))]
    shown = direct(graph)
    place: dict[str, float] = {}
    for row in rows:
        row.sort(key=lambda room: (_mean([place[target] for target in shown[room]]), room))
        place |= {room: column - (len(row) - 1) / 2 for column, room in enumerate(row)}
    return rows


def direct(graph: Mapping[str, set[str]]) -> dict[str, set[str]]:
    """The imports that do not follow from others: the transitive reduction of a graph without circles."""

    def reached(room: str) -> set[str]:
        targets = graph[room] & set(graph)
        return targets.union(*map(reached, targets))

    return {
        room: {
            target
            for target in targets & set(graph)
            if not any(target in reached(other) for other in targets & set(graph))
        }
        for room, targets in graph.items()
    }


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values) if values else 0.0


def _box(room: str, center: tuple[float, float]) -> str:
    x, y = center
    return (
        f'<rect x="{x - _BOX[0] / 2:g}" y="{y - _BOX[1] / 2:g}" width="{_BOX[0]:g}" height="{_BOX[1]:g}" '
        f'rx="5"/><text x="{x:g}" y="{y + 4.5:g}">{escape(room)}</text>'
    )


def _arrow(start: tuple[float, float], end: tuple[float, float]) -> str:
    """From the top of a box to the bottom of one above it, the head on the latter."""
    # A slanted arrow leaves and arrives off the middle, towards the other box.
    shift = max(-1.0, min(1.0, (end[0] - start[0]) / _BOX[0])) * _BOX[0] / 5
    x0, y0, x1, y1 = start[0] + shift, start[1] - _BOX[1] / 2, end[0] - shift, end[1] + _BOX[1] / 2
    return f'<line x1="{x0:g}" y1="{y0:g}" x2="{x1:g}" y2="{y1 + 1:g}" marker-end="url(#arrow-head)"/>'


class Room(SphinxDirective):
    """The names of a room's door, in sections.

    The argument is the room. A line of the content is

    - ``part: Title``, a section: the names of the door that this module or folder of the room defines;
      ``folder.part`` for a part of a folder
    - ``part``, more names for the section above
    - ``Class``, which the door does not list but its functions return

    Parts that the page does not list come last, under their own names.
    """

    required_arguments = 1
    has_content = True

    def run(self) -> list[nodes.Node]:
        """The room's docstring and the sections."""
        package = self.arguments[0]
        left = {name: f"{home.removeprefix(f'{package}.')}." for name, home in door(package).items()}
        sections: dict[str, list[str]] = {}
        for line in self.content:
            part, _, title = (word.strip() for word in line.partition(":"))
            entries = sections.setdefault(title, []) if title else next(reversed(sections.values()))
            if names := [name for name, home in left.items() if home.startswith(f"{part}.")]:
                entries += [_entry(package, name, f"{package}.{left.pop(name)[:-1]}") for name in names]
            elif module := _home_of_class(package, part):
                entries.append(f".. autoclass:: {module}.{part}\n   :members:")
            else:
                raise self.error(f"{package} has no class {part!r}, and its door lists nothing from there")
        for name, home in left.items():
            title = home.split(".")[0].replace("_", " ").capitalize()
            sections.setdefault(title, []).append(_entry(package, name, f"{package}.{home[:-1]}"))
        text = self._parsed(f".. automodule:: {package}")
        return [*text, *(self._section(title, entries) for title, entries in sections.items())]

    def _section(self, title: str, entries: Sequence[str]) -> nodes.section:
        section = nodes.section(ids=[nodes.make_id(title)], names=[nodes.fully_normalize_name(title)])
        section += nodes.title(text=title)
        section.extend(self._parsed("\n\n".join(entries)))
        return section

    def _parsed(self, text: str) -> list[nodes.Node]:
        return list(self.parse_text_to_nodes(f"```{{eval-rst}}\n{text}\n```"))


def _home_of_class(package: str, name: str) -> str | None:
    """The module of a room that defines a class."""
    line = re.compile(rf"^class {re.escape(name)}\b", re.MULTILINE)
    inner = (module for module in modules() if module.startswith(f"{package}."))
    return next((one for one in inner if line.search(modules()[one].read_text(encoding="utf-8"))), None)


def _entry(package: str, name: str, home: str) -> str:
    """What a door lists, as Sphinx documents its kind."""
    found = getattr(import_module(package), name)
    if inspect.isclass(found):
        kind = "exception" if issubclass(found, BaseException) else "class"
        return f".. auto{kind}:: {package}.{name}\n   :members:"
    if inspect.isroutine(found):
        return f".. autofunction:: {package}.{name}"
    is_type = get_origin(found) or isinstance(found, UnionType)
    kind = "type" if is_type else "data"
    value = f"   :value: {found!r}\n" if isinstance(found, int | float | str) else ""
    # autodoc looks for the comment at the door; it stands where the name is defined.
    source = ModuleAnalyzer.for_module(home)
    source.analyze()
    comment = [escaped(line) for line in source.attr_docs.get(("", name), [])]
    if is_type:
        short = re.sub(r"(?:\w+\.)+(\w+)", r"\1", str(found))
        comment = [f"``{short}``", "", *comment]
    body = "\n".join(f"   {line}" for line in comment)
    return f".. py:{kind}:: {name}\n   :module: {package}\n{value}\n{body}"


def _at_the_door(
    app: Sphinx, env: BuildEnvironment, node: pending_xref, content: nodes.TextElement
) -> nodes.Element | None:
    """Have a reference to where a name is defined lead to the door that lists it."""
    target = node.get("reftarget", "")
    found = _homes().get(target)
    if node.get("refdomain") != "py" or found is None:
        return None
    domain: Any = env.get_domain("py")
    return domain.resolve_xref(env, node["refdoc"], app.builder, node["reftype"], found, node, content)


def _homes() -> dict[str, str]:
    """By where a name is defined, its name at the door."""
    return {
        f"{home}.{name}": f"pyjoystick.{room}.{name}"
        for room in rooms("pyjoystick")
        for name, home in door(f"pyjoystick.{room}").items()
    }


def setup(app: Sphinx) -> ExtensionMetadata:
    """Make the directives known."""
    app.add_directive("rooms", Rooms)
    app.add_directive("room", Room)
    app.connect("missing-reference", _at_the_door)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
