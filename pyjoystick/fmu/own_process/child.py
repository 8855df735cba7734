"""Child side of `process`: execute requests one after the other until there are no more.

Requests and answers are pickles sent through the former standard input and output. The FMU gets an
empty input, and its output goes to standard error, which the parent reads.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import signal
import sys
import threading
import traceback
from queue import SimpleQueue
from typing import BinaryIO

from pyjoystick.fmu.own_process.process import NEW_REQUEST
from pyjoystick.fmu.own_process.service import Service
from pyjoystick.support import PyJoystickError


def main(place_file: str) -> None:
    """Serve requests.

    Args:
        place_file: file through which the parent monitors the progress of a run, see `service`
    """
    # The parent handles Ctrl-C.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    requests, answers = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    os.dup2(2, 1)
    messages = os.dup(2)  # an FMU may close its own, or send it elsewhere
    waiting: SimpleQueue[tuple[str, tuple[object, ...]]] = SimpleQueue()
    threading.Thread(target=_read, args=(requests, waiting), daemon=True).start()
    service = Service(place_file)
    while True:
        name, arguments = waiting.get()
        with contextlib.suppress(OSError):
            os.write(messages, NEW_REQUEST)
        try:
            answer = True, getattr(service, name)(*arguments)
        except BaseException as error:
            if not isinstance(error, PyJoystickError):
                error.add_note("".join(traceback.format_exception(error)))
            answer = False, error
        answers.write(_pickled(answer))
        answers.flush()


def _read(requests: BinaryIO, waiting: SimpleQueue[tuple[str, tuple[object, ...]]]) -> None:
    """Pass requests on; exit, even during a call of the FMU, when the parent has exited."""
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
