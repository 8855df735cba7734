"""Write documentation/index.html of an FMU."""

from __future__ import annotations

from lxml import html
from lxml.html import builder

from fmu_build.packaging.default_run import TOLERANCE, DefaultRun
from fmu_build.packaging.elements import xml_text
from fmu_build.packaging.reference_results import FOLDER
from fmu_build.support.description import ModelDescription, Variable

_STYLE = """
body { font-family: sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; }
table { border-collapse: collapse; margin-bottom: 2em; }
img { max-width: 100%; }
th, td { border: 1px solid #bbb; padding: 0.25em 0.6em; text-align: left; vertical-align: top; }
"""
_SECTIONS = (("Parameters", "parameter"), ("Inputs", "input"), ("Outputs", "output"))


FIGURE = "default_run.svg"


def index_html(description: ModelDescription, run: DefaultRun | str, generation_tool: str) -> bytes:
    """Return the page: the model, its parameters, inputs, outputs and units, and its default experiment.

    `run` is the run of the default experiment, or the reason why it is missing.
    """
    body = builder.BODY(builder.H1(description.identifier), builder.P(xml_text(description.description)))
    body.extend(_class_documentation(description.documentation))
    for title, causality in _SECTIONS:
        variables = [v for v in description.variables if v.causality == causality]
        if variables:
            body.extend([builder.H2(title), _table(variables)])
    body.extend(_default_experiment(description, run))
    body.append(builder.P(f"Built from the Modelica class {description.model_name} by {generation_tool}."))
    head = builder.HEAD(
        builder.META(charset="utf-8"), builder.TITLE(description.identifier), builder.STYLE(_STYLE)
    )
    page: bytes = html.tostring(
        builder.HTML(head, body, lang="en"), doctype="<!DOCTYPE html>", encoding="utf-8", pretty_print=True
    )
    return page


def _class_documentation(text: str) -> list[html.HtmlElement]:
    """Return the class's own HTML without scripts, styles, images and ``modelica:`` links."""
    if not text.strip():
        return []
    division: html.HtmlElement = html.fragment_fromstring(xml_text(text), create_parent="div")
    for element in list(division.iter("script", "style", "img")):
        element.drop_tree()
    for link in list(division.iter("a")):
        if link.get("href", "").lower().startswith("modelica:"):
            link.drop_tag()
    return [division]


def _default_experiment(description: ModelDescription, run: DefaultRun | str) -> list[html.HtmlElement]:
    experiment = description.default_experiment
    title = builder.H2("Default experiment")
    span = f"From {experiment.start_time:g} s to {experiment.stop_time:g} s"
    if isinstance(run, str):
        return [title, builder.P(xml_text(f"{span}. There is no figure: {run}."))]
    inputs = " with the inputs shown in the figure" if run.inputs else ""
    text = builder.P(f"{span}{inputs}, as Co-Simulation at a tolerance of {TOLERANCE:g}. The values are in ")
    text.append(builder.CODE(FOLDER))
    text[-1].tail = ", for comparison with other runs."
    caption = "Inputs and outputs over time, a panel for each unit" if run.inputs else "Outputs over time"
    return [title, text, builder.IMG(src=FIGURE, alt=caption)]


def _table(variables: list[Variable]) -> html.HtmlElement:
    has_start = any(variable.start is not None for variable in variables)
    titles = ["Name", "Default", "Unit", "Description"] if has_start else ["Name", "Unit", "Description"]
    table = builder.TABLE(builder.TR(*(builder.TH(title) for title in titles)))
    for variable in variables:
        default = [builder.TD(_default(variable))] if has_start else []
        cells = [
            builder.TD(builder.CODE(variable.name)),
            *default,
            builder.TD(variable.unit),
            builder.TD(xml_text(variable.description)),
        ]
        table.append(builder.TR(*cells))
    return table


def _default(variable: Variable) -> str:
    if variable.start is None:
        return ""
    if variable.type == "Boolean":
        return "true" if variable.start else "false"
    if variable.enumeration is not None:
        return variable.enumeration.literals[int(variable.start) - 1][0]
    return f"{variable.start:g}" if variable.type == "Real" else str(int(variable.start))
