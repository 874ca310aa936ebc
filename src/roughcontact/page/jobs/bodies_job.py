"""What a page says of the two bodies: their reduced modulus and hardness."""

from __future__ import annotations

from roughcontact.page.jobs.session_cache import SessionCache, hardness_of, modulus_of
from roughcontact.page.server.page_request import PageRequest, Send

__all__ = ["bodies"]


def bodies(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send the reduced modulus and the hardness [Pa]."""
    chosen = request.recipe.bodies
    send({"type": "bodies", "modulus": modulus_of(chosen), "hardness": hardness_of(chosen)})
