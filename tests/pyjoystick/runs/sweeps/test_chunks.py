"""Distribution of the remaining runs."""

from __future__ import annotations

import numpy as np

from pyjoystick.runs.sweeps.chunks import Chunks


def _sizes(chunks: Chunks, seconds_a_run: float) -> list[int]:
    sizes = []
    while (runs := chunks.take()).size:
        sizes.append(int(runs.size))
        chunks.timed(runs.size, runs.size * seconds_a_run)
    return sizes


def test_every_run_is_handed_out_once_and_in_order() -> None:
    pending = np.array([3, 4, 9, 11, 12, 40])
    chunks = Chunks(pending, seconds=1.0, slots=1, least=2)
    taken = [chunks.take() for _ in range(5)]
    assert np.concatenate(taken).tolist() == pending.tolist()
    assert [one.size for one in taken] == [2, 2, 2, 0, 0]


def test_chunks_grow_until_they_take_the_time_they_should() -> None:
    sizes = _sizes(Chunks(np.arange(10_000), seconds=1.0, slots=1, least=2), seconds_a_run=1e-3)
    assert sizes[:5] == [2, 64, 1000, 1000, 1000]
    assert sum(sizes) == 10_000


def test_slow_runs_go_one_by_one() -> None:
    assert _sizes(Chunks(np.arange(4), seconds=1.0, slots=1), seconds_a_run=60.0) == [1, 1, 1, 1]


def test_a_slow_beginning_is_made_up_for() -> None:
    chunks = Chunks(np.arange(10_000), seconds=1.0, slots=1, least=4)
    chunks.timed(chunks.take().size, 10.0)
    assert max(_sizes(chunks, 1e-3)) == 1000


def test_the_last_chunks_are_small_where_several_work() -> None:
    sizes = _sizes(Chunks(np.arange(4_000), seconds=1.0, slots=4), seconds_a_run=1e-3)
    assert sum(sizes) == 4_000
    assert max(sizes) <= 500
    assert max(sizes[-5:]) <= 100
    assert len(sizes) < 25
