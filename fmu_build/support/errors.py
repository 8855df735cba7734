"""The errors of building an FMU. Each names the file, model or value it is about and what is allowed."""

from __future__ import annotations


class BuildError(Exception):
    """Base class: an FMU could not be built. Nothing is left half-written."""


class UnknownCompilerError(BuildError):
    """No backend has the requested name."""


class ModelNotFoundError(BuildError):
    """The Modelica class or file does not exist."""


class ModelicaError(BuildError):
    """The Modelica source has an error; the message has file, line and column where known."""


class UnsupportedModelError(BuildError):
    """The model is valid Modelica, but uses something that cannot be carried faithfully into the FMU.

    The message names the construct and the source line.
    """


class ToolchainError(BuildError):
    """The C compiler is missing or failed; the message carries what it printed."""
