"""What is repeated and what is not: by content, settings and version, however a run ended."""

from __future__ import annotations

import os
import random
import time
from dataclasses import replace
from pathlib import Path

import pytest

from pyjoystick.identification import FitInterruptedError
from pyjoystick.reports.project.planning import plan_assembly
from pyjoystick.reports.project.running import run_assembly
from pyjoystick.reports.project.steps import Done
from tests.pyjoystick.reports.project.toy import INPUTS, Toy

ALL = ["make a.txt", "make b.txt", "both"]


@pytest.fixture
def toy(tmp_path: Path) -> Toy:
    return Toy(tmp_path)


@pytest.fixture
def done(toy: Toy) -> Toy:
    """The same, after a first run."""
    run = toy.run()
    assert [one.state for one in run.steps] == ["done"] * 3
    assert toy.done == ALL
    return toy


def _plans(toy: Toy) -> dict[str, tuple[str, str]]:
    return {one.name: (one.plan, one.why) for one in plan_assembly(toy.root, toy.assembly())}


def test_a_second_run_does_nothing_and_still_tells_the_results(done: Toy) -> None:
    run = done.run()
    assert done.done == []
    assert [one.state for one in run.steps] == ["unchanged"] * 3
    assert (run.steps[0].remark, run.steps[0].notes) == ("A.TXT", ("a note",))
    assert {plan for plan, _ in _plans(done).values()} == {"nothing"}


def test_the_plan_says_what_is_new(toy: Toy) -> None:
    assert set(_plans(toy).values()) == {("do", "it has not been done yet")}
    assert not (toy.root / "results").exists()
    assert toy.done == []


def test_only_what_hangs_on_a_changed_file_is_done(done: Toy) -> None:
    done.write("a.txt", "other")
    plans = _plans(done)
    assert plans["make a.txt"] == ("do", "a.txt has changed")
    assert plans["make b.txt"][0] == "nothing"
    assert plans["both"] == ("perhaps", "if the result of make a.txt changes")
    done.run()
    assert done.done == ["make a.txt", "both"]


def test_a_file_that_was_only_touched_is_not_changed(done: Toy) -> None:
    os.utime(done.root / "a.txt", (1e9, 1e9))
    done.run()
    assert done.done == []


def test_content_counts_also_where_time_and_size_are_the_same(done: Toy) -> None:
    before = (done.root / "a.txt").stat()
    done.write("a.txt", "z.txt")
    os.utime(done.root / "a.txt", ns=(before.st_atime_ns, before.st_mtime_ns))
    done.run()
    assert done.done == ["make a.txt", "both"]


def test_what_comes_out_as_before_goes_no_further(done: Toy) -> None:
    done.write("a.txt", " a.txt\n")
    done.run()
    assert done.done == ["make a.txt"]


def test_a_changed_setting_is_named(done: Toy) -> None:
    settings = {"radius": 0.266, "columns": {"time": "t"}}
    done.run(settings)
    assert done.done == ["make a.txt", "make b.txt"]
    changed = done.assembly({"radius": 0.27, "columns": {}})
    plans = {one.name: one.why for one in plan_assembly(done.root, changed)}
    assert plans["make a.txt"] == "columns.time was t and is not given; radius was 0.266 and is 0.27"


def test_another_version_does_all_again(done: Toy, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pyjoystick.reports.project.tasks.version_of", lambda package: "99.0")
    assert _plans(done)["both"][1].startswith("pyjoystick was ")
    done.run()
    assert done.done == ALL


@pytest.mark.parametrize("what", ["results/a.txt", "results/a.txt.md"])
def test_results_that_were_changed_or_deleted_are_made_again(done: Toy, what: str) -> None:
    done.write(what, "by hand")
    assert _plans(done)["make a.txt"] == ("do", f"{what} was changed")
    done.run()
    assert done.done == ["make a.txt"]
    (done.root / what).unlink()
    assert f"{what} is missing" in _plans(done)["make a.txt"][1]
    done.run()
    assert done.done == ["make a.txt"]
    assert done.read(what) == "A.TXT"


def test_what_does_not_hang_on_a_damaged_file_is_done(toy: Toy) -> None:
    toy.write("a.txt", "bad")
    run = toy.run()
    assert [one.state for one in run.steps] == ["failed", "done", "not done"]
    assert run.steps[0].remark == f"{toy.root / 'a.txt'}: is damaged"
    assert run.steps[2].remark == "needs make a.txt"
    toy.write("a.txt", "repaired")
    toy.run()
    assert toy.done == ["make a.txt", "both"]


def test_a_damage_that_is_repaired_costs_nothing(done: Toy) -> None:
    done.write("a.txt", "bad")
    assert [one.state for one in done.run().steps] == ["failed", "unchanged", "not done"]
    # What no longer holds is out of the way until it does again.
    assert not (done.root / "results/both.txt").exists()
    assert done.read("results/outdated/both.txt") == "A.TXTB.TXT"
    assert {one.plan for one in plan_assembly(done.root, done.assembly())} == {"do", "nothing", "perhaps"}
    done.write("a.txt", "a.txt")
    assert {one.plan for one in plan_assembly(done.root, done.assembly())} == {"nothing"}
    done.run()
    assert done.done == []
    assert done.read("results/both.txt") == "A.TXTB.TXT"
    assert not (done.root / "results/outdated").exists()


def test_what_a_step_does_not_make_any_more_is_gone(done: Toy) -> None:
    """With another setting a step writes under another name; beside it the old file would pass for new."""
    steps = done.assembly().steps
    renamed = replace(
        steps[2], settings={"name": "other"}, work=lambda tell: _writes(done, "results/other.txt")
    )
    run_assembly(done.root, replace(done.assembly(), steps=(*steps[:2], renamed)), lambda steps: None)
    assert not (done.root / "results/both.txt").exists()
    assert done.read("results/other.txt") == "text"


def test_results_of_a_step_that_is_no_more_are_set_aside(done: Toy) -> None:
    """A file that someone changed stays where it is."""
    done.write("results/both.txt", "by hand")
    without = replace(done.assembly(), steps=done.assembly().steps[:2])
    run = run_assembly(done.root, without, lambda steps: None)
    assert run.notes == ("results that no longer hold are now in results/outdated: both.txt.md",)
    assert done.read("results/both.txt") == "by hand"
    assert done.read("results/outdated/both.txt.md") == "A.TXTB.TXT"


def test_the_plan_knows_what_a_step_does_not_make(done: Toy) -> None:
    """As a doubtful fit: it is done, and makes no joystick."""
    steps = done.assembly().steps
    doubtful = replace(
        steps[0], settings={"a": 1}, work=lambda tell: Done(files=(), remark="failed whiteness")
    )
    assembly = replace(done.assembly(), steps=(doubtful, *steps[1:]))
    assert [one.plan for one in plan_assembly(done.root, assembly)] == ["do", "nothing", "perhaps"]
    run = run_assembly(done.root, assembly, lambda steps: None)
    assert run.steps[2].remark == "needs the make a.txt, which failed whiteness"
    planned = plan_assembly(done.root, assembly)
    assert [one.plan for one in planned] == ["nothing", "nothing", "missing"]
    assert planned[2].why == "needs the make a.txt, which failed whiteness"


def _writes(toy: Toy, name: str) -> Done:
    toy.write(name, "text")
    return Done(files=(name,), remark="")


def test_a_fault_of_a_step_does_not_end_the_others(toy: Toy) -> None:
    def fault(place: str) -> None:
        if toy.done == ["make a.txt"]:
            raise ZeroDivisionError("a fault")

    toy.hook = fault
    run = toy.run()
    assert [one.state for one in run.steps] == ["failed", "done", "not done"]
    name = ".pyjoystick/faults/make_a.txt.txt"
    assert run.steps[0].remark == f"internal error: ZeroDivisionError: a fault (traceback in {name})"
    assert "in fault" in toy.read(name)


@pytest.mark.parametrize("how", [KeyboardInterrupt, FitInterruptedError])
def test_after_ctrl_c_the_next_run_goes_on(toy: Toy, how: type[BaseException]) -> None:
    def stop(place: str) -> None:
        if toy.done == ["make a.txt", "make b.txt"] and place == "between":
            raise how

    toy.hook = stop
    run = toy.run()
    assert run.interrupted
    assert [one.state for one in run.steps] == ["done", "not done", "not done"]
    toy.hook = lambda place: None
    assert not toy.run().interrupted
    assert toy.done == ["make b.txt", "both"]


def test_a_file_that_changes_while_it_is_read_is_read_again(toy: Toy) -> None:
    def edit(place: str) -> None:
        if toy.done == ["make a.txt"] and place == "after":
            toy.write("a.txt", "edited meanwhile")

    toy.hook = edit
    toy.run()
    toy.hook = lambda place: None
    toy.run()
    assert toy.done == ["make a.txt", "both"]
    assert toy.read("results/both.txt") == "EDITED MEANWHILEB.TXT"


@pytest.mark.parametrize(
    "content",
    [
        *("", "{", "[1, 2]", '{"both": 3}', '{"both": {"_values_:": 3}}', "\udcff", "[" * 100_000),
        *('{"both": {"deps:": 5}}', '{"both": {"deps:": [[]]}}', '{"both": {"results/a.txt": []}}'),
        *('{"both": {"_values_:": {"settings": null}}}', '{"both": {"_values_:": {"files": {"a": 1}}}}'),
    ],
)
def test_a_damaged_memory_counts_as_none(done: Toy, content: str) -> None:
    memory = done.root / ".pyjoystick" / "state.json"
    memory.write_bytes(content.encode("utf-8", "surrogateescape"))
    done.run()
    assert done.done == ALL


def test_a_project_may_move(done: Toy, tmp_path_factory: pytest.TempPathFactory) -> None:
    place = tmp_path_factory.mktemp("moved") / "project"
    done.root.rename(place)
    done.root = place
    done.run()
    assert done.done == []


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes cannot be forked")
def test_killed_at_any_moment_the_next_run_goes_on_correctly(tmp_path: Path) -> None:
    """Random edits and killed runs; what is there in the end is what the inputs alone make."""
    rng = random.Random(1)
    toy = Toy(tmp_path)
    killed = 0
    for _ in range(50):
        name = rng.choice(INPUTS)
        toy.write(name, rng.choice(["one", "two", "bad", " one "]))
        if rng.random() < 0.2 and (tmp_path / "results").is_dir():
            toy.write(rng.choice(["results/a.txt", "results/both.txt"]), "by hand")
        killed += _killed(toy, rng.randrange(1, 6), rng.random() < 0.5)
        if rng.random() < 0.3:
            for name in INPUTS:
                toy.write(name, rng.choice(["one", "two"]))
            toy.run()
            _assert_right(toy)
    assert killed > 20


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes cannot be forked")
def test_a_killed_run_loses_the_step_that_it_was_at_and_no_other(toy: Toy) -> None:
    assert _killed(toy, after=5, hard=True)
    toy.run()
    assert toy.done == ["make b.txt", "both"]


@pytest.mark.skipif(not hasattr(os, "fork"), reason="processes cannot be forked")
def test_an_edit_that_is_taken_back_after_a_kill(done: Toy) -> None:
    done.write("a.txt", "other")
    assert _killed(done, after=2, hard=True)
    done.write("a.txt", "a.txt")
    done.run()
    assert done.done == ["make a.txt"]
    assert done.read("results/a.txt") == "A.TXT"


def _killed(toy: Toy, after: int, hard: bool) -> bool:
    """A run in another process that is killed at one of the moments of its steps, if there are so many."""
    child = os.fork()
    if child == 0:
        left = after

        def kill(place: str) -> None:
            nonlocal left
            left -= 1
            if left == 0:
                if hard:
                    (toy.root / "results" / f".a-{os.getpid()}-0123abcd.txt").write_text("half")
                os._exit(9)

        toy.hook = kill
        toy.run()
        os._exit(0)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 9


def _assert_right(toy: Toy) -> None:
    assert {name: toy.read(name) for name in toy.expected()} == toy.expected()
    assert {name: toy.read(f"{name}.md") for name in toy.expected()} == toy.expected()
    files = {path.name for path in (toy.root / "results").iterdir()}
    assert files == {f"{Path(name).name}{end}" for name in toy.expected() for end in ("", ".md")}
    started = time.perf_counter()
    toy.run()
    assert toy.done == []
    assert time.perf_counter() - started < 2.0


def test_an_outdated_result_that_someone_changed_does_not_come_back(done: Toy) -> None:
    """Among the results it would pass for what the step made."""
    done.write("a.txt", "bad")
    done.run()
    done.write("results/outdated/both.txt", "by hand")
    done.run()
    assert not (done.root / "results/both.txt").exists()
    done.write("a.txt", "a.txt")
    done.run()
    assert done.read("results/both.txt") == "A.TXTB.TXT"
