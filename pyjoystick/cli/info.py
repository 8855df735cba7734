"""``pyjoystick info``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import typer
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from pyjoystick import fmu
from pyjoystick.cli import options
from pyjoystick.cli.console import output, write_json
from pyjoystick.cli.fmus import found_or_built
from pyjoystick.support import check_outputs

_GROUPS: Final = (
    ("input", "Inputs"),
    ("output", "Outputs"),
    ("parameter", "Parameters"),
    ("calculatedParameter", "Calculated parameters"),
    ("structuralParameter", "Structural parameters"),
    ("local", "Local variables"),
)
#: How the characters that would break a row of a table are shown.
_IN_ONE_LINE: Final = str.maketrans({"\n": r"\n", "\r": r"\r", "\t": r"\t"})
EXAMPLES = """
Examples:

    pyjoystick info Joystick
    pyjoystick info path/to/other.fmu --all
    pyjoystick info Joystick --json - | jq '.variables[] | select(.causality == "input")'
"""


def run(
    name: Annotated[
        str,
        typer.Argument(
            metavar="FMU",
            help=f"Path of any .fmu file, or one of {', '.join(fmu.MODELS)}.",
        ),
    ],
    everything: Annotated[bool, typer.Option("--all", help="Also show local variables.")] = False,
    json: Annotated[Path | None, options.json("the description and all variables")] = None,
) -> None:
    """Show the model, interfaces, platforms and variables of an FMU, without running it."""
    description = fmu.read_description(found_or_built(name))
    check_outputs(json)
    console = output()
    _print_facts(console, description)
    for causality, title in _GROUPS:
        names = description.names(causality)
        if causality == "local" and not everything:
            console.print(f"\n{len(names)} local variables (--all shows them)")
        elif names:
            console.print(f"\n[bold]{title}[/bold]")
            console.print(_variables([description.variables[name] for name in names]))
    write_json(json, lambda notes: fmu.description_json(description, notes))


def _print_facts(console: Console, description: fmu.FmuDescription) -> None:
    facts = {
        "file": str(description.path),
        "model": description.model_name,
        "about": description.description,
        "FMI": f"{description.fmi_version}, {' and '.join(description.interfaces) or 'no known interface'}",
        "platforms": ", ".join(description.platforms) or "no binary",
        "sources": "included" if description.has_sources else "not included",
        "runs": _way_to_run(description),
        "made by": " ".join(filter(None, (description.generation_tool, description.generation_date))),
        "GUID": description.guid,
        "experiment": _experiment(description.experiment),
    }
    table = Table.grid(padding=(0, 2))
    for name, fact in facts.items():
        if fact:
            table.add_row(f"[dim]{name}[/dim]", escape(fact))
    console.print(table)


def _way_to_run(description: fmu.FmuDescription) -> str:
    if description.is_ours:
        return "in this process; an instance is reset between runs"
    if description.one_instance:
        return "each in a new process, as the FMU allows one instance per process"
    return "in a separate process, as another tool made it; each on a new instance"


def _experiment(experiment: fmu.DefaultExperiment) -> str:
    parts = (
        ("from", experiment.start_time, "s"),
        ("to", experiment.stop_time, "s"),
        ("step", experiment.step_size, "s"),
        ("tolerance", experiment.tolerance, ""),
    )
    return ", ".join(f"{name} {value:g} {unit}".rstrip() for name, value, unit in parts if value is not None)


def _variables(variables: list[fmu.Variable]) -> Table:
    table = Table("name", "unit", "start", "range", "description", box=None, padding=(0, 2, 0, 0))
    table.columns[0].no_wrap = True
    table.columns[2].justify = "right"
    table.columns[3].max_width = 10
    for variable in variables:
        unit = variable.unit if variable.type == "Real" or variable.unit else variable.type
        start = (variable.start or "").translate(_IN_ONE_LINE)
        texts = (variable.name, unit, start, _range(variable), variable.description)
        table.add_row(*map(escape, texts))
    return table


def _range(variable: fmu.Variable) -> str:
    low, high = variable.minimum, variable.maximum
    if variable.must_be_positive and high is None:
        return "> 0"
    if low is not None and high is not None:
        return f"{low:g} to {high:g}"
    if low is not None:
        return f">= {low:g}"
    return "" if high is None else f"<= {high:g}"
