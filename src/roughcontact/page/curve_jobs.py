"""What a page shows of a curve: points as they come, a power law at the end, theories beside them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from roughcontact.labels.labelled import plain_values
from roughcontact.labels.variables import CURVE_POINTS
from roughcontact.page.order import Order, Send
from roughcontact.page.recipe import Loads
from roughcontact.page.statement import stated
from roughcontact.page.stopping import Stopped
from roughcontact.page.workbench import Workbench, hardness_of, modulus_of

if TYPE_CHECKING:
    from roughcontact.contact.curve import Curve
    from roughcontact.contact.solution import Solution

__all__ = ["curve", "theories", "whole_curve"]


def curve(order: Order, bench: Workbench, send: Send) -> None:
    """Send the loads, every point when it is there, and what the curve says as a whole."""
    recipe = replace(order.recipe, load=None, loads=order.recipe.loads or Loads())
    if recipe.loads is not None and recipe.loads.ends is None and recipe.loads.values is None:
        send({"type": "doing", "words": "Looking for the loads that suit this surface"})
    loads, notes = bench.loads(recipe, order.files)
    statement = stated(recipe, order.file)
    words = {"command": statement.command, "python": statement.python}
    send({"type": "loads", "count": len(loads), "notes": notes, **words})

    def watched(path: Iterator[Solution]) -> Iterator[Solution]:
        done = 0
        try:
            for solution in path:
                send({"type": "point", "number": done, "load": float(loads[done]), **_point(solution)})
                done += 1
                yield solution
        except Stopped:
            if not done:  # nothing to keep
                raise

    computed = _collected(watched(bench.path(recipe, loads, order.files)))
    bench.keep_curve(recipe, loads[: len(computed)], computed)
    send({"type": "curve", **_whole(computed), "stopped": len(computed) < len(loads)})


def theories(order: Order, bench: Workbench, send: Send) -> None:
    """Send what theories predict at the loads of the curve, and by how much they are off; or why they do not apply."""
    import roughcontact as rc

    computed = whole_curve(order, bench)
    surface = bench.surface(order.recipe, order.files)
    modulus, hardness = modulus_of(order.recipe.bodies), hardness_of(order.recipe.bodies)
    known: dict[str, Any] = {} if hardness is None else {"hardness": hardness}
    for name in order.more.get("names", []):
        try:
            [law] = rc.loading_laws(surface, modulus, str(name), **known)
            found = computed.compare(law)
        except ValueError as error:
            send({"type": "theory", "name": name, "refused": str(error)})
            continue
        send(
            {
                "type": "theory",
                "name": name,
                "label": found.name,
                "source": found.source,
                "words": found.words(),
                "predicted": {key: plain_values(values) for key, values in found.predicted.items()},
            }
        )


def whole_curve(order: Order, bench: Workbench) -> Curve:
    """Return the curve that the page has, as far as it came; computed again if this worker has not seen it."""
    loads, _ = bench.loads(order.recipe, order.files)
    kept = bench.curve(order.recipe, loads)
    if kept is not None:
        return kept
    computed = _collected(bench.path(order.recipe, loads, order.files))
    bench.keep_curve(order.recipe, loads, computed)
    return computed


def _collected(path: Iterator[Solution]) -> Curve:
    from roughcontact.contact.curve import collect

    return collect(path)


def _point(solution: Solution) -> dict[str, Any]:
    point = {name: plain_values(getattr(solution, name)) for name in CURVE_POINTS}
    return point | {
        "nominal_pressure": solution.force / solution.problem.grid.area,
        "contact_fraction": solution.contact_fraction,
        "spots": solution.spot_count,
        "resolved": bool(solution.resolved),
        "converged": solution.status.converged,
        "residual": solution.residual,
    }


def _whole(computed: Curve) -> dict[str, Any]:
    try:
        law = computed.fit()
    except ValueError as error:
        return {"fit": None, "why": str(error), "resolved": int(computed.resolved.sum())}
    low, high = law.window
    return {
        "fit": {
            "exponent": float(law.exponent),
            "prefactor": float(law.prefactor),
            "scatter": float(law.scatter),
            "straight": bool(law.straight),
            "window": [float(low), float(high)],
            "count": int(law.count),
        },
        "force_scale": computed.force_scale,
        "stiffness_scale": computed.stiffness_scale,
        "resolved": int(computed.resolved.sum()),
    }
