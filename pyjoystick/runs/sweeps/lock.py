"""A lock on an open file that the system lets go when its process ends, however that ends."""

from __future__ import annotations

import sys
from typing import IO, Any

if sys.platform == "win32":
    import msvcrt

    def locked(file: IO[Any]) -> bool:
        """Lock a file that is open for writing, until it is closed; False where another process has it."""
        try:
            # The first byte stands for the file; it need not be there.
            msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)
        except OSError:
            return False
        return True

else:
    import fcntl

    def locked(file: IO[Any]) -> bool:
        """Lock a file that is open for writing, until it is closed; False where another process has it."""
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
        return True
