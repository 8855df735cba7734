"""One trial: damage a file, let a program read it, and judge the outcome."""

from __future__ import annotations

import contextlib
import io
import resource
import shutil
import tempfile
import traceback
import warnings
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Final

from pyjoystick.support import PyJoystickError
from tests.fuzz.readers.damage import damaged
from tests.fuzz.readers.patience import HangError, Patience
from tests.fuzz.readers.subjects import SUBJECTS, CommandError, InterruptedCommandError, Subject

#: More time of the processor than any of them takes with a file that is whole (s).
PATIENCE: Final = 20.0
#: What a trial may need more than all before it (bytes).
MEMORY: Final = 1 << 29


@dataclass(frozen=True)
class Fault:
    """A trial that ended as none may.

    Attributes:
        case: its number
        subject: what was done
        file: what was damaged
        what: how it ended
    """

    case: int
    subject: str
    file: str
    what: str


def trial(case: int, corpus: Path, keep: Path | None = None) -> Fault | None:
    """Carry out the trial of this number.

    Args:
        case: its number; the same gives the same damage
        corpus: see `corpus.make`
        keep: receives the files of a trial with a fault
    """
    random = Random(case)
    subject = random.choice(SUBJECTS)
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as name:
        folder = Path(name)
        file = _copied(subject, corpus, folder, random)
        content = damaged(file.read_bytes(), file.name, random)
        file.write_bytes(content)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        what = _judged(subject, folder)
        grown = (resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before) * 1024
        if what is None and grown > MEMORY:
            what = f"needed {grown / 1e9:.1f} GB"
        if what is None:
            return None
        if keep is not None:
            shutil.rmtree(keep / str(case), ignore_errors=True)
            (keep / str(case)).mkdir(parents=True)
            (keep / str(case) / file.name).write_bytes(content)
        return Fault(case, subject.name, file.relative_to(folder).as_posix(), what)


def _copied(subject: Subject, corpus: Path, folder: Path, random: Random) -> Path:
    """Copy what a subject needs; returns the file that is to be damaged."""
    chosen = random.choice(sorted(corpus.glob(subject.damaged)))
    for one in {*subject.others, chosen.relative_to(corpus).parts[0]}:
        if (corpus / one).is_dir():
            shutil.copytree(corpus / one, folder / one)
        else:
            shutil.copy(corpus / one, folder / one)
    return folder / chosen.relative_to(corpus)


def _judged(subject: Subject, folder: Path) -> str | None:
    """How it ended, if it may not."""
    said, patience = io.StringIO(), Patience()
    try:
        with contextlib.chdir(folder), patience.limited(PATIENCE), warnings.catch_warnings():
            warnings.simplefilter("error")
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(said):
                subject.drive()
    except PyJoystickError as error:
        said.write(str(error))
    except HangError as hang:
        return f"did not end within {PATIENCE:g} s\n" + "".join(traceback.format_exception(hang)[-6:])
    except (CommandError, KeyboardInterrupt, Exception) as error:
        if patience.interrupted and isinstance(error, (InterruptedCommandError, KeyboardInterrupt)):
            return None
        return "".join(traceback.format_exception(error)[-4:])
    text = said.getvalue()
    if "internal error" in text or "Traceback" in text or "Warning" in text:
        return text
    return None
