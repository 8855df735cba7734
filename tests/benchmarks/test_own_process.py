"""The benchmark of FMUs in a separate process measures what it names."""

from __future__ import annotations

from pathlib import Path

from benchmarks import own_process


def test_four_ways(fmus_by_name: Path, tmp_path: Path) -> None:
    rows = own_process.table(tmp_path, 1, 20).splitlines()[2:]
    assert [row.split("|")[1].strip() for row in rows] == [
        "in this process",
        "in its own",
        "in its own, a new instance each",
        "in a sandbox",
    ]
