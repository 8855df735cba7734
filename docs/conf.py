"""Settings of the documentation site: ``make docs`` builds it, and any warning is an error."""

from __future__ import annotations

import importlib
import os
import sys
from importlib import metadata
from pathlib import Path

import pandas as pd

sys.path.insert(0, str(Path(__file__).parent))

# These name pandas in annotations, which autodoc resolves, and load it no sooner than they make a table.
_FMU = ("batch", "cosimulation", "inputs", "linearization", "model_exchange", "plan", "values")
for _module in ("motion.tables", "runs.sweeps.settings", *(f"fmu.{name}" for name in _FMU)):
    vars(importlib.import_module(f"pyjoystick.{_module}"))["pd"] = pd

project = "pyjoystick"
author = "the pyjoystick authors"
version = release = metadata.version("pyjoystick")

extensions = [
    "myst_nb",
    "sphinx.ext.autodoc",
    "sphinx_copybutton",
    "extensions.command_line",
    "extensions.docstrings",
    "extensions.documents",
    "extensions.live_page",
    "extensions.mathml",
    "extensions.modelica_classes",
    "extensions.page_links",
    "extensions.rooms",
]
root_doc = "index"
exclude_patterns = ["_build"]
# Indented blocks are command lines; nothing guesses a language.
highlight_language = "text"
# A name in single backticks, in docstrings, is code.
default_role = "code"
nitpicky = True
# Two dashes begin an option, they are no long dash.
smartquotes = False

# The pages are read on GitHub too: headings have its anchors, formulas its dollars.
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4

# Notebooks run whenever the site is built; one that fails stops the build.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 120
nb_merge_streams = True

autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
python_maximum_signature_line_length = 90
toc_object_entries_show_parents = "hide"
python_use_unqualified_type_names = True
# Aliases keep their names instead of being written out.
autodoc_type_aliases = {
    "ArrayLike": "ArrayLike",
    "FloatArray": "pyjoystick.support.FloatArray",
    "Torque": "pyjoystick.support.Torque",
}
nitpick_ignore = [
    ("py:class", "ArrayLike"),  # of numpy.typing
    # Imported for annotations alone.
    ("py:class", "Figure"),
    ("py:class", "pd.DataFrame"),
    ("py:class", "JoystickWidget"),  # of an optional package; its page describes it
    # Handed from one function to the next, not made by users.
    ("py:class", "pyjoystick.fmu.inputs.InputTable"),
    ("py:class", "pyjoystick.fmu.instance.Instance"),
    ("py:class", "pyjoystick.fmu.library.InstancePool"),
    ("py:class", "pyjoystick.fmu.sandbox.pool.SandboxPool"),
    ("py:class", "pyjoystick.fmu.own_process.pool.ProcessPool"),
    ("py:class", "pyjoystick.fmu.own_process.runner.Outcome"),
    ("py:class", "pyjoystick.fmu.stepping.reducing.Operation"),
    ("py:class", "pyjoystick.fmu.stepwise.RemoteInstance"),
    ("py:class", "FmiVersion"),  # a Literal of fmu_build
    ("py:class", "pyjoystick.runs.sweeps.sweep.Part"),
    ("py:class", "pyjoystick.runs.sweeps.sweep.Task"),
]
# Other projects' lists of names are on the network, which a build does without.
nitpick_ignore_regex = [
    (r"py:.*", r"(collections|matplotlib|numpy|os|pandas|pathlib|xarray)\..*"),
]

html_theme = "furo"
html_title = "pyjoystick"
html_static_path = ["_static"]
html_css_files = ["pyjoystick.css"]
templates_path = ["_templates"]
html_sidebars = {
    "**": [
        "sidebar/brand.html",
        "sidebar/versions.html",
        "sidebar/search.html",
        "sidebar/scroll-start.html",
        "sidebar/navigation.html",
        "sidebar/scroll-end.html",
    ]
}
# A published site has a menu of versions, see versions.py; one that is built to be read here has none.
html_context = {"site_version": os.environ.get("SITE_VERSION", "")}
if html_context["site_version"]:
    html_js_files = [("versions.js", {"defer": "defer"})]
html_show_copyright = False
# Formulas are MathML, figures are SVG, scripts lie beside the pages: they need no network.
html_math_renderer = "mathml"
