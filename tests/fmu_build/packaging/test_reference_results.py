"""The files with the reference results."""

from __future__ import annotations

from lxml import etree

from fmu_build.packaging.default_run import DefaultRun
from fmu_build.packaging.reference_results import FOLDER, reference_files

_RUN = DefaultRun(
    time=(0.0, 0.1, 0.2, 0.3),
    inputs={"F": (1.0, 1.0, 0.0, 0.0), "G": (2.0, 2.0, 2.0, 2.0)},
    outputs={"x": (-0.0, 1.0 / 3.0, 1e-20, -2.5e10)},
)


def test_outputs_with_ten_digits() -> None:
    table = reference_files(_RUN, "M")[f"{FOLDER}/M_ref.csv"].decode()
    assert table == '"time","x"\n0,0\n0.1,0.3333333333\n0.2,1e-20\n0.3,-2.5e+10\n'


def test_steps_of_inputs_are_straight_lines() -> None:
    table = reference_files(_RUN, "M")[f"{FOLDER}/M_in.csv"].decode()
    assert table == '"time","F","G"\n0,1,2\n0.2,1,2\n0.2,0,2\n0.3,0,2\n'


def test_a_step_at_the_end() -> None:
    run = DefaultRun((0.0, 1.0), {"F": (1.0, 0.0)}, {"x": (0.0, 0.0)})
    assert reference_files(run, "M")[f"{FOLDER}/M_in.csv"].decode() == '"time","F"\n0,1\n1,1\n1,0\n'


def test_options() -> None:
    options = reference_files(_RUN, "M")[f"{FOLDER}/M_ref.opt"].decode()
    assert options == (
        "StartTime, 0.0\nStopTime, 0.3\nStepSize, 0.0\nRelTol, 1e-10\nOutputIntervalLength, 0.1\n"
    )


def test_a_model_without_inputs_has_no_table_of_them() -> None:
    files = reference_files(DefaultRun((0.0, 1.0), {}, {"x": (0.0, 1.0)}), "M")
    manifest = etree.fromstring(files[f"{FOLDER}/fmi-ls-manifest.xml"])
    assert [entry.get("source") for entry in manifest] == ["M_ref.csv", "M_ref.opt"]
    assert f"{FOLDER}/M_in.csv" not in files
