"""Choice of the loop: compiled, or plain if Numba is not installed."""

from __future__ import annotations

import logging
import os
import threading
from collections.abc import Callable, Sequence
from functools import partial
from importlib.util import find_spec
from typing import Any, Final

import numpy as np

from pyjoystick.fmu.stepping.kernel import run_many
from pyjoystick.fmu.stepping.program import GROUP, PLACE_SIZE, Group, Program, Workspace
from pyjoystick.fmu.stepping.reducing import OPERATION, Operation
from pyjoystick.support import FloatArray

_LOG = logging.getLogger(__name__)

#: Signature of `kernel.run_many` from the argument `workspace` on.
Loop = Callable[..., int]

#: If this environment variable is set (to anything), runs use the plain loop.
PLAIN_LOOP_VARIABLE: Final = "PYJOYSTICK_PLAIN_LOOP"

_lock = threading.Lock()
_compiled: Callable[..., int] | None = None


def has_compiled_loop() -> bool:
    """Whether Numba is installed and not disabled by `PLAIN_LOOP_VARIABLE`."""
    return not os.environ.get(PLAIN_LOOP_VARIABLE) and find_spec("numba") is not None


def loop(
    program: Program, operations: Sequence[Operation], instants: FloatArray, *, load_compiler: bool
) -> Loop:
    """Choose the loop for runs of a program.

    Args:
        program: what the runs share
        operations: what to keep of each run
        instants: sample times (s), shape (samples,)
        load_compiler: load Numba if it is not loaded yet, which takes longer than a few plain runs
    """
    if not has_compiled_loop() or (_compiled is None and not load_compiler):
        # Python indexes lists several times as fast as arrays.
        lists = {name: getattr(program, name).tolist() for name in ("times", "recorded", "changed")}
        return partial(run_many, program._replace(**lists), operations, instants)
    arrays = program._replace(
        functions=np.array(program.functions, dtype=np.intp),
        columns=np.array(program.columns, dtype=np.intp),
        constants=_as_array(program.constants),
        varied=_as_array(program.varied),
        inputs=_as_array(program.inputs),
        outputs=_as_array(program.outputs),
    )
    shared = (arrays, np.array(list(operations), OPERATION), instants)
    return partial(_compiled_for(shared), *shared)


def _as_array(groups: Sequence[Group]) -> Any:
    return np.array(list(groups), GROUP)


def _compiled_for(shared: tuple[object, ...]) -> Callable[..., int]:
    """The compiled loop, loaded once per process."""
    global _compiled
    with _lock:
        if _compiled is None:
            from pyjoystick.fmu.stepping.compiled import compiled

            _LOG.info("loading the compiled loop")
            octets, flags = np.zeros(8, np.uint8), np.zeros(1, np.bool_)
            workspace = Workspace(0, np.zeros(PLACE_SIZE, np.intp), octets, 0, octets, 0)
            tables = (np.zeros((1, 1, 1)), np.zeros((1, 1)), flags, flags)
            _compiled = compiled((*shared, workspace, True, 0, 0, 0, *tables))
        return _compiled
