"""ZIP archives from elsewhere, which may be damaged."""

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
    """Text for one of the `ARCHIVE_ERRORS`."""
    if isinstance(error, zipfile.BadZipFile) and "not a zip" in str(error).casefold():
        return "not a ZIP archive"
    said = error.strerror if isinstance(error, OSError) else ""
    return said or str(error) or type(error).__name__
