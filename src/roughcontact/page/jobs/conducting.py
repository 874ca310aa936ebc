"""What the bodies of a page conduct: that of two materials chosen by name."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughcontact.page.recipe import Bodies

if TYPE_CHECKING:
    from roughcontact.evaluation.conduction import Conductors

__all__ = ["conducting_pair", "conductors_of"]


def conducting_pair(bodies: Bodies) -> tuple[str, str] | None:
    """Return the names of two materials that conduct; None where the bodies are not both named."""
    from roughcontact.materials import MATERIALS

    pair = bodies.materials
    return pair if pair is not None and all(name in MATERIALS for name in pair) else None


def conductors_of(bodies: Bodies) -> Conductors | None:
    """Return what two named materials conduct, if there are two."""
    from roughcontact.evaluation.conduction import Conductors
    from roughcontact.materials import handbook

    pair = conducting_pair(bodies)
    if pair is None:
        return None
    first, second = (handbook(name) for name in pair)
    return Conductors(
        (first.resistivity, second.resistivity),
        (first.conductivity, second.conductivity),
    )
