"""Write the C functions for the directional derivatives of a model."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from fmu_build.codegen.algebraics import NewtonBlock
from fmu_build.codegen.c_function import FunctionBody, c_function
from fmu_build.codegen.expression import Expression, Slot
from fmu_build.codegen.tangents import BlockTangent, Tangent, Tangents

_ARGUMENTS = "double time, const double *y, const double *p, double dtime, double *dy, double *dp"
Body = Callable[[Iterable[Expression]], FunctionBody]


def tangent_functions(
    tangents: Tangents | None,
    names: Mapping[Slot, str],
    block_names: Mapping[NewtonBlock, str],
    body: Body,
    of_parameters: Body,
) -> list[str]:
    """Return the tangent functions in the order of model.h; they are empty without `tangents`.

    The body `of_parameters` reads no variables: the function for computed parameters is not given them.
    """
    t = tangents or Tangents((), (), (), (), (), cover_initialization=False)
    return [
        _parameters(t, names, of_parameters),
        _steps(t, names, block_names, body),
        _starts(t, names, body),
        _initial_residuals(t, body),
    ]


def _parameters(t: Tangents, names: Mapping[Slot, str], body: Body) -> str:
    """Assign each tangent in its own scope, because later ones read what earlier ones have stored."""
    lines: list[str] = []
    for tangent in t.parameters:
        one = body([tangent.value])
        store = _store(tangent, names, one)
        lines += ["{", *(f"    {line}" for line in (*one.lines, store)), "}"] if one.lines else [store]
    return c_function("void model_parameter_tangents(const double *p, double *dp)", lines)


def _starts(t: Tangents, names: Mapping[Slot, str], body: Body) -> str:
    one = body([tangent.value for tangent in t.starts])
    for tangent in t.starts:
        store = _store(tangent, names, one)
        one.lines.append(store)
    signature = "void model_start_tangents(const double *y, const double *p, double *dy, const double *dp)"
    return c_function(signature, one.lines)


def _steps(t: Tangents, names: Mapping[Slot, str], block_names: Mapping[NewtonBlock, str], body: Body) -> str:
    one = body([*(value for step in t.steps for value in step.values), *t.derivatives])
    for step in t.steps:
        if isinstance(step, BlockTangent):
            _solve(step, names, block_names[step.block], one)
        else:
            store = _store(step, names, one)
            one.lines.append(store)
    for number, value in enumerate(t.derivatives):
        text = one.value(value)
        one.lines.append(f"dder[{number}] = {text};")
    one.lines.append("return true;")
    return c_function(f"bool model_tangents({_ARGUMENTS}, double *dder)", one.lines)


def _initial_residuals(t: Tangents, body: Body) -> str:
    one = body(t.initial_residuals)
    for number, value in enumerate(t.initial_residuals):
        text = one.value(value)
        one.lines.append(f"residual[{number}] = {text};")
    constant = _ARGUMENTS.replace("double *dy, double *dp", "const double *dy, const double *dp")
    return c_function(f"void model_initial_residual_tangents({constant}, double *residual)", one.lines)


def _store(tangent: Tangent, names: Mapping[Slot, str], body: FunctionBody) -> str:
    text = body.value(tangent.value)
    return f"d{tangent.slot[0]}[{names[tangent.slot]}] = {text};"


def _solve(step: BlockTangent, names: Mapping[Slot, str], block: str, body: FunctionBody) -> None:
    """Solve for the tangents of an algebraic loop's unknowns, which keep its residuals at zero."""
    texts = [body.value(residual) for residual in step.residuals]
    moves = f"{block}_moves"
    body.lines += [
        f"double {moves}[] = {{{', '.join(texts)}}};",
        f"if (!block_tangents(&{block}, time, y, p, {moves})) return false;",
        *(f"dy[{names['y', unknown]}] = {moves}[{i}];" for i, unknown in enumerate(step.block.unknowns)),
    ]
