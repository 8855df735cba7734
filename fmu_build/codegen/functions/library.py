"""The C functions that a model calls: found by call site, each written once, callees first."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from fmu_build.codegen.functions.body import write_function
from fmu_build.codegen.functions.calls import CallSites, shapes
from fmu_build.codegen.functions.definitions import assertions
from fmu_build.codegen.functions.signature import FunctionSignature
from fmu_build.codegen.functions.subscripts import HELPERS
from fmu_build.codegen.lowered import LoweredModel


@dataclass(frozen=True, slots=True)
class FunctionSources:
    """The Modelica functions of a model in C, and their signatures."""

    source: str = ""
    signatures: Mapping[str, FunctionSignature] = field(default_factory=dict)
    """Signatures by C name, of the functions and of those that compute the tangents of their results."""
    tangents: Mapping[str, str] = field(default_factory=dict)
    """Source of each function that computes tangents, by C name, callees first."""

    def tangents_for(self, code: str) -> list[str]:
        """Return the sources of the tangent functions that `code` calls, directly or through others."""
        kept: list[str] = []
        for name, source in reversed([*self.tangents.items()]):
            if any(re.search(rf"\b{name}\(", text) for text in (code, *kept)):
                kept.insert(0, source)
        return kept


class FunctionLibrary:
    """The functions that the equations of one model call."""

    def __init__(self, model: LoweredModel) -> None:
        self._model = model
        self._functions = {function["id"]: function for function in model.dae["functions"]}
        self._types = [entry["value_type"] for entry in model.dae["value_types"]]
        self._call_sites = CallSites(model)
        self._signatures: dict[int, FunctionSignature] = {}
        self._sources: dict[int, str] = {}
        self._tangents: dict[str, str] = {}

    def name_of(self, site: Mapping[str, Any], span: dict[str, int] | None) -> str:
        """Return the C function for a call site of the Solve IR in an equation at `span`.

        Raises `UnsupportedModelError` if the function cannot be identified or translated.
        """
        number = self._call_sites.function_of(site, span)
        signature = self.signature(number)
        results = sum(output["value_type"]["scalar_count"] for output in site["outputs"])
        if results != signature.n_results:
            name = self._functions[number]["name"]
            raise self._model.unsupported(
                f"function {name} is not supported: functions that it calls have assertions", span
            )
        return signature.name

    def signature(self, function: int) -> FunctionSignature:
        """Return the signature of a function; the first call writes its source and those of its callees."""
        if function not in self._signatures:
            declared = self._functions[function]
            if declared["external"] is not None:
                span = declared["declaration"]["span"]
                raise self._model.unsupported(
                    f"the external function {declared['name']} is not supported", span
                )
            self._signatures[function] = self._signature(function)
            signature = self._signatures[function]
            self._sources[function] = write_function(self._model, declared, signature, self)
            self._tangents[signature.tangent.name] = write_function(
                self._model, declared, signature.tangent, self, is_tangent=True
            )
        elif function not in self._sources:
            span = self._functions[function]["declaration"]["span"]
            raise self._model.unsupported(
                f"the recursive function {self._functions[function]['name']} is not supported", span
            )
        return self._signatures[function]

    def _signature(self, function: int) -> FunctionSignature:
        declared = self._functions[function]
        inputs = [self._types[parameter["value_type"]]["dimensions"] for parameter in declared["parameters"]]
        kinds = [self._types[kind]["scalar"] for kind in declared["result_types"]]
        results = [shape for kind in declared["result_types"] for shape in shapes(self._types, kind)]
        n_assertions = assertions(declared)
        return FunctionSignature(
            name=self._name(declared["name"]),
            inputs=tuple(math.prod(dimensions) if dimensions else None for dimensions in inputs),
            n_results=sum(math.prod(dimensions) for dimensions in results) + n_assertions,
            returns_value=results == [()] and kinds != ["record"] and not n_assertions,
        )

    def _name(self, modelica_name: str) -> str:
        """Return ``f_`` and the Modelica name, made unique: rumoca has one function per argument size."""
        base = "f_" + re.sub(r"\W+", "_", modelica_name).strip("_")
        taken = {signature.name for signature in self._signatures.values()}
        candidate, number = base, 2
        while candidate in taken:
            candidate, number = f"{base}_{number}", number + 1
        return candidate

    def sources(self) -> FunctionSources:
        """Return the C source of the functions named by `name_of` and of their callees, callees first."""
        source = "\n".join(self._sources.values())
        helpers = [text for name, text in HELPERS.items() if re.search(rf"\b{name}\(", source)]
        called = [self._signatures[number] for number in self._sources]
        signatures = {each.name: each for own in called for each in (own, own.tangent)}
        text = "\n".join([*helpers, source]) if source else ""
        return FunctionSources(text, signatures, self._tangents)
