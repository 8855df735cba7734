"""The directive ``json-documents``: what the document of each command says, from its JSON schema."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from docutils import nodes
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective
from sphinx.util.typing import ExtensionMetadata

from pyjoystick.reports import schemas

#: Keys of every document, which the page explains once.
_COMMON = ("command", "notes", "made_with")


class Documents(SphinxDirective):
    """A section for each command."""

    def run(self) -> list[nodes.Node]:
        """The sections, from Markdown."""
        schema = schemas()["document.schema.json"]
        commands = schema["properties"]["command"]["enum"]
        text = "\n\n".join(
            document_text(command, one)
            for command, one in zip(commands, schema["definitions"].values(), strict=True)
        )
        return list(self.parse_text_to_nodes(text, allow_section_headings=True))


def document_text(command: str, schema: Mapping[str, Any]) -> str:
    """What a document says as Markdown, a row for each key."""
    rows = [
        f"| {_named(name, schema['required'])} | {meaning(one)} |"
        for name, one in schema["properties"].items()
        if name not in _COMMON
    ]
    return "\n".join([f"### {command}", "", "| | |", "|---|---|", *rows])


def meaning(schema: Mapping[str, Any]) -> str:
    """What a key holds: its description, and the keys of an object or of the entries of a list."""
    items = schema.get("items", {})
    is_list = any(key in items for key in ("properties", "oneOf"))
    inner = items if is_list else schema
    variants = [one for one in (*inner.get("oneOf", ()), *inner.get("anyOf", ())) if one != {"type": "null"}]
    inside = " or ".join(_keys(one) for one in variants or [inner] if "properties" in one)
    what = f"{'list of ' if is_list else ''}{inside}" if inside else ""
    return "; ".join(filter(None, (schema.get("description", ""), what)))


def _keys(schema: Mapping[str, Any]) -> str:
    parts = []
    for name, one in schema["properties"].items():
        text = meaning(one)
        spelled = _named(name, schema["required"])
        parts.append(f"{spelled} ({text})" if text else spelled)
    return ", ".join(parts)


def _named(name: str, required: Sequence[str]) -> str:
    return f"`{name}`" if name in required else f"`{name}`?"


def setup(app: Sphinx) -> ExtensionMetadata:
    """Make the directive known."""
    app.add_directive("json-documents", Documents)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
