"""The program: ``pyjoystick`` or ``python -m pyjoystick``."""

from __future__ import annotations

import signal
import sys
import threading

#: Exit codes after Ctrl-C and after SIGTERM, as of a program that the signal ended.
_INTERRUPTED = 130
_TERMINATED = 143
#: Time (s) until a signal is sent again whose exception could not be raised.
_SOON = 0.01


def main() -> int:
    """Run the command line and return its exit code; Ctrl-C while it loads is no traceback.

    SIGTERM does what Ctrl-C does, also where SIGINT is ignored, as after ``nohup`` or in the background of a
    script: finished results are kept, and temporary folders deleted.
    """
    terminated = False

    def terminate(*_: object) -> None:
        nonlocal terminated
        terminated = True
        raise KeyboardInterrupt

    def not_raised(event: sys.UnraisableHookArgs) -> None:
        """Interrupt again if a callback or destructor, which cannot raise, took the exception."""
        if event.exc_type is KeyboardInterrupt:
            # After this function, in which it would be lost too.
            again = signal.SIGTERM if terminated else signal.SIGINT
            threading.Timer(_SOON, _interrupt_main, [again]).start()
        else:
            sys.__unraisablehook__(event)

    if signal.getsignal(signal.SIGTERM) is signal.SIG_DFL:
        signal.signal(signal.SIGTERM, terminate)
    sys.unraisablehook = not_raised
    try:
        from pyjoystick.cli import main as run

        code = run()
    except KeyboardInterrupt:
        code = _INTERRUPTED
    return _TERMINATED if terminated and code == _INTERRUPTED else code


def _interrupt_main(number: int) -> None:
    if sys.platform == "win32":
        signal.raise_signal(number)
    else:
        signal.pthread_kill(threading.main_thread().ident or 0, number)  # wakes it


if __name__ == "__main__":
    sys.exit(main())
