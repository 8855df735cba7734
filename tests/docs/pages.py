"""The pages of the documentation and the blocks of code in them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
#: What is read on its own; notebooks are run by the build of the site.
PAGES = (ROOT / "README.md", *sorted(DOCS.glob("*.md")))
NOTEBOOKS = tuple(sorted(DOCS.glob("notebooks/*.md")))

_MARK = re.compile(r"<!-- not run: (?P<reason>.+?) -->", re.DOTALL)


@dataclass(frozen=True)
class Block:
    """A block of code.

    `language` is empty for indented blocks, which hold command lines. `not_run` is the reason why it is only
    read, empty where it is run: what the comment ``<!-- not run: REASON -->`` before it says.
    """

    language: str
    text: str
    line: int
    not_run: str


def tokens(text: str) -> list[Token]:
    """A page as Markdown's tokens; front matter is left out, lines keep their numbers."""
    front = re.match(r"---\n.*?\n---\n", text, re.DOTALL)
    body = "\n" * front.group().count("\n") + text[front.end() :] if front else text
    return MarkdownIt("commonmark").enable("table").parse(body)


def blocks(text: str) -> Iterator[Block]:
    """The blocks of a page in their order; directives of the site, ``{toctree}`` and the like, are none."""
    before = ""
    for token in tokens(text):
        if token.type in ("fence", "code_block") and not token.info.startswith("{"):
            mark = _MARK.fullmatch(before.strip())
            line = token.map[0] + 1 if token.map else 0
            language = token.info.strip() if token.type == "fence" else ""
            if token.type == "fence" and not language:
                raise ValueError(f"line {line}: a block without a language")
            yield Block(language, token.content, line, " ".join(mark["reason"].split()) if mark else "")
        before = token.content if token.type == "html_block" else ""
