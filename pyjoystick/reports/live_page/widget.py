"""The live page as a notebook widget. Requires anywidget, see `explore`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import anywidget
import numpy as np
import pandas as pd
import traitlets

from pyjoystick.model import FRICTION_NAMES, JoystickParameters
from pyjoystick.motion import Quantity, make_table
from pyjoystick.support import UnknownParameterError, finite

_SCRIPT: Final = Path(__file__).with_name("assets") / "notebook.js"


class JoystickWidget(anywidget.AnyWidget):
    """A live joystick in the output of a cell; made by `explore`.

    All traits can be observed (``widget.observe(function, "results")``) and follow the page within a fifth
    of a second.

    Attributes:
        values: value (SI units) of each parameter, start value and input by FMU name, as on the page.
            Assigning changes the page; omitted names keep their values. Raises
            `UnknownParameterError` for another name, `ParameterError` for anything but a finite number.
        results: the run shown on the page, as a table over time like those of `free_oscillation`, with the
            variables of its plots; empty until the page is shown. Read-only.
        message: the page's message about values that the model rejects or a failed run; else empty.
            Read-only.
    """

    _esm = _SCRIPT.read_text("utf-8")
    _page = traitlets.Unicode().tag(sync=True)
    _start = traitlets.Dict().tag(sync=True)
    _names = traitlets.List(traitlets.Unicode()).tag(sync=True)
    # Jupyter gives a memoryview.
    _table = traitlets.Bytes().tag(sync=True, from_json=lambda table, _: bytes(table))
    height = traitlets.Int().tag(sync=True)
    values = traitlets.Dict().tag(sync=True)
    message = traitlets.Unicode(read_only=True).tag(sync=True)
    results = traitlets.Instance(pd.DataFrame, read_only=True)

    def __init__(
        self,
        page: str,
        joystick: JoystickParameters,
        values: Mapping[str, float],
        quantities: Sequence[Quantity],
        height: int,
    ) -> None:
        self._joystick, self._quantities = joystick, {one.name: one for one in quantities}
        super().__init__(_page=page, _start=dict(values), values=dict(values), height=height)
        self.set_trait("results", make_table([], {}, []))

    @property
    def joystick(self) -> JoystickParameters:
        """The joystick with the values of the page.

        Raises:
            ParameterError: a value is impossible for a joystick
        """
        names = {*self._joystick.to_names(), *FRICTION_NAMES}
        return self._joystick.replace({name: self.values[name] for name in names})

    @traitlets.validate("values")
    def _check(self, proposal: Mapping[str, Any]) -> dict[str, float]:
        given = {}
        for name, value in proposal["value"].items():
            if name not in self._start:
                raise UnknownParameterError(name, self._start)
            given[name] = finite(name, value)
        return {**self._start, **self.values, **given}

    @traitlets.observe("_table")
    def _received(self, change: object) -> None:
        columns = np.frombuffer(self._table, "<f8").reshape(len(self._names), -1)
        table = dict(zip(self._names, columns, strict=True))
        time = table.pop("time")
        self.set_trait("results", make_table(time, table, [self._quantities[name] for name in table]))
