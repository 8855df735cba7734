"""Messages that begin with a position, or with the model's file if the position is uncertain."""

from __future__ import annotations

from fmu_build.codegen.modelica_source.places import Place, located, place_at

_PLACES = [Place("Lib/M.mo", line, 3) for line in range(1, 9)]


def test_lines_and_columns_begin_at_one() -> None:
    assert place_at("M.mo", "ab\nµd", 0) == Place("M.mo", 1, 1)
    assert place_at("M.mo", "ab\nµd", 4) == Place("M.mo", 2, 2)


def test_one_place_leads() -> None:
    assert located("wrong", _PLACES[:1] * 2, "Lib.M", "Lib/M.mo") == "Lib/M.mo:1:3: wrong"


def test_several_places_are_candidates() -> None:
    message = located("wrong", _PLACES[:2], "Lib.M", "Lib/M.mo")
    assert message == "Lib/M.mo: wrong (model Lib.M; see Lib/M.mo:1:3, Lib/M.mo:2:3)"


def test_no_place_or_too_many() -> None:
    assert located("wrong", [], "Lib.M", "Lib/M.mo") == "Lib/M.mo: wrong (model Lib.M)"
    assert located("wrong", _PLACES, "Lib.M", "Lib/M.mo") == "Lib/M.mo: wrong (model Lib.M)"
