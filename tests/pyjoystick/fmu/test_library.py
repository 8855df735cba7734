"""Opening FMUs that cannot be run, threads that share one, and cleaning up."""

from __future__ import annotations

import gc
import os
import re
import subprocess
import sys
from pathlib import Path

import fmpy
import pytest

from pyjoystick.fmu import Fmu, FmuFileError, UnsupportedFmuError, run_model_exchange
from pyjoystick.support import PyJoystickError
from tests.pyjoystick.fmu.doctored import FMI_3, doctored, without_co_simulation


def test_without_co_simulation(joystick_path: Path, tmp_path: Path) -> None:
    path = doctored(joystick_path, tmp_path / "me.fmu", description=without_co_simulation)
    with pytest.raises(UnsupportedFmuError, match=r"me\.fmu: has no CoSimulation .*it has ModelExchange"):
        Fmu(path)


def test_fmi_3_has_other_names_for_platforms(joystick_path: Path, tmp_path: Path) -> None:
    path = doctored(joystick_path, tmp_path / "3.fmu", description=lambda _: FMI_3)
    with pytest.raises(
        UnsupportedFmuError, match=rf"has no binary for {fmpy.platform_tuple} \(it has .*{fmpy.platform}"
    ):
        Fmu(path)


def test_no_binary_for_this_platform(joystick_path: Path, tmp_path: Path) -> None:
    path = doctored(
        joystick_path,
        tmp_path / "other.fmu",
        rename=lambda name: name.replace(f"binaries/{fmpy.platform}/", "binaries/riscv64-linux/"),
    )
    expected = rf"other\.fmu: has no binary for {fmpy.platform} \(it has riscv64-linux\)"
    with pytest.raises(UnsupportedFmuError, match=expected):
        Fmu(path)


def test_linux_on_aarch64_has_its_own_binaries(
    joystick_path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As FMI 2.0.5 has it. What is loaded here under that name is this machine's binary."""
    path = doctored(
        joystick_path,
        tmp_path / "arm.fmu",
        rename=lambda name: name.replace(f"binaries/{fmpy.platform}/", "binaries/aarch64-linux/"),
    )
    monkeypatch.setattr(fmpy, "platform_tuple", "aarch64-linux")
    with Fmu(path) as fmu:
        run = fmu.run([0.0, 0.1], parameters={"theta_start": -0.35}, outputs=["theta"])
    assert run["theta"].iloc[0] == -0.35
    assert run["theta"].iloc[-1] > 0.0


def test_a_binary_that_is_none(joystick_path: Path, tmp_path: Path, unpacking_folder: Path) -> None:
    path = doctored(
        joystick_path,
        tmp_path / "garbage.fmu",
        content=lambda name, data: b"garbage" if name.startswith("binaries/") else data,
    )
    before = Path.cwd()
    with pytest.raises(FmuFileError, match=r"garbage\.fmu: its binary cannot be loaded"):
        Fmu(path)
    assert Path.cwd() == before
    assert list(unpacking_folder.iterdir()) == []


def test_a_binary_that_refuses_says_why(joystick_path: Path, tmp_path: Path, unpacking_folder: Path) -> None:
    path = doctored(
        joystick_path, tmp_path / "guid.fmu", description=lambda text: text.replace('guid="{', 'guid="{0')
    )
    with pytest.raises(FmuFileError, match=r"guid\.fmu: cannot be instantiated: The GUID is not that of"):
        Fmu(path)
    assert list(unpacking_folder.iterdir()) == []


def test_a_damaged_archive(joystick_path: Path, tmp_path: Path, unpacking_folder: Path) -> None:
    content = bytearray(doctored(joystick_path, tmp_path / "damaged.fmu").read_bytes())
    place = content.index(b"\x7fELF" if os.name == "posix" else b"MZ") + 100
    content[place] ^= 0xFF
    (tmp_path / "damaged.fmu").write_bytes(content)
    with pytest.raises(FmuFileError, match=r"damaged\.fmu: cannot be unpacked: Bad CRC-32"):
        Fmu(tmp_path / "damaged.fmu")
    assert list(unpacking_folder.iterdir()) == []


def test_what_is_unpacked_is_deleted_on_leaving(joystick_path: Path, unpacking_folder: Path) -> None:
    with Fmu(joystick_path):
        assert len(list(unpacking_folder.iterdir())) == 1
    assert list(unpacking_folder.iterdir()) == []


def test_an_fmu_that_is_forgotten_is_put_away(joystick_path: Path, unpacking_folder: Path) -> None:
    fmu = Fmu(joystick_path)
    fmu.run([0.0, 0.1])
    del fmu
    gc.collect()
    assert list(unpacking_folder.iterdir()) == []


def test_closing_twice_does_no_harm_and_ends_use(joystick_path: Path) -> None:
    fmu = Fmu(joystick_path)
    fmu.close()
    fmu.close()
    with pytest.raises(PyJoystickError, match=r"Joystick\.fmu has been closed"):
        fmu.run([0.0, 1.0])


def test_an_exception_inside_the_block_puts_away_too(joystick_path: Path, unpacking_folder: Path) -> None:
    with pytest.raises(KeyboardInterrupt), Fmu(joystick_path):
        raise KeyboardInterrupt
    assert list(unpacking_folder.iterdir()) == []


_FORK = """
import os, sys
from pyjoystick.fmu import Fmu
fmu = Fmu(sys.argv[1])
before = fmu.run([0.0, 0.1], parameters={"theta_start": 0.1})
child = os.fork()
same = fmu.run([0.0, 0.1], parameters={"theta_start": 0.1}).equals(before)
if child == 0:
    fmu.close()
    os._exit(0 if same else 1)
_, status = os.waitpid(child, 0)
print(status, same, fmu._pool.library.folder.is_dir())
fmu.close()
print(fmu._pool.library.folder.is_dir())
"""


def test_an_instance_at_work_keeps_the_library(joystick_path: Path, unpacking_folder: Path) -> None:
    fmu = Fmu(joystick_path)
    first, second = fmu._pool.take(), fmu._pool.take()
    fmu.close()
    with pytest.raises(PyJoystickError, match="has been closed"):
        fmu.run([0.0, 1.0])
    fmu._pool.give_back(first)
    assert len(list(unpacking_folder.iterdir())) == 1
    fmu._pool.give_back(second)
    assert list(unpacking_folder.iterdir()) == []


@pytest.mark.skipif(sys.platform == "win32", reason="no fork")
def test_a_forked_process_runs_on_and_deletes_nothing(joystick_path: Path) -> None:
    command = [sys.executable, "-c", _FORK, str(joystick_path)]
    lines = subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines()
    assert lines == ["0 True True", "False"]


@pytest.mark.parametrize("version", [2, 3])
def test_start_values_that_were_edited_in_the_description_alone(
    version: int, joystick_path: Path, joystick_fmus3: Path, tmp_path: Path
) -> None:
    def change(text: str) -> str:
        return re.sub(r'(name="damping.C".*?start=")[^"]*', r"\g<1>0.02", text, count=1, flags=re.DOTALL)

    path = joystick_path if version == 2 else joystick_fmus3 / "Joystick.fmu"
    edited = doctored(path, tmp_path / "edited.fmu", description=change)
    message = r"damping\.C is 0\.02 in its modelDescription\.xml, but 0\.045 in its binary: set parameters"
    with pytest.raises(FmuFileError, match=message):
        Fmu(edited)
    with pytest.raises(FmuFileError, match=message):
        run_model_exchange(edited, [0.0, 0.1])
