"""Write the default run as files for importers to check themselves against.

The three tables have the names and the format required by the FMI cross-check; the manifest lists them as
specified by the layered standard FMI-LS-REF.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from lxml import etree

from fmu_build.packaging.default_run import TOLERANCE, DefaultRun

FOLDER = "extra/org.fmi-standard.fmi-ls-ref"
_NAMESPACE = "http://fmi-standard.org/fmi-ls-manifest"
_VERSION = "1.0.0-alpha.1"
_DESCRIPTION = "Layered Standard providing information on related files included in an FMU."


def reference_files(run: DefaultRun, identifier: str) -> dict[str, bytes]:
    """Return archive name -> content."""
    result, options, inputs = (f"{identifier}{end}" for end in ("_ref.csv", "_ref.opt", "_in.csv"))
    files = {
        result: (_table(["time", *run.outputs], zip(run.time, *run.outputs.values(), strict=True))),
        options: _options(run),
    }
    related = [
        (result, "text/csv", "result", "Outputs of the default experiment"),
        (options, "text/csv", "configuration", "Start, stop, tolerance and interval of that run"),
    ]
    if run.inputs:
        files[inputs] = _table(["time", *run.inputs], _corners(run))
        related.append((inputs, "text/csv", "testcase", "Inputs of that run, straight between rows"))
    files["fmi-ls-manifest.xml"] = _manifest(related)
    return {f"{FOLDER}/{name}": content for name, content in files.items()}


def _corners(run: DefaultRun) -> list[tuple[float, ...]]:
    """Return the steps of the inputs as a piecewise linear table: two rows at the time of a jump."""
    values = list(zip(*run.inputs.values(), strict=True))
    rows = [(run.time[0], *values[0])]
    for time, before, after in zip(run.time[1:], values, values[1:], strict=False):
        if before != after:
            rows += [(time, *before), (time, *after)]
    if rows[-1][0] < run.time[-1]:
        rows.append((run.time[-1], *values[-1]))
    return rows


def _table(names: Sequence[str], rows: Iterable[Sequence[float]]) -> bytes:
    lines = [",".join(f'"{name}"' for name in names)]
    # Ten digits: more than the tolerance justifies, fewer than those in which processors differ.
    lines += [",".join(f"{value + 0.0:.10g}" for value in row) for row in rows]
    return ("\n".join(lines) + "\n").encode()


def _options(run: DefaultRun) -> bytes:
    """Return the options; a step size of zero stands for a variable-step solver."""
    settings = {
        "StartTime": run.time[0],
        "StopTime": run.time[-1],
        "StepSize": 0.0,
        "RelTol": TOLERANCE,
        "OutputIntervalLength": round(run.time[1] - run.time[0], 12),
    }
    return "".join(f"{name}, {value!r}\n" for name, value in settings.items()).encode()


def _manifest(related: Iterable[tuple[str, str, str, str]]) -> bytes:
    root = etree.Element("fmiReferences", nsmap={"fmi-ls": _NAMESPACE})
    for name, value in (
        ("name", FOLDER.rpartition("/")[2]),
        ("version", _VERSION),
        ("description", _DESCRIPTION),
    ):
        root.set(f"{{{_NAMESPACE}}}fmi-ls-{name}", value)
    for source, kind, role, description in related:
        etree.SubElement(root, "Related", type=kind, source=source, role=role, description=description)
    content: bytes = etree.tostring(root, xml_declaration=True, encoding="UTF-8", pretty_print=True)
    return content
