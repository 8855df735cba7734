"""Parse a page: closed tags, images, links, tables."""

from __future__ import annotations

import base64
from dataclasses import dataclass, field
from html.parser import HTMLParser

_VOID = {"meta", "img"}


@dataclass
class ReadPage(HTMLParser):
    """What is on a page; every tag must be closed in its turn."""

    images: list[dict[str, str]] = field(default_factory=list)
    targets: set[str] = field(default_factory=set)
    links: list[str] = field(default_factory=list)
    outside: list[str] = field(default_factory=list)
    headings: list[str] = field(default_factory=list)
    cells: list[str] = field(default_factory=list)
    language: str = ""

    def __post_init__(self) -> None:
        super().__init__()
        self._open: list[str] = []

    def __hash__(self) -> int:
        return id(self)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        found = {name: value or "" for name, value in attrs}
        self.language = found.get("lang", self.language)
        if tag not in _VOID:
            self._open.append(tag)
        if "id" in found:
            self.targets.add(found["id"])
        if tag == "img":
            self.images.append(found)
        if tag == "a":
            self.links.append(found["href"])
        if tag in ("script", "link", "iframe", "object"):
            self.outside.append(tag)
        self.outside += [
            found[name] for name in ("src", "srcset") if name in found and found[name][:5] != "data:"
        ]

    def handle_endtag(self, tag: str) -> None:
        assert self._open, f"</{tag}> closes nothing"
        assert self._open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self._open and self._open[-1] in ("h1", "h2"):
            self.headings.append(data)
        if self._open and self._open[-1] in ("td", "th"):
            self.cells.append(data)

    def close(self) -> None:
        super().close()
        assert self._open == []


def read_page(text: str) -> ReadPage:
    """The page of a text; fails where a tag is not closed."""
    page = ReadPage()
    page.feed(text)
    page.close()
    return page


def drawing(image: dict[str, str]) -> str:
    """The SVG of an image inside a page."""
    kind, _, data = image["src"].partition(",")
    assert kind == "data:image/svg+xml;base64"
    return base64.b64decode(data).decode("utf-8")
