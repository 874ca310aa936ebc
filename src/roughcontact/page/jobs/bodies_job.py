"""What a page says of the two bodies: their reduced modulus and hardness."""

from __future__ import annotations

from roughcontact.page.jobs.session_cache import Workbench, hardness_of, modulus_of
from roughcontact.page.server.page_request import Order, Send

__all__ = ["bodies"]


def bodies(order: Order, bench: Workbench, send: Send) -> None:
    """Send the reduced modulus and the hardness [Pa]."""
    chosen = order.recipe.bodies
    send({"type": "bodies", "modulus": modulus_of(chosen), "hardness": hardness_of(chosen)})
