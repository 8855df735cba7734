"""Records of measured motions: reading them from files, and what is refused or flagged in them."""

from pyjoystick.records.errors import RecordError
from pyjoystick.records.free_oscillation import Side, check_free_oscillation
from pyjoystick.records.reading import read_record, read_repeats
from pyjoystick.records.record import Record

__all__ = [
    "Record",
    "RecordError",
    "Side",
    "check_free_oscillation",
    "read_record",
    "read_repeats",
]
