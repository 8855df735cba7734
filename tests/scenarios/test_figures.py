"""The scripts of the figures and tables: what they save, and that the numbers printed are the model's."""

from __future__ import annotations

import subprocess
from pathlib import Path

import pytest

from tests.scenarios.scripts import SCENARIOS, cells, load

FIGURES = {
    "fig01_opposing_springs": ["opposing_springs"],
    "fig04_instruments": ["instruments"],
    "fig07_load_deflection": ["load_deflection"],
    "fig10_free_oscillation": ["free_oscillation"],
    "fig13_damping_function": ["damping_function"],
    "period": ["period"],
    "tables_1_and_2": [],
}


@pytest.fixture
def printed(
    request: pytest.FixtureRequest, fmus_by_name: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> str:
    """What a script prints; its files are checked."""
    name = request.param
    assert load(name).main(tmp_path) == 0
    text = capsys.readouterr().out
    assert text.rstrip() == (tmp_path / "summary.md").read_text().rstrip()
    for figure in FIGURES[name]:
        assert (tmp_path / f"{figure}.png").read_bytes().startswith(b"\x89PNG")
        assert (tmp_path / f"{figure}.pdf").read_bytes().startswith(b"%PDF")
    found = {path.stem for path in tmp_path.iterdir() if path.suffix in (".png", ".pdf")}
    assert found == set(FIGURES[name])
    return text


def test_make_figures_runs_them_all() -> None:
    listed = subprocess.run(
        ["make", "--dry-run", "figures"], cwd=SCENARIOS.parent, capture_output=True, text=True, check=True
    ).stdout
    scripts = {path.stem for path in SCENARIOS.glob("fig[01]*.py")} | {"ergonomics", "free_oscillation"}
    missing = [name for name in scripts | set(FIGURES) if f"scenarios/{name}.py" not in listed]
    assert missing == []


@pytest.mark.parametrize("printed", ["fig01_opposing_springs"], indirect=True)
def test_fig_1_has_the_periods_of_the_closed_form(printed: str) -> None:
    rows = [cells(printed, amplitude) for amplitude in ("1", "2", "4", "7", "10")]
    assert all(abs(float(row[column])) < 1e-9 for row in rows for column in (1, 3))
    periods = [float(row[0]) for row in rows]
    assert periods == sorted(periods)
    # The paper calls the effect of the clearance minor: it is, but for small amplitudes.
    assert float(rows[-1][0]) / float(rows[-1][2]) == pytest.approx(1.0, abs=0.01)
    assert float(rows[0][0]) / float(rows[0][2]) > 1.05


@pytest.mark.parametrize("printed", ["fig04_instruments"], indirect=True)
def test_fig_4_gravity_is_a_small_part_of_the_signal(printed: str) -> None:
    assert float(printed.split("signal is at most ")[1].split(" %")[0]) == pytest.approx(6.0, abs=1.5)


@pytest.mark.parametrize("printed", ["fig07_load_deflection"], indirect=True)
def test_fig_7_forces_at_the_kinks(printed: str) -> None:
    assert float(cells(printed, "x_1")[1]) == pytest.approx(430e3 * 0.1235e-3, abs=1e-3)
    assert float(cells(printed, "x_1", 1)[1]) == pytest.approx(659e3 * 0.0845e-3, abs=1e-3)
    for side in (0, 1):
        secants = [float(cells(printed, row, side)[2]) for row in ("x_1", "x_3", "stop")]
        assert secants == sorted(secants, reverse=True)


@pytest.mark.parametrize("printed", ["fig10_free_oscillation"], indirect=True)
def test_fig_10_the_law_of_the_record_is_the_better_one(printed: str) -> None:
    power_law, constant = cells(printed, "damping function"), cells(printed, "constant C = 0.045")
    assert all(float(cell) < 3.0 for cell in power_law)
    assert all(float(cell) > 10.0 for cell in constant)


@pytest.mark.parametrize("printed", ["fig13_damping_function"], indirect=True)
def test_fig_13_the_jumps_at_zero_angle_are_the_large_ones(printed: str) -> None:
    line = next(line for line in printed.splitlines() if line.startswith("Largest change"))
    theta, omega = (float(word) for word in line.split() if word.startswith("0."))
    assert theta > 5.0 * omega
    equivalent = float(printed.split("a constant ")[1].split()[0])
    assert equivalent == pytest.approx(0.062, abs=0.001)


@pytest.mark.parametrize("printed", ["period"], indirect=True)
def test_the_period_falls_until_the_clearance_takes_over(printed: str) -> None:
    rows = {angle: cells(printed, angle) for angle in ("-0.3", "-0.5", "-1", "-2", "-5", "-10", "-20")}
    assert all(abs(float(row[1])) < 1e-9 for row in rows.values())
    periods = [float(row[0]) for row in rows.values()]
    assert periods[1:] == sorted(periods[1:])
    assert periods[0] > periods[1]


@pytest.mark.parametrize("printed", ["tables_1_and_2"], indirect=True)
def test_tables_1_and_2_are_the_papers(printed: str) -> None:
    assert [float(cell) for cell in cells(printed, "1")] == [0.1985, 2625.0, 0.1595, 1191.0]
    assert [float(cell) for cell in cells(printed, "3")] == [2.943, 5600.0, 3.063, 4090.0]
    assert cells(printed, "mass") == ["0.87", "kg"]
    assert cells(printed, "forward return spring") == ["2625", "427375", "52.78081", "0.075"]
