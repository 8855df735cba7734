"""The program: ``pyjoystick`` or ``python -m pyjoystick``."""

import sys

#: Exit code after Ctrl-C, as of a program that the signal ended.
_INTERRUPTED = 130


def main() -> int:
    """Run the command line and return its exit code; Ctrl-C while it loads is no traceback."""
    try:
        from pyjoystick.cli import main as run
    except KeyboardInterrupt:
        return _INTERRUPTED
    return run()


if __name__ == "__main__":
    sys.exit(main())
