"""Many runs of one instance, many instances, many threads: same numbers, no growing memory."""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor

import pytest

from tests.fmu_build.runtime.conftest import Build
from tests.fmu_build.runtime.library import OK, Instance


def _resident_bytes() -> int:
    with open("/proc/self/statm", encoding="ascii") as file:  # noqa: PTH123
        return int(file.read().split()[1]) * 4096


def _run(instance: Instance, steps: int = 10) -> list[list[float]]:
    instance.initialize(stop=0.1)
    return instance.run(0.1, steps, (0, 1))


def test_reset_brings_back_a_fresh_instance(build: Build) -> None:
    fresh, used = Instance(build("joystick")), Instance(build("joystick"))
    blank = fresh.serialize(fresh.save())
    assert used.set({7: 3.0, 8: 0.5, 0: 0.1}) == OK
    _run(used)
    used.expect("fmi2Reset")
    assert used.serialize(used.save()) == blank
    assert _run(used) == _run(fresh)
    assert used.serialize(used.save()) == fresh.serialize(fresh.save())
    fresh.free()
    used.free()


@pytest.mark.skipif(sys.platform != "linux", reason="reads the resident memory from /proc")
def test_memory_stays_flat(build: Build) -> None:
    instance = Instance(build("joystick"))
    expected = _run(instance, 2)
    for cycle in range(10_000):
        instance.expect("fmi2Reset")
        assert _run(instance, 2) == expected
        if cycle == 1000:
            before = _resident_bytes()
    # A leak of one double per cycle would be 72 kB, of one state 5 MB.
    assert _resident_bytes() - before < 60_000
    instance.free()


@pytest.mark.skipif(sys.platform != "linux", reason="reads the resident memory from /proc")
def test_instances_and_states_leave_nothing_behind(build: Build) -> None:
    library = build("joystick")
    for cycle in range(3_000):
        instance = Instance(library)
        state = instance.save()
        status, copy = instance.deserialize(instance.serialize(state))
        assert status == OK
        instance.discard(state)
        instance.discard(copy)
        instance.free()
        if cycle == 1000:
            before = _resident_bytes()
    assert _resident_bytes() - before < 200_000


def test_instances_do_not_disturb_each_other(build: Build) -> None:
    """Runs in lockstep and in threads give what each gives alone."""
    library = build("joystick")
    angles = [-0.34, -0.2, 0.1, 0.3]

    def alone(angle: float) -> list[list[float]]:
        instance = Instance(library)
        assert instance.set({0: angle}) == OK
        values = _run(instance, 300)
        instance.free()
        return values

    expected = [alone(angle) for angle in angles]
    with ThreadPoolExecutor(4) as pool:
        assert list(pool.map(alone, angles * 5)) == expected * 5

    instances = [Instance(library) for _ in angles]
    for instance, angle in zip(instances, angles, strict=True):
        assert instance.set({0: angle}) == OK
        instance.initialize(stop=0.1)
    for i in range(300):
        for instance, values in zip(instances, expected, strict=True):
            size = 0.1 / 300
            assert instance.step(i * size, size) == OK
            assert instance.get(0, 1) == values[i + 1]
    for instance in instances:
        instance.free()
