"""Links, and names in code type: files of the repository, modules and their members."""

from __future__ import annotations

import importlib
import re
from collections.abc import Iterator
from itertools import islice, pairwise
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from markdown_it.token import Token

from tests.docs.pages import DOCS, NOTEBOOKS, PAGES, ROOT, tokens

_ROOT_PAGES = tuple(ROOT / f"{name}.md" for name in ("CHANGELOG", "CONTRIBUTING", "SECURITY"))
READ = (*PAGES, *_ROOT_PAGES, *NOTEBOOKS, *sorted(DOCS.glob("api/*.md")))
#: Folders whose files are in the repository, unlike those in results/ and build/.
_FOLDERS = "benchmarks|docs|fmu_build|modelica|pyjoystick|scenarios|tests"
_FILE = re.compile(rf"(?:{_FOLDERS})/[\w./-]*")
_NAME = re.compile(r"(?:pyjoystick|fmu_build)(?:\.\w+)+")


def inline(text: str) -> Iterator[Token]:
    """The pieces of the paragraphs, headings and tables of a page."""
    for token in tokens(text):
        yield from token.children or ()


def targets(text: str) -> Iterator[str]:
    """What the links and images of a page lead to."""
    for token in inline(text):
        if token.type in ("link_open", "image"):
            yield str(token.attrs["href" if token.type == "link_open" else "src"])


def anchors(text: str) -> set[str]:
    """The anchors of a page's headings, by GitHub's rule, which the site follows."""
    found = set()
    parsed = tokens(text)
    for heading, content in pairwise(parsed):
        if heading.type == "heading_open":
            words = "".join(child.content for child in content.children or ())
            found.add(re.sub(r"[^\w\- ]", "", words.lower()).replace(" ", "-"))
    return found


def check_link(target: str, page: Path) -> None:
    """Fail unless the target of a link on a page is there; addresses on the network are checked for form."""
    parts = urlsplit(target)
    if parts.scheme:
        assert parts.scheme in ("https", "http"), f"{target}: neither a file nor an address"
        assert re.fullmatch(r"[\w-]+(\.[\w-]+)+", parts.hostname or ""), f"{target}: no address"
        return
    file = (page.parent / parts.path).resolve() if parts.path else page
    assert file.exists(), f"{target}: there is no {file}"
    assert file.is_relative_to(ROOT), f"{target}: not in the repository"
    if parts.fragment:
        known = anchors(file.read_text(encoding="utf-8"))
        assert parts.fragment in known, f"{target}: headings are {', '.join(sorted(known))}"


@pytest.mark.parametrize("page", READ, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    for target in targets(page.read_text(encoding="utf-8")):
        check_link(target, page)


@pytest.mark.parametrize("page", READ, ids=lambda page: str(page.relative_to(ROOT)))
def test_figures_have_a_text(page: Path) -> None:
    for token in inline(page.read_text(encoding="utf-8")):
        if token.type == "image":
            assert len(token.content) > 30, f"{token.attrs['src']}: {token.content!r} does not describe it"


@pytest.mark.parametrize("page", READ, ids=lambda page: str(page.relative_to(ROOT)))
def test_files_and_names_exist(page: Path) -> None:
    for token in inline(page.read_text(encoding="utf-8")):
        if token.type != "code_inline":
            continue
        for word in token.content.split():
            if _FILE.fullmatch(word):
                assert (ROOT / word).exists(), word
            elif _NAME.fullmatch(word.removesuffix("()")) and not word.endswith((".csv", ".toml")):
                check_name(word.removesuffix("()"))


@pytest.mark.parametrize("page", READ, ids=lambda page: str(page.relative_to(ROOT)))
def test_no_product_is_taken_for_an_emphasis(page: Path) -> None:
    assert swallowed_products(page.read_text(encoding="utf-8")) == []


def swallowed_products(text: str) -> list[str]:
    """Words that go over into an emphasis, as ``m*g*h`` does unless it is code or escaped."""
    return [
        f"{before.content}*{inside.content}*"
        for before, mark, inside in zip(*(islice(inline(text), i, None) for i in range(3)), strict=False)
        if mark.type == "em_open" and mark.markup == "*" and re.search(r"[\w)]$", before.content)
    ]


def check_name(name: str) -> None:
    """Fail unless a dotted name is that of a module, or of something in one."""
    parts = name.split(".")
    for split in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:split]))
        except ModuleNotFoundError:
            continue
        for part in parts[split:]:
            assert hasattr(found, part), f"{name}: there is no {part}"
            found = getattr(found, part)
        return
    raise AssertionError(f"{name}: there is no such module")


TEXT = """
# The limits, and why (1)

[a](batches.md) [b](batches.md#the-compiled-loop) [c](#the-limits-and-why-1) ![d](free_oscillation.svg)

| [e](https://docs.dask.org) |
|---|
"""


def test_links_are_found() -> None:
    assert list(targets(TEXT)) == [
        "batches.md",
        "batches.md#the-compiled-loop",
        "#the-limits-and-why-1",
        "free_oscillation.svg",
        "https://docs.dask.org",
    ]
    assert anchors(TEXT) == {"the-limits-and-why-1"}


@pytest.mark.parametrize(
    "target", ["none.md", "batches.md#none", "ftp://docs.dask.org", "https://nowhere", "../../../etc/passwd"]
)
def test_links_that_lead_nowhere_fail(target: str) -> None:
    with pytest.raises(AssertionError, match=re.escape(target)):
        check_link(target, DOCS / "sweeps.md")


def test_swallowed_products_are_found() -> None:
    assert swallowed_products("J = m*g*h, `m*g*h`, m\\*g\\*h and *h*") == ["J = m*g*"]


@pytest.mark.parametrize("name", ["pyjoystick.nothing", "pyjoystick.fmu.Fmu.nothing"])
def test_names_that_are_not_there_fail(name: str) -> None:
    with pytest.raises(AssertionError, match="nothing"):
        check_name(name)
