"""``python -m pyjoystick``: the command line."""

import sys

from pyjoystick.cli import main

if __name__ == "__main__":
    sys.exit(main())
