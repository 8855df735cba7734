"""Standard output that cannot take what is written to it."""

from __future__ import annotations

import contextlib
import errno
import io
import os
import sys
from collections.abc import Iterator
from typing import Final

#: Errors of a file that takes no more: a full disk, a quota, a limit of its size, one that is not open for
#: writing, and a terminal that was closed.
_NO_ROOM: Final = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EBADF, errno.EIO)


def lost_output(error: OSError) -> str:
    """Say what cannot be written and why; empty if the error has another cause."""
    if error.errno not in _NO_ROOM:
        return ""
    return f"cannot write {error.filename or 'standard output or a temporary file'}: {error.strerror}"


class _Closed(io.TextIOBase):
    """Fails at the first text, as a full disk does."""

    def write(self, text: str) -> int:
        if text:
            raise OSError(errno.EBADF, "it is closed", "standard output")
        return 0


def _write_every_character() -> None:
    """Escape characters that the encoding of standard output lacks, instead of failing."""
    if isinstance(sys.stdout, io.TextIOWrapper) and sys.stdout.errors == "strict":
        sys.stdout.reconfigure(errors="backslashreplace")


@contextlib.contextmanager
def closed_output_fails() -> Iterator[None]:
    """Make writing to a standard output that is closed, as with ``>&-``, an OSError until the body ends.

    Python has no stream there, and what is printed would be lost without an error.
    """
    if getattr(sys, "stdout", None) is not None:
        _write_every_character()
        yield
        return
    # Otherwise the next file would be opened in its place, and get what libraries print.
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # at the lowest number that is free
    with contextlib.redirect_stdout(_Closed()):
        yield
