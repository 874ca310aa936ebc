"""Facts about the two bodies on a page: reduced modulus, hardness, grades, and equivalent values of other fields."""

from __future__ import annotations

from typing import Any

from roughcontact.labels.engineering_units import written
from roughcontact.page.jobs.session_cache import SessionCache
from roughcontact.page.server.page_request import PageRequest, Send
from roughcontact.recipe.elastic_jobs import CurveJob
from roughcontact.recipe.job_calls import Call, performed
from roughcontact.recipe.jobs import known_names
from roughcontact.recipe.plastic_flow import yields_at
from roughcontact.recipe.recipe_fields import value_of
from roughcontact.recipe.texts import RIGID

__all__ = ["bodies"]


def bodies(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send reduced modulus and hardness [Pa], lines about them, and equivalent values of the other fields."""
    from roughcontact.materials import as_modulus, handbook

    job = request.job
    assert isinstance(job, CurveJob)
    known = performed(job.bodies.calls(), known_names())
    modulus, hardness = as_modulus(known["modulus"]), yields_at(job.bodies, job.plastic)
    names = [name for name in value_of(job.bodies, "materials") or () if name != RIGID]
    metals = {name: handbook(name) for name in names}
    same: dict[str, str] = {"modulus": _gigapascals(modulus)}
    for which, metal in zip(("", "2"), map(handbook, names), strict=False):
        same[f"young{which}"] = _gigapascals(metal.solid.young_modulus)
        same[f"poisson{which}"] = f"{metal.solid.poisson_ratio:g}"
    lines = [f"Reduced modulus E* {_pressure(modulus)}"]
    lines += [
        f"{metal.name}: {metal.grade}; E {_pressure(metal.solid.young_modulus)}, "
        f"\u03bd {metal.solid.poisson_ratio:g}, hardness {_pressure(metal.hardness)}"
        for metal in metals.values()
    ]
    send(
        {
            "type": "bodies",
            "modulus": modulus,
            "hardness": hardness.value(known) if isinstance(hardness, Call) else hardness,
            "lines": lines,
            "same": same,
        }
    )


def _pressure(value: Any) -> str:
    return written(float(value), "Pa", 4)


def _gigapascals(value: float) -> str:
    return f"{value / 1e9:.6g} GPa"
