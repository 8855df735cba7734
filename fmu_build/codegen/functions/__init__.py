"""Translate Modelica functions to C functions."""

from fmu_build.codegen.functions.library import FunctionLibrary, FunctionSources
from fmu_build.codegen.functions.signature import FunctionSignature

__all__ = ["FunctionLibrary", "FunctionSignature", "FunctionSources"]
