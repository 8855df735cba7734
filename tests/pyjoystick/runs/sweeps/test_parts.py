"""Finished runs of an unfinished sweep."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pyjoystick.runs import ChangedSweepError, SweepFileError
from pyjoystick.runs.sweeps.parts import Parts, require_same
from pyjoystick.runs.sweeps.sweep import Part
from pyjoystick.support import OutputFileError

IDENTITY: dict[str, Any] = {"settings": {"experiment": {"duration": 1.5}}, "runs": 6}


def _part(*runs: int, failed: int | None = None) -> Part:
    numbers = np.array(runs, dtype=np.int64)
    is_failed = numbers == (-1 if failed is None else failed)
    values = np.where(is_failed[:, None], np.nan, numbers[:, None] * np.array([1.0, 0.1]))
    return Part(numbers, values, is_failed, [f"run {run} broke" if run == failed else "" for run in runs])


def test_parts_come_back_as_they_were(tmp_path: Path) -> None:
    parts = Parts(tmp_path / "a.csv")
    with parts.opened(IDENTITY):
        parts.save(_part(4, 5, failed=5))
        parts.save(_part())
        parts.save(_part(0, 2, 1))
    again = Parts(tmp_path / "a.csv")
    with again.opened(IDENTITY):
        whole, done = again.whole(6, 2)
    assert done.tolist() == [True, True, True, False, True, True]
    assert whole.failed.tolist() == [False] * 5 + [True]
    assert whole.messages == ["", "", "", "", "", "run 5 broke"]
    np.testing.assert_array_equal(whole.values[:, 0], [0.0, 1.0, 2.0, np.nan, 4.0, np.nan])
    again.remove()
    assert list(tmp_path.iterdir()) == []


def test_a_part_that_was_cut_short_is_done_again(tmp_path: Path) -> None:
    parts = Parts(tmp_path / "a.csv")
    with parts.opened(IDENTITY):
        for part in (_part(0, 1), _part(2, 3), _part(4, 5)):
            parts.save(part)
        files = sorted(parts.folder.glob("*.npz"))
        files[0].write_bytes(files[0].read_bytes()[:-40])
        files[1].write_bytes(b"")
        assert parts.whole(6, 2)[1].tolist() == [False] * 4 + [True] * 2


def test_other_settings_are_told_and_refused(tmp_path: Path) -> None:
    parts = Parts(tmp_path / "a.csv")
    with parts.opened(IDENTITY):
        parts.save(_part(0))
    changed = {"settings": {"experiment": {"duration": 2.0}}, "runs": 6}
    with pytest.raises(ChangedSweepError) as refused, parts.opened(changed):
        pytest.fail("must not be opened")
    assert refused.value.differences == ("settings experiment duration was 1.5 and is 2.0",)
    with pytest.raises(ChangedSweepError, match=r"another sweep: settings seed was null and is 2\. Choose"):
        require_same(parts.target, {"runs_sha256": "a"}, {"settings": {"seed": 2}, "runs_sha256": "b"})
    with pytest.raises(ChangedSweepError, match=r"another sweep: fmu has other contents\. Choose"):
        require_same(parts.target, {"fmu": {"sha256": "a"}}, {"fmu": {"sha256": "b"}})
    with parts.opened(IDENTITY):
        assert parts.whole(6, 2)[1].sum() == 1
    with parts.opened(changed, anew=True):
        assert parts.whole(6, 2)[1].sum() == 0


OTHER: dict[str, Any] = {"settings": {"experiment": {"duration": 2.0}}, "runs": 6}


def _stopped_after(steps: int, monkeypatch: pytest.MonkeyPatch, work: Callable[[], object]) -> bool:
    """Do `work`, but stop it at the step of that number that changes a folder; whether it was stopped."""
    taken = 0

    def counted(original: Callable[..., object]) -> Callable[..., object]:
        def step(*arguments: object, **named: object) -> object:
            nonlocal taken
            taken += 1
            if taken > steps:
                raise KeyboardInterrupt
            return original(*arguments, **named)

        return step

    with monkeypatch.context() as patch:
        for name in ("unlink", "replace", "rmdir"):
            patch.setattr(os, name, counted(getattr(os, name)))
        try:
            work()
        except KeyboardInterrupt:
            return True
    return False


def _begun(folder: Path) -> Parts:
    parts = Parts(folder / "a.csv")
    with parts.opened(IDENTITY):
        for part in (_part(0, 1), _part(2, 3), _part(4, 5)):
            parts.save(part)
    return parts


def _overwrite(parts: Parts) -> None:
    with parts.opened(OTHER, anew=True):
        pass


@pytest.mark.parametrize("end", [_overwrite, Parts.remove], ids=["overwritten", "finished"])
def test_wherever_the_deletion_stops_no_other_sweep_adopts_the_parts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, end: Callable[[Parts], object]
) -> None:
    steps = 0
    while True:
        parts = _begun(tmp_path / str(steps))
        stopped = _stopped_after(steps, monkeypatch, partial(end, parts))
        with suppress(ChangedSweepError), parts.opened(OTHER):
            assert parts.whole(6, 2)[1].sum() == 0
        _overwrite(parts)
        with parts.opened(OTHER):
            assert parts.whole(6, 2)[1].sum() == 0
        if not stopped:
            break
        steps += 1
    assert steps >= 5


def test_parts_that_do_not_say_whose_they_are_are_refused(tmp_path: Path) -> None:
    parts = _begun(tmp_path)
    (parts.folder / "sweep.json").unlink()
    with pytest.raises(ChangedSweepError, match=r"has runs but no sweep\.json"), parts.opened(IDENTITY):
        pytest.fail("must not be opened")
    with parts.opened(IDENTITY, anew=True):
        assert parts.whole(6, 2)[1].sum() == 0


def test_what_another_sweep_or_process_keeps_is_not_removed(tmp_path: Path) -> None:
    parts = _begun(tmp_path)
    parts.remove(OTHER)
    with _another_process_at_work(parts.target):
        parts.remove(IDENTITY)
    with parts.opened(IDENTITY):
        assert parts.whole(6, 2)[1].all()
    (parts.folder / ".from-000000000-1-a.npz").write_bytes(b"cut short")
    parts.remove(IDENTITY)
    assert list(tmp_path.iterdir()) == []


def test_keys_that_come_or_go_are_differences(tmp_path: Path) -> None:
    with pytest.raises(ChangedSweepError, match="fmu guid was null and is 1"):
        require_same(tmp_path, {}, {"fmu": {"guid": 1}})
    require_same(tmp_path, IDENTITY | {"versions": "any"}, IDENTITY)


@contextmanager
def _another_process_at_work(target: Path) -> Iterator[subprocess.Popen[str]]:
    """A process that has the sweep open until it is killed."""
    script = (
        "import sys; from pathlib import Path; from pyjoystick.runs.sweeps.parts import Parts\n"
        f"with Parts(Path({str(target)!r})).opened({IDENTITY!r}):\n"
        "    print('open', flush=True); sys.stdin.read()\n"
    )
    command = [sys.executable, "-c", script]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "open\n"
            yield process
        finally:
            process.kill()


def test_a_second_process_is_refused_at_once_until_the_first_is_gone(tmp_path: Path) -> None:
    parts = Parts(tmp_path / "a.csv")
    with _another_process_at_work(parts.target) as process:
        begin = time.monotonic()
        with pytest.raises(SweepFileError, match="another process"), parts.opened(IDENTITY, anew=True):
            pytest.fail("must not be opened")
        assert time.monotonic() - begin < 5.0
        assert parts.begun, "the parts of the first must stay"
        process.kill()
        process.wait()
        with parts.opened(IDENTITY):
            assert parts.begun


def test_a_folder_that_cannot_be_made(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("kept")
    parts = Parts(tmp_path / "file" / "a.csv")
    with pytest.raises(OutputFileError, match="its folder cannot be created"), parts.opened(IDENTITY):
        pytest.fail("must not be opened")


def test_an_unreadable_record_is_an_error(tmp_path: Path) -> None:
    parts = Parts(tmp_path / "a.csv")
    parts.folder.mkdir()
    (parts.folder / "sweep.json").write_text("{")
    with pytest.raises(SweepFileError, match="cannot be read"), parts.opened(IDENTITY):
        pytest.fail("must not be opened")
