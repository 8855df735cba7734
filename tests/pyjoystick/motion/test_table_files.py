"""Tables of columns: headings, units and cells, and the messages for mistakes in them."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

from pyjoystick.motion import TIME, UNITS, Column, RecordError, plain_unit, read_table_file, read_table_head

ANGLE = Column("theta", UNITS["angle"])


def _file(folder: Path, text: str) -> Path:
    path = folder / "table.csv"
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize(
    ("kind", "unit", "meaning"),
    [
        ("time", "ms", 1 / 1000),
        ("angle", "deg", math.pi / 180),
        ("angle", "mrad", 1 / 1000),
        ("angular velocity", "deg/s", math.pi / 180),
        ("angular acceleration", "deg/s2", math.pi / 180),
        ("length", "cm", 1 / 100),
        ("length", "mm", 1 / 1000),
        ("length", "um", 1 / 1000000),
        ("force", "kN", 1000),
        ("force", "mN", 1 / 1000),
        ("force", "kgf", 9.80665),
        ("force", "lbf", 4.4482216152605),
        ("length", "in", 0.0254),
        ("time", "min", 60.0),
        ("time", "h", 3600.0),
        ("angle", "mdeg", math.pi / 180.0 / 1000.0),
        ("angle", "gon", math.pi / 200.0),
        ("angular velocity", "rpm", 2.0 * math.pi / 60.0),
        ("torque", "lbf.in", 0.1129848290276167),
        ("torque", "lbf.ft", 1.3558179483314004),
        ("mass", "g", 1 / 1000),
        ("moment of inertia", "g.m2", 1 / 1000),
        ("moment of inertia", "kg.mm2", 1 / 1000**2),
        ("moment of inertia", "g.cm2", 1 / 1000 / 100**2),
        ("moment of inertia", "g.mm2", 1 / 1000 / 1000**2),
        ("acceleration", "mm/s2", 1 / 1000),
        ("acceleration", "g", 9.80665),
        ("voltage", "mV", 1 / 1000),
    ],
)
def test_units_by_their_definition(kind: str, unit: str, meaning: float) -> None:
    assert UNITS[kind][unit] == pytest.approx(meaning, rel=1e-15)


def test_the_other_units_are_those_of_the_si() -> None:
    plain = {unit for units in UNITS.values() for unit, factor in units.items() if factor == 1.0}
    assert plain == {
        "s",
        "rad",
        "rad/s",
        "rad/s2",
        "m",
        "N",
        "N.m",
        "kg",
        "kg.m2",
        "m/s2",
        "V",
        "N/m",
        "N.m.s/rad",
        "N.m.s",
    }


@pytest.mark.parametrize(
    ("text", "plain"),
    [("°/s²", "deg/s2"), ("m/s^2", "m/s2"), ("µm", "um"), ("μm", "um"), ("N m", "N.m"), ("kg·m²", "kg.m2")],
)
def test_spellings_of_units(text: str, plain: str) -> None:
    assert plain_unit(text) == plain
    assert plain_unit(plain) == plain


def test_columns_in_si_units(tmp_path: Path) -> None:
    file = read_table_file(_file(tmp_path, "# made\ntime (ms)\tomega [°/s]\tTHETA (°)\n# more\n\n5\t1\t90\n"))
    series = file.read([TIME, ANGLE, Column("alpha", UNITS["angular acceleration"], required=False)])
    assert {name: values.tolist() for name, values in series.items()} == {
        "time": [0.005],
        "theta": [math.pi / 2],
    }
    assert file.comments == ("made", "more")
    assert file.rows.tolist() == [5]
    assert (file.head.line, file.head.delimiter) == (2, "\t")


def test_a_heading_in_the_very_case_comes_first(tmp_path: Path) -> None:
    file = read_table_file(_file(tmp_path, "t (s),T (N.m),theta (rad)\n1,2,3\n"))
    series = file.read([TIME, Column("T", {"N.m": 1.0}), ANGLE], units={"T": "N m"})
    assert {name: values.tolist() for name, values in series.items()} == {
        "time": [1.0],
        "T": [2.0],
        "theta": [3.0],
    }


def test_brackets_may_be_part_of_a_name(tmp_path: Path) -> None:
    file = read_table_file(_file(tmp_path, "x[1],x[2] (mm),x\n1,2,3\n"))
    length = {"m": 1.0, "mm": 1e-3}
    columns = [Column(name, length, default_unit="m") for name in ("x[1]", "x[2]")]
    assert {name: values[0] for name, values in file.read(columns).items()} == {"x[1]": 1.0, "x[2]": 0.002}


def test_rows_of_empty_cells_are_no_rows(tmp_path: Path) -> None:
    """Spreadsheets write them around a table."""
    file = read_table_file(_file(tmp_path, ",\n\ntime (s),theta (rad)\n,\n1,2\n , \n3,4\n,\n,\n"))
    series = file.read([TIME, ANGLE])
    assert {name: values.tolist() for name, values in series.items()} == {
        "time": [1.0, 3.0],
        "theta": [2.0, 4.0],
    }
    assert file.rows.tolist() == [5, 7]
    assert file.head.line == 3
    with pytest.raises(RecordError, match="has no rows under a heading"):
        read_table_file(_file(tmp_path, "time (s),theta (rad)\n,\n"))


def test_an_empty_cell_at_the_end_of_a_row_is_a_cell(tmp_path: Path) -> None:
    file = read_table_file(_file(tmp_path, "theta (rad)\tremark\n1\t\n\t\n2\tgood\n"))
    assert file.texts(file.head.headings[1]) == ["", "good"]


def test_cells_in_quotes(tmp_path: Path) -> None:
    file = read_table_file(_file(tmp_path, 'time (s),"theta, in degrees (deg)"\n"1", "180"\n'))
    assert file.read([ANGLE], headings={"theta": "theta, in degrees"})["theta"][0] == math.pi


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time (s)\n1\n", "row 1: has no column 'theta'; separate the columns by commas, semicolons or tabs"),
        (
            "time (s),phi (rad)\n1,2\n",
            "row 1: has no column 'theta'; which column holds theta? There are",
        ),
        ("theta (deg),theta (rad)\n1,2\n", "row 1: has 2 columns 'theta'; choose one by its whole heading"),
        (
            "theta\n1\n",
            "column 'theta', row 1: has no unit; write it in the heading, as in 'theta (rad)'",
        ),
        (
            "theta (turns)\n1\n",
            "'theta (turns)', row 1: has an unknown unit (found turns); known are rad",
        ),
        ("theta (deg)\n1\nx\n", "column 'theta (deg)', row 3: is not a number (found 'x'); write a number"),
        ("theta (deg)\n1\n1_000\n", "row 3: is not a number (found '1_000'); write a number"),
        ("theta (deg)\n1\n\u0661\n", "row 3: is not a number (found '\u0661'); write a number"),
        (
            "theta (deg);a\n1,5;2\n",
            "row 2: is not a number (found '1,5'); write numbers with a decimal point",
        ),
        (
            "theta (deg)\n\n1\ninf\n",
            "'theta (deg)', row 4: samples without a finite number (found inf)",
        ),
        ("theta (deg),a\n1,2\n3\n", "row 3: has 1 cell under 2 headings"),
        ("theta (deg),1\n1,2\n", "row 1: has a number where a heading is expected (found '1')"),
        ("theta (deg)\n", "has no rows under a heading"),
        ("# nothing\n", "has no headings"),
    ],
)
def test_mistakes_are_named(tmp_path: Path, text: str, message: str) -> None:
    path = _file(tmp_path, text)
    with pytest.raises(RecordError) as refused:
        read_table_file(path).read([ANGLE])
    assert str(refused.value).startswith(f"{path}")
    assert message in str(refused.value)


def test_a_cell_too_long_for_quotes_is_refused(tmp_path: Path) -> None:
    with pytest.raises(RecordError, match="row 2: is not a row of cells: field larger"):
        read_table_file(_file(tmp_path, f'theta (deg)\n"{"1" * 200_000}"\n'))


def test_the_head_alone_needs_no_rows(tmp_path: Path) -> None:
    head = read_table_head(_file(tmp_path, "\n# made\ntime (s);theta (deg)\n"))
    assert [heading.name for heading in head.headings] == ["time", "theta"]
    assert (head.line, head.delimiter) == (3, ";")


def test_an_option_replaces_an_unknown_unit_and_no_known_one(tmp_path: Path) -> None:
    column = Column("force", UNITS["force"])
    path = _file(tmp_path, "force (Newton),x\n2,1\n3,1\n")
    with pytest.raises(RecordError, match=r"found Newton\); known are N, .* --unit force=UNIT"):
        read_table_file(path).read([column])
    assert read_table_file(path).read([column], units={"force": "N"})["force"].tolist() == [2.0, 3.0]
    for pound in ("lbf", "lb"):
        path = _file(tmp_path, f"force ({pound}),x\n2,1\n3,1\n")
        assert read_table_file(path).read([column])["force"][0] == pytest.approx(8.896443230521, rel=1e-15)
        with pytest.raises(RecordError, match=f"has the unit {pound} in its heading, but N is given"):
            read_table_file(path).read([column], units={"force": "N"})
    path = _file(tmp_path, "force (mm),x\n2,1\n3,1\n")
    with pytest.raises(RecordError, match="unit mm in its heading, but N is given; correct the"):
        read_table_file(path).read([column], units={"force": "N"})


@pytest.mark.parametrize("error", ["#DIV/0!", "#N/A", "#WERT!", "#NAME?", "#NV"])
def test_a_row_that_begins_with_the_error_of_a_spreadsheet_is_no_comment(error: str, tmp_path: Path) -> None:
    file = read_table_file(_file(tmp_path, f"theta (rad),x\n1,2\n#no sample\n{error},3\n"))
    assert file.comments == ("no sample",)
    with pytest.raises(RecordError, match=rf"row 4: is not a number \(found '{re.escape(error)}'\)"):
        file.read([ANGLE])
