"""Execution of sweeps: runs are saved as they finish and resumed after an interruption."""

from __future__ import annotations

import logging
import os
import time
from collections.abc import Callable, Generator
from contextlib import closing
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Final

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from pyjoystick.runs.errors import ChangedSweepError, SweepFileError
from pyjoystick.runs.sweeps.chunks import Chunks
from pyjoystick.runs.sweeps.files import check_target, read_sweep, write_sweep
from pyjoystick.runs.sweeps.parts import Parts, require_same
from pyjoystick.runs.sweeps.sweep import Part, Sweep, part_of

_LOG = logging.getLogger(__name__)

#: Target duration of a chunk (s); at most this much work is lost when the process is killed.
_CHUNK: Final = 2.0


#: Called with the number of finished runs, including those of an earlier session.
OnProgress = Callable[[int], None]


@dataclass(frozen=True, slots=True, eq=False)
class Outcome:
    """Progress or result of a sweep.

    Attributes:
        path: file of the results; written unless `interrupted`
        table: the results, see `read_sweep`; None if `interrupted`
        done: number of finished runs, including failed ones
        failed: number of failed runs
        messages: messages of failed runs, by run number
        interrupted: stopped by Ctrl-C; the same call continues from there
        found: number of runs that were finished before this call
    """

    path: Path
    table: pd.DataFrame | None
    done: int
    failed: int
    messages: dict[int, str]
    interrupted: bool
    found: int


def run_sweep(
    sweep: Sweep,
    target: str | PathLike[str],
    *,
    threads: int | None = None,
    scheduler: str | None = None,
    overwrite: bool = False,
    on_progress: OnProgress = lambda _: None,
    on_note: Callable[[str], None] = lambda _: None,
) -> Outcome:
    """Execute a sweep, or the rest of it, and write its file.

    Finished runs are saved in the folder ``TARGET.parts`` until the file is written. The results do not
    depend on where the sweep ran, nor on where and how often it was interrupted.

    Args:
        sweep: the sweep
        target: the file, .parquet or .csv
        threads: number of threads on this machine; by default all cores
        scheduler: address of a Dask scheduler (``tcp://...``) whose workers do the runs instead
        overwrite: discard saved progress and results, and start over
        on_progress: called with the number of finished runs
        on_note: called with any other message

    Raises:
        OutputFileError, SweepFileError: a file cannot be written or read
        ChangedSweepError: existing progress or results belong to other settings or another FMU
        MissingPackageError: Parquet without pyarrow, or a scheduler without distributed
        ClusterError: the cluster cannot be used or was lost; finished runs are saved
        FmuFileError, UnsupportedFmuError, ParameterError: the FMU cannot run with these settings
    """
    target = Path(target)
    check_target(target)
    parts = Parts(target)
    if not overwrite and (finished := _finished(sweep, parts)) is not None:
        parts.remove(sweep.identity)
        return _outcome(target, finished, found=len(finished))
    with parts.opened(sweep.identity, anew=overwrite):
        whole, done = parts.whole(len(sweep.design), len(sweep.columns))
        found = int(done.sum())
        _LOG.info("%d of %d runs are kept from before, in %s", found, len(sweep.design), parts.folder)
        on_progress(found)
        interrupted = _carry_out(
            sweep,
            parts,
            np.flatnonzero(~done),
            threads,
            scheduler,
            lambda count: on_progress(found + count),
            on_note,
        )
        whole, done = parts.whole(len(sweep.design), len(sweep.columns))
        if not done.all():
            return _unfinished(target, whole, int(done.sum()), found, interrupted)
        table = sweep.table(whole)
        write_sweep(target, table)
    parts.remove(sweep.identity)
    return _outcome(target, table, found)


def _carry_out(
    sweep: Sweep,
    parts: Parts,
    pending: NDArray[np.int64],
    threads: int | None,
    scheduler: str | None,
    on_progress: OnProgress,
    on_note: Callable[[str], None],
) -> bool:
    """Execute the pending runs and save them; returns whether Ctrl-C stopped it."""
    if scheduler is None:
        finished = run_locally(sweep, pending, threads, on_progress)
    else:
        from pyjoystick.runs.sweeps.cluster import run_on_cluster

        finished = run_on_cluster(sweep, pending, scheduler, on_progress, on_note)
    try:
        with closing(finished):
            for part in finished:
                parts.save(part)
    except KeyboardInterrupt:
        return True
    return False


def _finished(sweep: Sweep, parts: Parts) -> pd.DataFrame | None:
    """Existing results of this sweep, or None.

    Results of another sweep are an error unless there are parts, which mean that overwriting was requested.
    """
    if not parts.target.exists():
        return None
    table = read_sweep(parts.target)
    try:
        require_same(parts.target, table.attrs["sweep"], sweep.identity)
        _require_whole(sweep, parts.target, table)
    except ChangedSweepError:
        if parts.begun:
            return None
        raise
    return table


def _require_whole(sweep: Sweep, path: Path, table: pd.DataFrame) -> None:
    """Raise SweepFileError if the results do not match the settings; `read_sweep` has checked the runs."""
    columns = [*sweep.design, *sweep.columns, "failed", "message"]
    kinds = dict.fromkeys(sweep.columns, "fiub") | {"failed": "b"}
    if (
        list(table) != columns
        or any(table[name].dtype.kind not in kind for name, kind in kinds.items())
        or np.isinf(table[list(sweep.columns)].to_numpy(dtype=np.float64)).any()
    ):
        reason = "its rows are not those of its settings: was the file changed? --overwrite makes it anew"
        raise SweepFileError(path, reason)


def _outcome(path: Path, table: pd.DataFrame, found: int) -> Outcome:
    messages = table.loc[table["failed"], "message"].to_dict()
    return Outcome(path, table, len(table), len(messages), messages, interrupted=False, found=found)


def _unfinished(path: Path, whole: Part, done: int, found: int, interrupted: bool) -> Outcome:
    if not interrupted:
        raise SweepFileError(path, "runs are missing although all were executed")
    messages = {int(run): whole.messages[run] for run in np.flatnonzero(whole.failed)}
    return Outcome(path, None, done, len(messages), messages, interrupted=True, found=found)


def run_locally(
    sweep: Sweep, pending: NDArray[np.int64], threads: int | None, on_progress: Callable[[int], None]
) -> Generator[Part]:
    """Execute the runs with the given numbers, chunk by chunk.

    Args:
        sweep: the sweep
        pending: numbers of the runs
        threads: number of threads; by default the cores available to this process
        on_progress: called with the number of finished runs

    Raises:
        KeyboardInterrupt: on Ctrl-C, after the finished runs have been yielded
        FmuFileError, UnsupportedFmuError: the FMU cannot be run here
        ParameterError: the FMU rejects the settings of every run
    """
    least = threads or os.cpu_count() or 1
    chunks = Chunks(pending, seconds=_CHUNK, slots=1, least=least)
    done = 0
    task = sweep.task
    with task.open(sweep.settings.fmu.path) as fmu:
        plan = task.plan(fmu)

        def show(finished: int, _: int) -> None:
            on_progress(done + finished)

        while (runs := chunks.take()).size:
            begin = time.perf_counter()
            result = plan.run_batch(
                sweep.design.iloc[runs],
                threads=threads,
                reductions=task.results,
                on_progress=show,
            )
            chunks.timed(runs.size, time.perf_counter() - begin)
            yield part_of(result, runs)
            if result.interrupted:
                raise KeyboardInterrupt
            done += int(runs.size)
            on_progress(done)
