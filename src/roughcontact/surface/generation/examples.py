"""Three small maps for tutorials and first trials, generated like the records of an instrument.

Each call computes the same heights; no file is shipped. Licence of the maps: CC0 1.0 (public domain), for any use.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from roughcontact.grid import Grid
from roughcontact.surface.generation.fourier import self_affine
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, require

__all__ = ["surface"]

_LICENCE = "example map of roughcontact, no measurement; CC0 1.0"


def surface(name: str) -> Surface:
    """Return an example map: free edges, tilted as under an instrument, NaN where nothing was recorded.

    Parameters
    ----------
    name : {"ground", "blasted", "turned"}
        Which finish:

        - ``"ground"``: 192 x 256 cells of 1 um, grooves along x, rms height 0.4 um.
        - ``"blasted"``: 256 x 256 cells of 2 um, the same in all directions, rms height 2 um.
        - ``"turned"``: 160 x 320 cells of 2 um, grooves along y with a feed of 80 um, 2 um deep, waviness along y,
          and a hundredth of the cells missing.

    Returns
    -------
    Surface
        Its provenance states how it was generated. The rms heights above do not include the tilt.

    Raises
    ------
    ValueError
        If there is no example of this name.

    Notes
    -----
    You may use, change and publish the maps without permission: CC0 1.0.

    Examples
    --------
    >>> import roughcontact as rc
    >>> turned = rc.examples.surface("turned")
    >>> turned.grid.shape, turned.missing
    ((160, 320), 512)
    >>> f"{rc.examples.surface('blasted').levelled('plane').rms * 1e6:.1f} um"
    '2.0 um'
    """
    known = isinstance(name, str) and name in _RECIPES
    require(known, f"there is no example map {name!r}; there are {', '.join(_RECIPES)}")
    return _RECIPES[name]()


def _ground() -> Surface:
    """Grooves that grains of a wheel leave along x: twelve times longer than wide."""
    made = self_affine(
        Grid((192, 256), 1e-6),
        hurst=0.7,
        rms=0.4e-6,
        rolloff=40e-6,
        short_cutoff=4e-6,
        anisotropy=(12.0, 0.0),
        rng=np.random.default_rng(1),
    )
    return _recorded(made, made.heights, "stretched 12 times along x, roll-off 40 um, no waves below 4 um")


def _blasted() -> Surface:
    """Craters without direction: self-affine below the size of a grain, flat above."""
    made = self_affine(
        Grid((256, 256), 2e-6),
        hurst=0.8,
        rms=2e-6,
        rolloff=80e-6,
        short_cutoff=8e-6,
        rng=np.random.default_rng(2),
    )
    return _recorded(made, made.heights, "roll-off 80 um, no waves below 8 um")


def _turned() -> Surface:
    """Arcs of the tool's nose, one a feed along x, above the waviness of its vibration along y."""
    grid, rng, feed = Grid((160, 320), 2e-6), np.random.default_rng(3), 80e-6
    made = self_affine(grid, hurst=0.8, rms=0.1e-6, rolloff=40e-6, short_cutoff=8e-6, rng=rng)
    y, x = np.meshgrid(*grid.coordinates, indexing="ij")
    arcs = (x % feed - feed / 2) ** 2 / (2 * 400e-6)
    heights = made.heights + arcs + 0.3e-6 * np.cos(2 * np.pi * y / 250e-6)
    # Patches without reflected light: where another random field is highest.
    dark = self_affine(grid, hurst=0.8, rms=1.0, rolloff=20e-6, short_cutoff=16e-6, rng=rng).heights
    heights[dark > np.sort(dark, axis=None)[-(grid.size // 100) - 1]] = np.nan
    return _recorded(
        made,
        heights,
        "roll-off 40 um, no waves below 8 um; plus arcs of a nose of 0.4 mm at a feed of 80 um along x; "
        "plus a wave of 0.3 um, 250 um long, along y; 1 % of the cells taken away in patches",
    )


def _recorded(made: Surface, heights: Array, recipe: str) -> Surface:
    """Return the map as under an instrument, tilted by 3 um over its width."""
    tilt = 3e-6 * made.grid.coordinates[1] / made.grid.lengths[1]
    return Surface(
        heights + tilt, made.grid, (_LICENCE, *made.provenance, recipe, "tilted by 3 um over its width")
    )


_RECIPES: dict[str, Callable[[], Surface]] = {"ground": _ground, "blasted": _blasted, "turned": _turned}
