"""``pyjoystick --verbose``: what the package logs, on standard error."""

from __future__ import annotations

import logging
from collections.abc import Iterator
from contextlib import contextmanager

from pyjoystick.cli.console import print_log

_PACKAGE = logging.getLogger("pyjoystick")


class _Printed(logging.Handler):
    """Prints records as lines such as ``pyjoystick.fmu.batch: opened Joystick.fmu``."""

    def emit(self, record: logging.LogRecord) -> None:
        print_log(record.name, record.getMessage())


@contextmanager
def log_shown(*, everything: bool = False) -> Iterator[None]:
    """Show the log while the context is active.

    Args:
        everything: include details that are only useful for debugging
    """
    handler, before = _Printed(), _PACKAGE.level
    _PACKAGE.addHandler(handler)
    _PACKAGE.setLevel(logging.DEBUG if everything else logging.INFO)
    try:
        yield
    finally:
        _PACKAGE.removeHandler(handler)
        _PACKAGE.setLevel(before)
