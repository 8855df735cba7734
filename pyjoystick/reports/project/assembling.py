"""Assembly of a project's steps from its file and the existing files."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from glob import glob
from pathlib import Path
from typing import Final

from pyjoystick import laboratory, model
from pyjoystick.reports.project import concluding, evaluating, measuring, publishing
from pyjoystick.reports.project.laboratory import LABORATORY_FILE, Laboratory, MarkerSource, TableSource
from pyjoystick.reports.project.sources import spring_names
from pyjoystick.reports.project.steps import Find, Missing, Step
from pyjoystick.support import SettingsError

#: Characters that make a file name a pattern.
_WILD: Final = frozenset("*?[")
#: Name of each parameter of the body, and the tables of laboratory.toml that determine it.
_BODY: Final = {
    "m": ("mass", "[parts]"),
    "h": ("center of mass", "[parts]"),
    "J": ("moment of inertia", "[parts], [swing]"),
}


@dataclass(frozen=True, slots=True)
class Assembly:
    """The steps of a project.

    Attributes:
        steps: in a possible order of execution
        missing: steps that are impossible because files or entries of laboratory.toml are missing
        notes: consequences of what is missing, one sentence each
    """

    steps: tuple[Step, ...]
    missing: tuple[Missing, ...]
    notes: tuple[str, ...]


def assemble(lab: Laboratory, find: Find) -> Assembly:
    """Determine the steps of a project.

    Args:
        lab: content of its ``laboratory.toml``
        find: function that returns the file for the name of an FMU

    Raises:
        SettingsError: two motions or two accelerometers have the same name, or an accelerometer refers to an
            unknown motion
    """
    return _Assembler(lab, find).assembly()


class _Assembler:
    def __init__(self, lab: Laboratory, find: Find) -> None:
        self.lab, self.find = lab, find
        self.steps: list[Step] = []
        self.missing: list[Missing] = []
        self.notes: list[str] = []
        #: Files by kind and name.
        self.names: dict[str, dict[str, str]] = {}
        #: Sources of parameters, by FMU name.
        self.sources: dict[str, str] = {}

    def assembly(self) -> Assembly:
        lab = self.lab
        sides = tuple(side for side in model.SIDES if self._curve(side))
        values = [*map(measuring.curve_values, sides), *self._body()]
        names = lab.given.values
        self.sources |= {
            name: lab.given.sources[table]
            for table in lab.given.sources
            for name in names
            if laboratory.PLACES[name].startswith(f"{table}.")
        }
        self.steps.append(measuring.measured(lab, tuple(values), self.sources))
        records = self._records(sides)
        if not self.sources and not records:
            return Assembly((), tuple(self.missing), ())
        self._accelerometers(records)
        self._evaluation(tuple(records.values()), sides)
        if lab.fmus.versions or lab.fmus.modelica or lab.fmus.json:
            self.steps.append(publishing.fmus(lab, with_fit=bool(records)))
        done = {step.name for step in self.steps}
        self.steps.append(
            publishing.report(
                lab,
                self.find,
                sides=sides,
                with_parts="parts" in done,
                with_swing="swing" in done and bool(lab.swing and lab.swing.file),
                with_fit="fit" in done,
                with_budget="error budget" in done,
            )
        )
        return Assembly(tuple(self.steps), tuple(self.missing), tuple(self.notes))

    def _there(self, step: str, file: str) -> bool:
        if (self.lab.root / file).is_file():
            return True
        what = (
            "is a folder"
            if (self.lab.root / file).is_dir()
            else f"does not exist, though {LABORATORY_FILE} names it"
        )
        self.missing.append(Missing(step, f"{file} {what}", named=True))
        return False

    def _curve(self, side: model.Side) -> bool:
        lab = self.lab
        source, name = lab.curves.get(side), f"load curve {side}"
        if source is None:
            self.missing.append(Missing(name, f"{LABORATORY_FILE} has no [load_curve.{side}]"))
        if source is None or not self._there(name, source.file):
            self.notes.append(f"the springs of the {side} side are taken from {self._base()}")
            return False
        self.steps.append(measuring.load_curve(lab, side, source))
        text = f"load-deflection curve {Path(source.file).name}"
        self.sources |= dict.fromkeys(spring_names(lab.base.joystick, side), text)
        if source.friction:
            own = f"hysteresis of {Path(source.file).name}"
            before = self.sources.get("friction.F_c")
            self.sources["friction.F_c"] = f"{before} and of {Path(source.file).name}" if before else own
        return True

    def _body(self) -> Iterator[str]:
        """Add the steps for parts and swing test; yield the files with their values."""
        lab = self.lab
        with_parts = bool(lab.parts) and self._there("parts", lab.parts)
        if with_parts:
            self.steps.append(measuring.parts(lab))
            self.sources |= dict.fromkeys(("m", "h", "J"), f"parts {Path(lab.parts).name}")
            yield measuring.PARTS
        if lab.swing and (not lab.swing.file or self._there("swing", lab.swing.file)):
            self.steps.append(measuring.swing(lab, lab.swing, with_parts=with_parts))
            readings = f"{len(lab.swing.times)} readings"
            self.sources["J"] = f"swing test {Path(lab.swing.file).name or readings}"
            yield measuring.SWING
        self._unmeasured()

    def _unmeasured(self) -> None:
        """Note which parameters of body and geometry are taken from the base joystick."""
        lab = self.lab
        known = {*self.sources, *lab.given.values}
        fitted = bool(lab.markers or lab.tables) and evaluating.frees(lab, "J")
        for name, (what, tables) in _BODY.items():
            if name in known or (name == "J" and fitted):
                continue
            if not lab.parts:
                self.missing.append(
                    Missing(what, f"{LABORATORY_FILE} has neither {tables} nor {name} in [body]")
                )
            self.notes.append(f"the {what} is taken from {self._base()}")
        lengths = [name for name in ("a", "b") if name not in known]
        if lengths:
            self.missing.append(
                Missing("geometry", f"{LABORATORY_FILE} has no {' and no '.join(lengths)} in [geometry]")
            )
            self.notes.append(f"the geometry ({', '.join(lengths)}) is taken from {self._base()}")
        if "pivot_to_top" not in known and lab.base.pivot_to_top is not None:
            handle = "the length of the handle (pivot_to_top), with which the report computes forces,"
            self.notes.append(f"{handle} is taken from {self._base()}")

    def _base(self) -> str:
        return self.lab.base_file or "the paper's joystick"

    def _records(self, sides: tuple[model.Side, ...]) -> dict[str, str]:
        """Add the steps that convert motions to records; return the record files by name."""
        lab = self.lab
        records: dict[str, str] = {}
        sources: list[MarkerSource | TableSource] = [*lab.markers, *lab.tables]
        for file, source in ((file, one) for one in sources for file in self._files(one.files)):
            name = self._named("motion", file)
            if not self._there(f"record {name}", file):
                continue
            if isinstance(source, MarkerSource):
                curve = source.setup.rests in sides
                self.steps.append(measuring.markers(lab, source, file, with_curve=curve))
            else:
                self.steps.append(measuring.table(lab, source, file))
            records[name] = measuring.record_file(file)
        if not sources:
            self.missing.append(
                Missing("records", f"{LABORATORY_FILE} has neither [[markers]] nor [[record]]")
            )
        return records

    def _named(self, kind: str, file: str) -> str:
        """Return the name for a file's content, which must be unique even if a file system ignores case."""
        name, known = Path(file).stem, self.names.setdefault(kind, {})
        if name.casefold() in map(str.casefold, known):
            reason = f"two files have this name, {', '.join(known.values())} and {file}: rename one"
            raise SettingsError(self.lab.path, "", f"{kind} {name}", None, reason)
        known[name] = file
        return name

    def _files(self, patterns: tuple[str, ...]) -> Iterator[str]:
        """Return the files for names and patterns, each once; note patterns without a match as missing."""
        found: dict[str, None] = {}
        for pattern in patterns:
            if not _WILD & set(pattern):
                found[pattern] = None
                continue
            root = self.lab.root
            # Path.glob does not accept absolute patterns.
            names = sorted(glob(pattern, root_dir=root, recursive=True))  # noqa: PTH207
            matches = [Path(name).as_posix() for name in names if (root / name).is_file()]
            if not matches:
                self.missing.append(Missing("records", f"no file matches {pattern}"))
            found |= dict.fromkeys(matches)
        return iter(found)

    def _accelerometers(self, records: dict[str, str]) -> None:
        lab = self.lab
        for source in lab.accelerometers:
            name = f"accelerometer {self._named('accelerometer', source.file)}"
            motions = self.names.get("motion", {})
            if source.record not in motions:
                reason = f"must be the name of a motion: {', '.join(motions) or 'there is none'}"
                raise SettingsError(lab.path, "accelerometer", "record", source.record, reason)
            if not self._there(name, source.file):
                continue
            if source.record in records:
                self.steps.append(measuring.accelerometer(lab, source, records[source.record]))
            else:
                self.missing.append(Missing(name, f"the record {source.record} is missing", named=True))

    def _evaluation(self, records: tuple[str, ...], sides: tuple[model.Side, ...]) -> None:
        """Add the steps for peaks, fit, error budget and the resulting joystick."""
        lab, standard = self.lab, not self.lab.fit.file
        with_fit = bool(records)
        with_budget = with_fit and standard and lab.fit.law == "constant" and not lab.fit.known
        if with_fit and standard:
            known = {*self.sources, *lab.given.values}
            inertia_known = "J" in known or bool(lab.base_file)
            self.steps.append(evaluating.peaks(lab, records, self.find, inertia_known=inertia_known))
        if with_fit:
            self.steps.append(evaluating.fit(lab, records, self.sources, self.find))
        else:
            self.missing.append(Missing("fit", "there are no records"))
            self.notes.append(f"the damping is taken from {self._base()}")
        if with_budget:
            self.steps.append(evaluating.budget(lab, records, sides, self.find))
        self.steps.append(concluding.joystick(lab, self.sources, with_fit=with_fit, with_budget=with_budget))
