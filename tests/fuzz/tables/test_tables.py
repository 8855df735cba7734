"""A fixed number of damaged tables, and a check that wrong samples would be detected."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.fuzz.tables import trial as trials
from tests.fuzz.tables.subjects import SUBJECTS, Found, Subject
from tests.fuzz.tables.trial import trial

COUNT = 120


def test_damaged_tables_are_right_or_noted_or_refused() -> None:
    verdicts = [trial(case) for case in range(COUNT)]
    assert [one for one in verdicts if one.kind == "fault"] == []
    # Not all of them are refused.
    assert sum(one.kind == "right" for one in verdicts) > COUNT / 10


@pytest.mark.parametrize("factor", [0.0, 1.0 + 1e-9])
def test_wrong_samples_are_seen(factor: float, monkeypatch: pytest.MonkeyPatch) -> None:
    log = SUBJECTS[0]

    def read(path: Path) -> Found:
        found = log.read(path)
        return Found({**found.series, "theta": factor * found.series["theta"]}, found.notes)

    monkeypatch.setattr(trials, "SUBJECTS", (Subject(log.name, log.is_plain, log.columns, read),))
    assert "none of the table's" in trial(1).what


def test_lost_samples_are_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    log = SUBJECTS[0]

    def read(path: Path) -> Found:
        found = log.read(path)
        return Found({name: values[:-1] for name, values in found.series.items()}, found.notes)

    monkeypatch.setattr(trials, "SUBJECTS", (Subject(log.name, log.is_plain, log.columns, read),))
    assert "were not read" in trial(1).what
