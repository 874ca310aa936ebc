"""A surface on a page: its map at once, its roughness later."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roughcontact.errors import InputError
from roughcontact.labels.engineering_units import written
from roughcontact.labels.labelled import plain_values
from roughcontact.page.jobs.session_cache import SessionCache
from roughcontact.page.refusal import on_the_page
from roughcontact.page.server.page_request import PageRequest, Send, send_map
from roughcontact.plot.facts import surface_facts, surface_record
from roughcontact.recipe.source import File

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["look", "study"]

_MOST_SPIKES = 200  # rings on the map
_MOST_CURVE = 600  # points of a curve on the screen
# Parameters of ISO 25178-2 with their names and units.
_AREAL = (
    ("Sq", "root mean square height", "m"),
    ("Sa", "arithmetic mean height", "m"),
    ("Sz", "maximum height", "m"),
    ("Sp", "maximum peak height", "m"),
    ("Sv", "maximum pit depth", "m"),
    ("Ssk", "skewness", ""),
    ("Sku", "kurtosis", ""),
    ("Sal", "autocorrelation length", "m"),
    ("Str", "texture aspect ratio", ""),
    ("Sdq", "root mean square gradient", ""),
    ("Sdr", "developed interfacial area ratio", ""),
)
# For a profile, parameters of ISO 21920-2.
_PROFILE = (
    ("Rq", "root mean square height", "m"),
    ("Ra", "arithmetic mean height", "m"),
    ("Rz", "maximum height", "m"),
    ("Rp", "mean peak height", "m"),
    ("Rv", "mean pit depth", "m"),
    ("Rt", "total height", "m"),
    ("Rsk", "skewness", ""),
    ("Rku", "kurtosis", ""),
    ("Rdq", "root mean square gradient", ""),
)


def look(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send the channels of the file, the heights after preparation, and facts about them."""
    import numpy as np

    source = request.job.source
    if isinstance(source, File):
        send({"type": "channels", "channels": _channels(source)})
    raw, warned = cache.read(request.job)
    surface = cache.surface(request.job)
    heights = surface.heights - np.nanmean(surface.heights)
    send_map(send, "heights", heights, surface.grid, request.whole("pixels", 1024, 4096), "m")
    send(
        {
            "type": "surface",
            "facts": surface_facts(surface, surface_record(surface)),
            "warned": [on_the_page(line) for line in warned if "despiked()" not in line],  # in `study`
            "raw": {"lengths": raw.grid.lengths, "shape": raw.grid.shape},
            **request.statement,
        }
    )


def study(request: PageRequest, cache: SessionCache, send: Send) -> None:
    """Send the distribution of the heights, their suspicious features, spectrum, and roughness parameters."""
    import numpy as np

    import roughcontact as rc
    from roughcontact.plot.drawing.usual_range import usual_range
    from roughcontact.plot.pressure_bars import fewer

    surface = cache.surface(request.job)
    rough = surface.rms > 0
    if rough:
        heights = surface.heights[surface.measured]
        heights = heights - heights.mean()
        histogram = rc.height_histogram(surface, bins=fewer(80, heights), ends=usual_range(heights))
        beyond = 1 - float(histogram.count.sum()) / heights.size
        ends = " to ".join(written(float(end), "m") for end in (heights.min(), heights.max()))
        send(
            {
                "type": "heights",
                "x": histogram.centres.tolist(),
                "y": histogram.density.tolist(),
                "normal": histogram.gaussian(histogram.centres).tolist(),
                "beyond": f"Beyond the axis: {100 * beyond:.2g} % of the heights, {ends}." if beyond else "",
            }
        )
    warned = [each | {"remedy": on_the_page(each["remedy"])} for each in cache.warnings(request.job)]
    send({"type": "warnings", "warnings": warned})
    places = cache.spikes(request.job).places[:_MOST_SPIKES]
    send({"type": "spikes", "places": [[0, *place][-2:] for place in places.tolist()]})
    if rough:
        spectrum = rc.power_spectrum(surface.filled(), per_decade=40)
        there = spectrum.density > 0
        thin = np.linspace(0, there.sum() - 1, min(int(there.sum()), _MOST_CURVE)).astype(int)
        send(
            {
                "type": "spectrum",
                "x": spectrum.wavenumber[there][thin].tolist(),
                "y": spectrum.density[there][thin].tolist(),
                "unit": "m⁴" if surface.grid.ndim == 2 else "m³",
            }
        )
        send({"type": "roughness", "facts": _roughness(surface)})


def _channels(source: File) -> list[dict[str, Any]]:
    from roughcontact.files.read import channels

    found = []
    for channel in channels(Path(source.file)):
        words = asdict(channel)
        found.append(
            {name: plain_values(words[name]) for name in ("name", "shape", "unit", "size", "is_height")}
        )
    return found


def _roughness(surface: Surface) -> list[tuple[str, str, str]]:
    """Return lines on the roughness: symbol or name, meaning and value."""
    import roughcontact as rc

    areal = surface.grid.ndim == 2
    parameters: Any = rc.areal_parameters(surface) if areal else rc.profile_parameters(surface.filled())
    moments = rc.surface_moments(surface)
    facts = [
        (name, words, written(float(getattr(parameters, name)), unit, 4))
        for name, words, unit in (_AREAL if areal else _PROFILE)
    ]
    facts.append(("rms slope", "from the moment m2", written(moments.rms_slope, "", 4)))
    facts.append(("rms curvature", "from the moment m4", written(moments.rms_curvature, "m-1", 4)))
    facts.append(("Nayak's parameter", "m0 m4 / m2²", written(moments.nayak, "", 4)))
    return [*facts, ("Hurst exponent", *_hurst(surface))]


def _hurst(surface: Surface) -> tuple[str, str]:
    """Return the origin of the Hurst exponent in words, or why there is none, and the exponent."""
    import roughcontact as rc

    try:
        law = rc.hurst_exponent(surface.filled())
    except InputError as error:
        return on_the_page(str(error)), "none"
    if law.misfit > law.chance:
        limit = f"chance stays below {law.chance:.2g}"
        return f"the spectrum follows no power law: misfit {law.misfit:.2g}, {limit}", "none"
    if not 0 <= law.hurst <= 1:
        return f"the spectrum falls as q^-{law.exponent:.3g}, a self-affine one as q^-2 to q^-4", "none"
    return "fitted to the spectrum", f"{law.hurst:.3g}"
