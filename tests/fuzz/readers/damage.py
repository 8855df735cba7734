"""Damage to files: truncation, typing errors, other exports, disk errors, malice."""

from __future__ import annotations

import io
import re
import struct
import zipfile
from collections.abc import Callable
from random import Random
from typing import Final

Damage = Callable[[bytes, Random], bytes]

#: What takes the place of a number.
_NUMBERS: Final = (
    *(
        "nan",
        "inf",
        "-inf",
        "0",
        "-0.0",
        "1",
        "-1",
        "1e999",
        "-1e308",
        "1e308",
        "1e-320",
        "1E+3",
        "1e12",
        "1,5",
    ),
    *(
        "18446744073709551616",
        "-9223372036854775809",
        "0x10",
        "1_000",
        "true",
        "''",
        "",
        "١٢",
        "1e",
        "9" * 400,
    ),
)
#: What takes the place of anything, or stands between.
_WORDS: Final = (
    *(
        ",",
        ";",
        "\t",
        "\n",
        "\r",
        "\r\n",
        '"',
        "'",
        "#",
        "=",
        "[",
        "]",
        "{",
        "}",
        "<",
        ">",
        "&",
        "\0",
        "\ufeff",
    ),
    *(
        "é",
        "(deg)",
        "(rad)",
        "(ms)",
        "time (s)",
        "../",
        "/",
        "..",
        "e999",
        " " * 50,
        "-" * 50,
        "a.b",
        "\u2028",
    ),
)
_NUMBER: Final = re.compile(r"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
_WORD: Final = re.compile(r"\w+")
_ENCODINGS: Final = ("utf-16", "utf-8-sig", "latin-1", "cp500", "utf-32")
#: Bits of numbers in binary files: infinities, NaN, the largest and the smallest.
_PATTERNS: Final = (
    *(struct.pack("<f", value) for value in (float("inf"), float("nan"), -1.0, 0.0, 3e38, 1e-45)),
    *(struct.pack("<d", value) for value in (float("inf"), float("nan"), 1e308)),
    *(b"\0\0", b"\xff\xff", b"\x80\x00", b"\x00\x80", b"\x7f\xff", b"\xff\x7f", b"\xff" * 8, b"\0" * 8),
)


def damaged(content: bytes, name: str, random: Random) -> bytes:
    """The content of a file of this name after one accident or a few."""
    suffix = name.rpartition(".")[2]
    for _ in range(random.choice((1, 1, 1, 2, 3))):
        content = random.choice(_BY_SUFFIX.get(suffix, _BINARY))(content, random)
    return content


def _cut(content: bytes, random: Random) -> bytes:
    return content[: random.randrange(len(content) + 1)]


def _flip(content: bytes, random: Random) -> bytes:
    changed = bytearray(content)
    for _ in range(random.choice((1, 1, 3, 20))):
        if changed:
            changed[random.randrange(len(changed))] ^= 1 << random.randrange(8)
    return bytes(changed)


def _pattern(content: bytes, random: Random) -> bytes:
    new = random.choice(_PATTERNS)
    # The head of a file says more than the rest of it.
    limit = random.choice((64, 1024, len(content)))
    at = random.randrange(min(limit, len(content)) + 1)
    return content[:at] + new + content[at + len(new) :]


def _piece(content: bytes, random: Random) -> bytes:
    """Drop a stretch, or have it twice."""
    first, last = sorted(random.randrange(len(content) + 1) for _ in range(2))
    last = min(last, first + random.choice((1, 10, 1000, len(content))))
    return content[:first] + content[first:last] * random.choice((0, 0, 2)) + content[last:]


def _text(change: Callable[[str, Random], str]) -> Damage:
    return lambda content, random: change(content.decode("utf-8", "replace"), random).encode()


def _substitute(found: re.Pattern[str], words: tuple[str, ...]) -> Damage:
    def change(text: str, random: Random) -> str:
        matches = list(found.finditer(text))
        if not matches:
            return text
        match = random.choice(matches[: random.choice((20, len(matches)))])
        return text[: match.start()] + random.choice(words) + text[match.end() :]

    return _text(change)


def _insert(text: str, random: Random) -> str:
    at = random.randrange(len(text) + 1)
    return text[:at] + random.choice(_WORDS) + text[at:]


def _lines(text: str, random: Random) -> str:
    """Lose, repeat, exchange, or repeat very often some lines."""
    lines = text.splitlines(keepends=True)
    if len(lines) < 2:
        return text
    at, other = random.randrange(len(lines)), random.randrange(len(lines))
    match random.randrange(5):
        case 0:
            del lines[at : at + random.choice((1, 1, 5, len(lines)))]
        case 1:
            lines.insert(at, lines[other])
        case 2:
            lines[at], lines[other] = lines[other], lines[at]
        case 3:
            lines[at:] = lines[at:][::-1]
        case 4:
            lines[at] = lines[at] * random.choice((2, 50))
    return "".join(lines)


def _encode(content: bytes, random: Random) -> bytes:
    return content.decode("utf-8", "replace").encode(random.choice(_ENCODINGS), "replace")


def _marks(text: str, random: Random) -> str:
    """Another country's or another system's way of writing a table."""
    return random.choice(
        (
            lambda: text.replace(",", ";"),
            lambda: text.replace(",", ";").replace(".", ","),
            lambda: text.replace(".", ","),
            lambda: text.replace(",", "\t"),
            lambda: text.replace(",", " "),
            lambda: text.replace("\n", "\r\n"),
            lambda: text.replace("\n", "\r"),
            lambda: text.replace(",", ', "') + '"',
        )
    )()


def _column(text: str, random: Random) -> str:
    """A column is lost, doubled, exchanged, constant, scaled, negative or of extreme numbers."""
    head = [line for line in text.splitlines() if line.startswith("#")]
    rows = [line.split(",") for line in text.splitlines() if not line.startswith("#")]
    width = min((len(row) for row in rows), default=0)
    if width == 0:
        return text
    at, other = random.randrange(width), random.randrange(width)
    what = random.randrange(8)
    factor = random.choice((1e3, 1e6, 1e9, 1e-3, 1e-6, 1e-300, 1e300, -1.0, 0.0, 57.3))
    constant = random.choice((*_NUMBERS, rows[-1][at]))
    for i, row in enumerate(rows):
        if what == 0:
            del row[at]
        elif what == 1:
            row.insert(at, row[other])
        elif what == 2:
            row[at], row[other] = row[other], row[at]
        elif i and what <= 4:
            row[at] = constant
        elif i and what <= 6 and _NUMBER.fullmatch(row[at]):
            row[at] = repr(float(row[at]) * factor)
        elif i and what == 7:
            row[at] = str(i // 2)
    return "\n".join([*head, *map(",".join, rows), ""])


def _archive(content: bytes, random: Random) -> bytes:
    """Write an archive anew with one of its files damaged, lost, twice, or stored in another way."""
    what = random.randrange(6)
    new = io.BytesIO()
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as old, zipfile.ZipFile(new, "w") as file:
            # The descriptions are what is read.
            described = [name for name in old.namelist() if name.endswith((".xml", ".ssd", ".npy"))]
            chosen = random.choice(random.choice((described, old.namelist())))
            ways = (zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED, zipfile.ZIP_BZIP2, zipfile.ZIP_LZMA)
            for name in old.namelist():
                inside, way = old.read(name), random.choice(ways) if what == 0 else zipfile.ZIP_DEFLATED
                if name == chosen and what == 1:
                    continue
                if name == chosen and what >= 2:
                    inside = damaged(inside, name, random)
                file.writestr(name, inside, way)
    except Exception:  # it is no archive any more
        return content
    return new.getvalue()


def _entry(content: bytes, random: Random) -> bytes:
    """Change a field of an entry in the directory of an archive and before the file: encrypted, unknown."""
    changed = bytearray(content)
    field, size = random.choice(((0, 2), (2, 2), (4, 2), (10, 4), (14, 4), (18, 4), (22, 2), (24, 2)))
    value = random.choice((1, 8, 9, 12, 14, 95, 99, 0xFFFF, 0xFFFFFFFF, random.randrange(1 << 16)))
    for mark, offset in ((b"PK\1\2", 6), (b"PK\3\4", 4)):
        at = content.find(mark)
        while at >= 0:
            end = at + offset + field
            changed[end : end + size] = (value % (1 << 8 * size)).to_bytes(size, "little")
            at = content.find(mark, at + 4) if random.random() < 0.5 else -1
    return bytes(changed)


_BINARY: Final[tuple[Damage, ...]] = (_cut, _flip, _pattern, _pattern, _piece)
_TEXT: Final[tuple[Damage, ...]] = (
    *(_cut, _flip, _piece, _encode, _text(_insert), _text(_insert), _text(_lines), _text(_lines)),
    *(_substitute(_NUMBER, _NUMBERS),) * 6,
    *(_substitute(_WORD, (*_NUMBERS, *_WORDS)),) * 2,
)
_TABLE: Final[tuple[Damage, ...]] = (*_TEXT, _text(_marks), *(_text(_column),) * 5)
_ZIP: Final[tuple[Damage, ...]] = (*_BINARY, _entry, _entry, *(_archive,) * 6)
_BY_SUFFIX: Final[dict[str, tuple[Damage, ...]]] = {
    "csv": _TABLE,
    **dict.fromkeys(("toml", "json", "xml", "ssd", "txt"), _TEXT),
    **dict.fromkeys(("fmu", "ssp", "npz", "xlsx", "ods"), _ZIP),
}
