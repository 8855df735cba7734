"""Parsing of mappings printed by rumoca's template engine."""

from __future__ import annotations

import math

import pytest

from fmu_build.codegen.lowered import read_mapping


@pytest.mark.parametrize("text", ["plain", "none", "say none, -inf", r"it\'s \u{e9}"])
def test_words_without_json_are_converted_outside_of_strings_only(text: str) -> None:
    found = read_mapping(f'{{"none": "{text}", "values": [none, undefined, -inf, inf, NaN, -nan, 1e-3]}}')
    assert found["none"] == text.replace(r"\'", "'").replace(r"\u{e9}", "é")
    assert found["values"][:4] == [None, None, -math.inf, math.inf]
    assert [math.isnan(value) for value in found["values"][4:]] == [True, True, False]
