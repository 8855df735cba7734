"""One table, as Markdown and as HTML."""

from __future__ import annotations

import pytest

from pyjoystick.support import TextTable

TABLE = TextTable(["name", "x"], [["a", "1"], ["long <name>", "22.5"]])


def test_markdown_is_aligned() -> None:
    assert TABLE.markdown().splitlines() == [
        "| name        |    x |",
        "| ----------- | ---: |",
        "| a           |    1 |",
        "| long <name> | 22.5 |",
    ]


def test_html_is_escaped_and_names_its_rows() -> None:
    text = TABLE.html("x & y")
    assert "<caption>x &amp; y</caption>" in text
    assert '<tr><th scope="row">long &lt;name&gt;</th><td class="number">22.5</td></tr>' in text
    assert "number" not in TABLE.html("caption", prose=True)
    assert '<table class="prose">' in TABLE.html("caption", prose=True)


def test_rows_are_as_wide_as_the_heading() -> None:
    uneven = TextTable(["name", "x"], [["a", "1", "2"]])
    with pytest.raises(ValueError, match="argument"):
        uneven.markdown()
    with pytest.raises(ValueError, match="argument"):
        uneven.html("caption")
