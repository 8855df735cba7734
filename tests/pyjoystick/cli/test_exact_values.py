"""Integers that a float cannot represent, in the commands."""

from __future__ import annotations

from pathlib import Path

from pyjoystick.runs import read_sweep
from tests.pyjoystick.cli.conftest import Command

LARGEST = 2**64 - 1
SWEEP = """
[fmu]
path = "{fmu}"

[experiment]
duration = 1.0
output_interval = 0.5
input_file = "inputs.csv"
time_limit = 2.0

[parameters]
p_Int64 = -9007199254740993

[inputs]
u_Int8 = -128
text_input = "calm"

[sampling]
method = "grid"

[vary.p_UInt64]
values = [18446744073709551615, 1]

[vary.delay]
values = [0.0, 3000.0]

[[results]]
kind = "final"
variable = "both_Int64[1]"

[[results]]
kind = "extremes"
variable = "u_again_Int8"
"""


def test_what_is_set_arrives(command: Command, echo3_path: Path) -> None:
    both = [str(echo3_path)] * 2
    sound = command("compare", *both, "--set", f"p_UInt64={LARGEST}", "--set", f"u_UInt64={LARGEST}")
    assert (sound.code, sound.err) == (0, "")
    assert "both_UInt64[2]" in sound.out
    with_a_point = command("compare", *both, "--set", f"p_UInt64={LARGEST}.0")
    assert (with_a_point.code, with_a_point.err) == (0, "")
    for text, told in (
        ("p_UInt64=9007199254740992.5", "p_UInt64 = 9007199254740992.0: must be an integer"),
        (f"p_UInt64={LARGEST + 1}", "p_UInt64 = 18446744073709551616: must be an integer"),
        (f"u_Int64={2**63}", "u_Int64 = 9223372036854775808: must be an integer"),
        ("p_Float32=1e39", "p_Float32 = 1e+39: must be a finite number"),
    ):
        refused = command("compare", *both, "--set", text)
        assert refused.code == 1
        assert told in refused.message


def test_a_sweep_keeps_every_digit_and_to_its_limit(
    command: Command, echo3_path: Path, tmp_path: Path
) -> None:
    (tmp_path / "sweep.toml").write_text(SWEEP.replace("{fmu}", str(echo3_path)))
    (tmp_path / "inputs.csv").write_text(f"time (s),u_UInt64\n0,{LARGEST}\n")
    done = command("sweep", "sweep.toml", "-o", "found.csv")
    assert done.code == 0, done
    assert "2 failed" in done.out
    table = read_sweep(tmp_path / "found.csv")
    assert table["p_UInt64"].tolist() == [LARGEST, LARGEST, 1, 1]
    assert table["failed"].tolist() == [False, True, False, True]
    assert table["message"].str.contains(r"the time limit of 2 s").tolist() == [False, True] * 2
    sound = table[~table["failed"]]
    assert sound["both_Int64[1].final"].tolist() == [float(-(2**53) - 1)] * 2
    assert sound["u_again_Int8.max"].tolist() == [-128.0] * 2
    again = command("sweep", "sweep.toml", "-o", "found.csv")
    assert "was already complete" in again.err
    (tmp_path / "sweep.toml").write_text(SWEEP.replace("{fmu}", str(echo3_path)).replace("2.0", "-1"))
    assert "time_limit = -1: must be a finite number above 0 s" in command("sweep", "sweep.toml").message
