"""New slots of y and p, named after the values whose tangents they store."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from fmu_build.codegen.expression import Slot


@dataclass
class NewSlots:
    """Allocates slots behind those of the model."""

    n_y: int
    n_p: int
    texts: Mapping[Slot, str]
    """The names of the model's own slots."""
    names: dict[Slot, str] = field(default_factory=dict)
    """The names of the new slots, in slot order."""

    def add(self, of: Slot, direction: str) -> Slot:
        """Return a new slot for the tangent of `of`, in the same array."""
        return self.named(of[0], f"tangent.{self.texts.get(of, f'{of[0]}_{of[1]}')}.{direction}")

    def named(self, store: str, name: str) -> Slot:
        """Return a new slot of y or p."""
        if store == "y":
            slot: Slot = ("y", self.n_y)
            self.n_y += 1
        else:
            slot = ("p", self.n_p)
            self.n_p += 1
        self.names[slot] = name
        return slot
