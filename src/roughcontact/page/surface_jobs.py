"""What a page shows of a surface: its map at once, and its roughness when there is time."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from roughcontact.labels.labelled import plain_values
from roughcontact.page.order import Order, Send, send_map
from roughcontact.page.recipe import FileSource
from roughcontact.page.statement import stated
from roughcontact.page.workbench import Workbench
from roughcontact.plot.facts import quantity, surface_facts, surface_record

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["look", "study"]

_MOST_CURVE = 600  # points of a curve on the screen
# In the order of the standard, with their units.
_AREAL = {
    **dict.fromkeys(("Sq", "Sa", "Sz", "Sp", "Sv", "Sal"), "m"),
    **dict.fromkeys(("Ssk", "Sku", "Str", "Sdq", "Sdr"), ""),
}


def look(order: Order, bench: Workbench, send: Send) -> None:
    """Send what the file holds, the heights after their preparation, and what is worth telling of them."""
    import numpy as np

    source = order.recipe.source
    if isinstance(source, FileSource):
        send({"type": "channels", "channels": _channels(order)})
    _, warned = bench.read(source, order.files)
    surface = bench.surface(order.recipe, order.files)
    heights = surface.heights - np.nanmean(surface.heights)
    send_map(send, "heights", heights, order.whole("pixels", 1024, 4096), **_place(surface))
    statement = stated(order.recipe, order.file)
    send(
        {
            "type": "surface",
            "facts": surface_facts(surface, surface_record(surface)),
            "warned": warned,
            "missing": surface.missing,
            "command": statement.command,
            "python": statement.python,
        }
    )


def study(order: Order, bench: Workbench, send: Send) -> None:
    """Send the distribution of the heights, their roughness parameters, their spectrum, and what looks suspicious."""
    import numpy as np

    import roughcontact as rc
    from roughcontact.plot.advice import advice

    surface = bench.surface(order.recipe, order.files)
    if surface.rms > 0:
        histogram = rc.height_histogram(surface, bins=80)
        send(
            {
                "type": "heights",
                "x": histogram.centres.tolist(),
                "y": histogram.density.tolist(),
                "normal": histogram.gaussian(histogram.centres).tolist(),
            }
        )
        spectrum = rc.power_spectrum(surface.filled(), per_decade=40)
        there = spectrum.density > 0
        thin = np.linspace(0, there.sum() - 1, min(int(there.sum()), _MOST_CURVE)).astype(int)
        send(
            {
                "type": "spectrum",
                "x": spectrum.wavenumber[there][thin].tolist(),
                "y": spectrum.density[there][thin].tolist(),
                "band": [float(spectrum.q_min), float(spectrum.q_max)],
            }
        )
        send({"type": "roughness", "facts": _roughness(surface)})
    raw, _ = bench.read(order.recipe.source, order.files)
    spikes, lines = advice(raw)
    send({"type": "doubts", "lines": lines, "spikes": spikes.count, "places": spikes.places[:200].tolist()})


def _channels(order: Order) -> list[dict[str, Any]]:
    from roughcontact.files.read import channels

    found = []
    for channel in channels(order.path):
        words = asdict(channel)
        found.append({name: plain_values(words[name]) for name in ("name", "shape", "unit", "is_height")})
    return found


def _place(surface: Surface) -> dict[str, Any]:
    return {"lengths": surface.grid.lengths, "periodic": list(surface.grid.periodic), "unit": "m"}


def _roughness(surface: Surface) -> list[tuple[str, str]]:
    import roughcontact as rc

    parameters, moments = rc.areal_parameters(surface), rc.surface_moments(surface)
    facts = []
    for name, unit in _AREAL.items():
        value = float(getattr(parameters, name))
        facts.append((name, quantity("lengths", value) if unit else f"{value:.4g}"))
    facts.append(("rms slope", f"{moments.rms_slope:.4g}"))
    facts.append(("Nayak's parameter", f"{moments.nayak:.4g}"))
    try:
        facts.append(
            ("Hurst exponent", f"{rc.hurst_exponent(surface.filled()).hurst:.3g}, fitted to the spectrum")
        )
    except ValueError as error:
        facts.append(("Hurst exponent", f"none: {error}"))
    return facts
