"""Explain rumoca's messages in Modelica's terms, and find the source constructs that cause them."""

from __future__ import annotations

from fmu_build.codegen.modelica_source.constructs import ModelText
from fmu_build.compilers.rumoca_messages.classes import CLASSES
from fmu_build.compilers.rumoca_messages.connections import CONNECTIONS_AND_COUNTS
from fmu_build.compilers.rumoca_messages.declarations import DECLARATIONS
from fmu_build.compilers.rumoca_messages.events import EVENTS
from fmu_build.compilers.rumoca_messages.functions import FUNCTIONS
from fmu_build.compilers.rumoca_messages.meaning import Meaning
from fmu_build.compilers.rumoca_messages.sizes import SIZES

MEANINGS = (*CONNECTIONS_AND_COUNTS, *EVENTS, *FUNCTIONS, *CLASSES, *SIZES, *DECLARATIONS)


def meaning_of(message: str, source: ModelText) -> Meaning | None:
    """Return the explanation of a message about a source, or None if there is none."""
    return next((meaning for meaning in MEANINGS if meaning.applies(message, source)), None)
