"""Modifiers that rumoca reads and forgets: found in the source, because its output does not show them."""

from __future__ import annotations

import re
from pathlib import Path

from fmu_build.codegen.lowered import LoweredModel
from fmu_build.modelica_source.constructs import Construct, ModelText
from fmu_build.modelica_source.places import located
from fmu_build.support.errors import UnsupportedModelError

_KINDS = r"(?:model|block|record|type|package|class)"
_REDECLARED_CLASS = (
    rf"(?<=[(,])\s*\bredeclare\s+(?:replaceable\s+)?{_KINDS}\s+\w+\s*=\s*[\w.]+\s*\(",
    "the modifiers of a class that is redeclared inside a modifier are lost; "
    "give the class with its modifiers a name of its own",
)
_CONSTRAINING_CLASS = (
    r"\bconstrainedby\s+[\w.]+\s*\(",
    "the modifiers of a constraining class are lost; put them on the component",
)
_EXTENSION = r"\bextends\s+[\w.]+\s*\("
_REDECLARED_COMPONENT = re.compile(rf"\bredeclare\s+(?:replaceable\s+)?(?!{_KINDS}\b)[\w.]+\s+(\w+)")


def refuse_lost_modifiers(model: LoweredModel) -> None:
    """Raises `UnsupportedModelError` for the first modifier in the model's classes that would be lost."""
    texts = {Path(path): content for _, path, content in model.source_files}
    text = ModelText(model.name, texts, around=False)
    for pattern, why in (_REDECLARED_CLASS, _CONSTRAINING_CLASS):
        for construct in text.find([pattern]):
            raise _refusal(model, why, construct)
    for extension in text.find([_EXTENSION]):
        base = re.split(r"[\s(]+", extension.text)[1].rpartition(".")[2]
        for component in _REDECLARED_COMPONENT.findall(extension.text):
            if text.mentions(base, rf"\breplaceable\b[^;]*\b{component}\b") is False:
                why = (
                    f"the redeclaration of {component} is lost, because {base} inherits it; "
                    "extend the class that declares it"
                )
                raise _refusal(model, why, extension)


def _refusal(model: LoweredModel, why: str, construct: Construct) -> UnsupportedModelError:
    return UnsupportedModelError(located(why, [construct.place], model.name, construct.place.file))
