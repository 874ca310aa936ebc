"""Figure 13: how the stiffness of a contact region changes with its size and with its shape."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from roughcontact.contact.press import press
from roughcontact.contact.stiffness import contact_stiffness
from roughcontact.grid import Grid
from roughcontact.plot.raster import LABEL
from roughcontact.surface.fourier import self_affine
from roughcontact.theory import punch
from roughcontact.thesis.verdict import Verdict

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["Configurations", "case", "draw", "verdicts"]

Mask = npt.NDArray[np.bool_]

TITLE = "stiffness of a contact region that is enlarged, and of one that is stretched one way"
POINTS = 64
HURST = 0.8
RMS = 0.02  # over the side
PRESSURE = 0.006  # over E*
STRETCH = 2.0
SEED = 114
CHOSEN = (
    f"the region: contact of a rough square, H = {HURST:g}, {POINTS} x {POINTS} cells, under {PRESSURE:g} E*",
    f"enlarged and stretched by {STRETCH:g}",
)
SIZE = (7.0, 3.0)

_CONTACT = "#c8290b"


@dataclass(frozen=True, slots=True, eq=False)
class Configurations:
    """A contact region and its stiffness when it is stretched.

    Attributes
    ----------
    region : bool array
    stretches : tuple of (float, float)
        Along y and x.
    stiffness : tuple of float
        Over that of the region as it is.
    """

    region: Mask
    stretches: tuple[tuple[float, float], ...]
    stiffness: tuple[float, ...]


def case(seed: int = SEED) -> Configurations:
    """Return a region of contact, and its stiffness enlarged, and stretched along x and along y."""
    grid = Grid((POINTS, POINTS), 1 / POINTS)
    surface = self_affine(grid, HURST, RMS, np.random.default_rng(seed))
    region = press(surface, 1.0, pressure=PRESSURE).contact
    stretches = ((1.0, 1.0), (STRETCH, STRETCH), (1.0, STRETCH), (STRETCH, 1.0))
    first, *others = (
        contact_stiffness(region, Grid(grid.shape, (y / POINTS, x / POINTS)), 1.0) for y, x in stretches
    )
    return Configurations(region, stretches, (1.0, *(each / first for each in others)))


def draw(figure: Figure, data: Configurations) -> None:
    """Draw the region (a), enlarged (b), and stretched along x (c), to one scale."""
    across = [x for _, x in data.stretches[:3]]
    panels = figure.subplots(1, 3, width_ratios=across)
    words = ("$k$", f"$\\lambda k$,  $\\lambda$ = {STRETCH:g}", f"{data.stiffness[2]:.3f} $k$")
    for letter, axes, stretch, text in zip("abc", panels, data.stretches, words, strict=False):
        _region(axes, data.region, stretch)
        axes.set_title(f"({letter})  {text}", fontsize=LABEL)


def verdicts(data: Configurations) -> tuple[Verdict, ...]:
    """Return the ratios of the stiffnesses."""
    _, enlarged, along_x, along_y = data.stiffness
    disc, along, across = (
        float(punch.ellipse(1.0, after) / punch.ellipse(1.0, before))
        for after, before in (
            ((STRETCH, 1.0), (1.0, 1.0)),
            ((10 * STRETCH, 1.0), (10.0, 1.0)),
            ((10.0, STRETCH), (10.0, 1.0)),
        )
    )
    return (
        Verdict(
            "the stiffness grows as the lateral extension, not as the area",
            f"{STRETCH:g}",
            f"{enlarged:.6f} for {STRETCH:g} times the extension",
            bool(abs(enlarged / STRETCH - 1) < 1e-6),
        ),
        Verdict(
            "stretched one way, the stiffness cannot be deduced from the one before",
            "no rule",
            f"times {along_x:.3f} along x and {along_y:.3f} along y; a disc {disc:.3f}, an ellipse of 10:1 "
            f"{along:.3f} or {across:.3f}",
            True,
        ),
    )


def _region(axes: Axes, region: Mask, stretch: tuple[float, float]) -> None:
    from matplotlib.colors import ListedColormap

    y, x = stretch
    axes.imshow(
        region,
        cmap=ListedColormap(["#eef3f7", _CONTACT]),
        extent=(0, x, y, 0),
        interpolation="nearest",
        vmin=0,
        vmax=1,
    )
    # As high as the largest, so that all have one scale.
    axes.set(xlim=(0, x), ylim=((STRETCH + y) / 2, (y - STRETCH) / 2), aspect="equal", xticks=[], yticks=[])
    axes.spines[:].set_visible(False)
