"""Rewrite functions of the Modelica Standard Library that rumoca cannot compile as written."""

from __future__ import annotations

import re

from fmu_build.codegen.modelica_source.text import blanked

_NAMES = "sin|cos|tan|asin|acos|atan|atan2|sinh|cosh|tanh|exp|log|log10"
_EXTERNAL = re.compile(
    rf'\bexternal\s*"builtin"\s*(?P<result>\w+)\s*=\s*(?P<call>(?:{_NAMES})\s*\([\w\s,]*\))\s*;'
    r"(?P<annotation>\s*annotation\s*\()(?P<others>(?!\s*\)))?"
)
_INTERPOLATE = re.compile(
    r"(?P<head>\bfunction\s+interpolate\b.*?)(?P<index>\boutput\s+Integer\s+iNew\b[^;]*;\s*)"
    r"protected\b.*?\balgorithm\b.*?\biNew\s*:=\s*i\s*;\s*end\s+if\s*;(?=\s*annotation\b)",
    re.DOTALL,
)
_INTERPOLATION = (
    "protected Integer i; Integer j; Real d; algorithm "
    "i := 1 + sum(if xi >= x[k] then 1 else 0 for k in 2:size(x, 1) - 1); "
    "j := min(i + 1, size(x, 1)); d := if j > i then x[j] - x[i] else 1; "
    "yi := y[i] + (y[j] - y[i])*(xi - x[i])/d;"
)
"""`Modelica.Math.Vectors.interpolate` without its while loops, which search in both directions from iLast.
For a vector that is not increasing, a division by zero gives NaN instead of a failed assertion.
"""
_INDEX_TAKEN = re.compile(
    r"(?:;|\b(?:algorithm|equation|then|else|loop))\s*\([^;()]*,[^;()]*\)\s*:?=\s*[\w.]*\binterpolate\s*\("
)

_SEARCH = re.compile(
    r"(?P<head>\bfor\s+\w+\s+in)\s+1\s*:(?P<last>[^;:]*?)(?P<loop>\bloop\s+if\b"
    r"(?P<condition>[^;]*)\bthen\s+(?P<result>\w+)\s*:=(?P<value>[^;]*);)(?P<space>\s*)return\s*;"
    r"(?P<end>\s*end\s+if\s*;\s*end\s+for\s*;\s*(?:annotation|end)\b)"
)


def takes_index(text: str) -> bool:
    """Return whether a text uses the second result, the index, of an `interpolate` function."""
    return _INDEX_TAKEN.search(blanked(text)) is not None


def with_known_functions(text: str, *, index: bool = True) -> str:
    """Return the text with these functions rewritten; line numbers do not change.

    An algorithm calls the built-in function in place of ``external "builtin" y = sin(u)``. A loop that
    returns at the first element that fulfills a condition becomes a backward loop without return. Without
    `index`, `interpolate` has one result, because rumoca cannot evaluate parameters by functions with
    several.
    """
    text = _INTERPOLATE.sub(_interpolation if index else _interpolation_alone, _EXTERNAL.sub(_built_in, text))
    return _SEARCH.sub(_backwards, text)


def _built_in(found: re.Match[str]) -> str:
    separator = "" if found["others"] is None else ", "
    return f"algorithm {found['result']} := {found['call']};{found['annotation']}Inline = true{separator}"


def _backwards(found: re.Match[str]) -> str:
    if re.search(rf"\b{found['result']}\b", found["condition"] + found["value"]):
        return found[0]  # The result of an iteration depends on earlier iterations.
    return f"{found['head']} {found['last'].strip()}:-1:1 {found['loop']}{found['space']}{found['end']}"


def _interpolation(found: re.Match[str]) -> str:
    lines = found[0].count("\n") - found["head"].count("\n") - found["index"].count("\n")
    return f"{found['head']}{found['index']}{_INTERPOLATION} iNew := i;" + "\n" * lines


def _interpolation_alone(found: re.Match[str]) -> str:
    lines = found[0].count("\n") - found["head"].count("\n")
    return found["head"] + _INTERPOLATION + "\n" * lines
