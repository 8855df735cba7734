"""ZIP archives as someone else wrote them, or as a disk left them."""

from __future__ import annotations

import lzma
import struct
import zipfile
import zlib
from typing import Final

#: Whatever `zipfile` raises for an archive that is damaged, encrypted (RuntimeError) or compressed in a way
#: that it does not know (NotImplementedError).
ARCHIVE_ERRORS: Final = (
    *(zipfile.BadZipFile, zlib.error, lzma.LZMAError, struct.error),
    *(NotImplementedError, RuntimeError, EOFError, OSError, ValueError, IndexError),
)


def archive_problem(error: Exception) -> str:
    """What one of `ARCHIVE_ERRORS` says, in words."""
    if isinstance(error, zipfile.BadZipFile) and "not a zip" in str(error).casefold():
        return "not a ZIP archive"
    said = error.strerror if isinstance(error, OSError) else ""
    return said or str(error) or type(error).__name__
