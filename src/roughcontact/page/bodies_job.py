"""What a page says of the two bodies: their elastic constants, and where those of named materials come from."""

from __future__ import annotations

from typing import Any

from roughcontact.page.order import Order, Send
from roughcontact.page.workbench import Workbench, hardness_of, modulus_of

__all__ = ["bodies"]


def bodies(order: Order, bench: Workbench, send: Send) -> None:
    """Send the reduced modulus and the hardness [Pa], and what is known of materials that are named."""
    chosen = order.recipe.bodies
    named = [_known(name) for name in chosen.materials or () if name != "rigid"]
    modulus, hardness = modulus_of(chosen), hardness_of(chosen)
    send({"type": "bodies", "modulus": modulus, "hardness": hardness, "materials": named})


def _known(name: str) -> dict[str, Any]:
    import roughcontact as rc

    material = rc.handbook(name)
    return {
        "name": material.name,
        "grade": material.grade,
        "young": material.solid.young_modulus,
        "poisson": material.solid.poisson_ratio,
        "hardness": material.hardness,
        "source": material.sources["solid"],
    }
