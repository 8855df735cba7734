"""Outputs that are strings, arrays, or undefined."""

from __future__ import annotations

import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from pyjoystick.fmu import Fmu
from pyjoystick.support import ParameterError, UnknownVariableError

TIME = (0.0, 0.5, 1.0)


def test_default_outputs_are_recorded_whatever_they_are(echo3: Fmu, loop: str) -> None:
    parameters = {"text": "Größe", "p_Int16": -7}
    series = pd.DataFrame({"text_input": ["early", "late"], "u_Int16": [5, 6]}, index=[0.0, 0.8])
    table = echo3.run(TIME, parameters=parameters, inputs=series)
    assert table["said"].tolist() == ["Größe 0.0", "Größe 1.0", "Größe 3.0"]
    assert table["texts[2]"].tolist() == ["Größe 0.1", "Größe 1.1", "Größe 3.1"]
    assert table["text_again"].tolist() == ["early", "early", "late"]
    assert table[[f"both_Int16[{i}]" for i in (1, 2, 3)]].to_numpy().tolist() == [[-7, 5, -7]] * 2 + [
        [-7, 6, -7]
    ]
    assert table.attrs["left_out"] == ["blob"]
    assert table[["x[1]", "x[2]"]].dtypes.tolist() == [np.float64] * 2
    assert "blob" not in table


def test_texts_of_fmi2(echo2: Fmu, loop: str) -> None:
    table = echo2.run(TIME)
    assert table["said"].tolist() == ["step 0", "step 1", "step 2"]
    assert "left_out" not in table.attrs


def test_a_plan_leaves_texts_out_and_says_so(echo3: Fmu, echo2: Fmu, loop: str) -> None:
    plan = echo3.plan(TIME, varied="p_Int8")
    assert plan.left_out == ("said", "texts", "text_again", "blob")
    assert plan.outputs[2:5] == ("both_Float32[1]", "both_Float32[2]", "both_Float32[3]")
    batch = plan.run_batch([[1], [2]])
    assert batch.values is not None
    assert batch.values[:, -1, plan.outputs.index("both_Int8[3]")].tolist() == [1.0, 2.0]
    assert echo2.plan(TIME).left_out == ("said",)
    assert echo2.plan(TIME, outputs="x").left_out == ()
    assert pickle.loads(pickle.dumps(plan)).outputs == plan.outputs


def test_chosen_elements_in_any_order(echo3: Fmu, loop: str) -> None:
    names = ["both_Int8[3]", "u_again_Int8", "both_UInt8[2]", "both_Int8[2]"]
    settings: dict[str, Any] = {
        "parameters": {"p_Int8": 3, "p_UInt8": 9},
        "inputs": {"u_Int8": 4, "u_UInt8": 8},
    }
    table = echo3.run(TIME, outputs=names, **settings)
    assert list(table) == names
    assert table.iloc[0].tolist() == [3, 4, 8, 4]
    np.testing.assert_array_equal(
        echo3.plan(TIME, outputs=names, **settings).run(), table.to_numpy(np.float64)
    )


@pytest.mark.parametrize(
    ("name", "error", "message"),
    [
        (
            "both_Int8",
            ParameterError,
            r"both_Int8 = an array: must be recorded by its elements: both_Int8\[1\]",
        ),
        ("both_Int8[4]", UnknownVariableError, r"no variable 'both_Int8\[4\]'; did you mean both_Int8"),
        (
            "u_again_Int8[1]",
            UnknownVariableError,
            r"no variable 'u_again_Int8\[1\]'; did you mean u_again_Int8",
        ),
        ("blob", ParameterError, "blob = of type Binary"),
    ],
)
def test_what_cannot_be_recorded(echo3: Fmu, name: str, error: type[Exception], message: str) -> None:
    for take in (echo3.run, echo3.plan):
        with pytest.raises(error, match=message):
            take(TIME, outputs=[name])


def test_a_plan_refuses_text_that_is_asked_for(echo3: Fmu) -> None:
    assert echo3.run(TIME, outputs="said")["said"].tolist() == [" 0.0", " 1.0", " 2.0"]
    plan = echo3.plan(TIME, varied="p_Int8", outputs=["said"])
    for carry_out, values in ((plan.run, [1]), (plan.run_batch, [[1]])):
        with pytest.raises(ParameterError, match=r"outputs = said: must be a number .*Fmu\.run records text"):
            carry_out(values)


def test_texts_that_no_fmu_can_be_given(echo3: Fmu) -> None:
    with pytest.raises(ParameterError, match=r"text = 'a.x00b': must be text without null"):
        echo3.run(TIME, parameters={"text": "a\0b"})
    with pytest.raises(ParameterError, match=r"count = 3: must be left out .*structuralParameter"):
        echo3.run(TIME, parameters={"count": 3})


def test_an_interruption_while_a_text_is_copied_ends_the_run(
    echo3_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No exception finds its way out of a function that C calls."""

    def interrupted(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("pyjoystick.fmu.interface.RowFormat.text", interrupted)
    with Fmu(echo3_path, own_process=False) as fmu, pytest.raises(KeyboardInterrupt):
        fmu.run(TIME, outputs="said")
