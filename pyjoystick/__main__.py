"""The program: ``pyjoystick`` or ``python -m pyjoystick``."""

import signal
import sys

#: Exit codes after Ctrl-C and after SIGTERM, as of a program that the signal ended.
_INTERRUPTED = 130
_TERMINATED = 143


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

    if signal.getsignal(signal.SIGTERM) is signal.SIG_DFL:
        signal.signal(signal.SIGTERM, terminate)
    try:
        from pyjoystick.cli import main as run

        code = run()
    except KeyboardInterrupt:
        code = _INTERRUPTED
    return _TERMINATED if terminated and code == _INTERRUPTED else code


if __name__ == "__main__":
    sys.exit(main())
