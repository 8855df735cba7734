"""The other side of `process`: carry out one request after the other until nobody asks any more.

Requests and answers are pickles that go through what were standard input and output. The FMU is given an
empty input, and what it prints goes to standard error, which the parent reads.
"""

from __future__ import annotations

import os
import pickle
import signal
import sys
import threading
import traceback
from queue import SimpleQueue
from typing import BinaryIO

from pyjoystick.fmu.own_process.service import Service
from pyjoystick.support import PyJoystickError


def main(place_file: str) -> None:
    """Serve.

    Args:
        place_file: the file through which the parent sees where a run is, see `service`
    """
    # Ctrl-C is the parent's affair.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.dup2(2, 1)
    waiting: SimpleQueue[tuple[str, tuple[object, ...]]] = SimpleQueue()
    threading.Thread(target=_read, args=(requests, waiting), daemon=True).start()
    service = Service(place_file)
    while True:
        name, arguments = waiting.get()
        try:
            answer = True, getattr(service, name)(*arguments)
        except BaseException as error:
            if not isinstance(error, PyJoystickError):
                error.add_note("".join(traceback.format_exception(error)))
            answer = False, error
        answers.write(_pickled(answer))
        answers.flush()


def _read(requests: BinaryIO, waiting: SimpleQueue[tuple[str, tuple[object, ...]]]) -> None:
    """Pass requests on; end the process, even during a call of the FMU, once the parent has ended."""
    try:
        while True:
            waiting.put(pickle.load(requests))
    except EOFError:
        os._exit(0)
    except BaseException:
        traceback.print_exc()
        sys.stderr.flush()
        os._exit(1)


def _pickled(answer: tuple[bool, object]) -> bytes:
    try:
        return pickle.dumps(answer, pickle.HIGHEST_PROTOCOL)
    except Exception:
        return pickle.dumps((False, RuntimeError(repr(answer[1]))))
