"""``python -m pyjoystick.runs.coupling FILE.ssp``: writes operator and joystick as an SSP archive."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from pyjoystick.runs.coupling.archive import write_ssp
from pyjoystick.runs.coupling.joystick import operator_and_joystick
from pyjoystick.support import PyJoystickError


def main() -> int:
    """Returns the exit code."""
    parser = argparse.ArgumentParser(
        prog="python -m pyjoystick.runs.coupling", description="Operator and joystick as an SSP archive."
    )
    parser.add_argument("file", type=Path, help="the .ssp file to write")
    parser.add_argument(
        "--ssp-version", choices=["1.0", "2.0"], default="2.0", help="of the SSP standard (%(default)s)"
    )
    settings = parser.parse_args()
    try:
        write_ssp(operator_and_joystick(), settings.file, version=settings.ssp_version)
    except PyJoystickError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    print(settings.file)
    return 0


if __name__ == "__main__":
    sys.exit(main())
