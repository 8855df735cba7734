"""Errors of a build. Each message names the file, model or value at fault, and what is allowed."""

from __future__ import annotations


class BuildError(Exception):
    """Base class: an FMU could not be built. No file is left half-written."""


class UnknownCompilerError(BuildError):
    """No backend has the requested name."""


class ModelNotFoundError(BuildError):
    """The Modelica class or file does not exist."""


class ModelicaError(BuildError):
    """The Modelica source has an error; the message gives file, line and column if known."""


class UnsupportedModelError(BuildError):
    """The model is valid Modelica but contains a construct that the FMU would not reproduce exactly.

    The message gives the construct's name and line number.
    """


class ToolchainError(BuildError):
    """A compiler is missing or has failed; the message includes its output."""
