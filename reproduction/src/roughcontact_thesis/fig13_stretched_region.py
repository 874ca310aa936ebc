"""Figure 13: how the stiffness of a contact region changes with its size and with its shape."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.theory.spheres_and_punches import punch
from roughcontact.validation import Mask
from roughcontact_thesis import drawing
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["Configurations", "case", "draw", "verdicts"]


TITLE = "stiffness of a contact region that is enlarged, and of one that is stretched one way"
POINTS = 64
HURST = 0.8
RMS = 0.02  # over the side
PRESSURE = 0.006  # over E*
STRETCH = 2.0
SEED = 192
CHOSEN = (
    f"the region: contact of a rough square, H = {HURST:g}, {POINTS} x {POINTS} cells, under {PRESSURE:g} E*",
    f"enlarged and stretched by {STRETCH:g}",
)
SIZE = (drawing.PAGE, 2.9)


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
    grid = rc.Grid((POINTS, POINTS), 1 / POINTS)
    surface = rc.self_affine(grid, HURST, RMS, np.random.default_rng(seed))
    region = rc.press(surface, 1.0, pressure=PRESSURE).contact
    stretches = ((1.0, 1.0), (STRETCH, STRETCH), (1.0, STRETCH), (STRETCH, 1.0))
    first, *others = (
        rc.contact_stiffness(region, rc.Grid(grid.shape, (y / POINTS, x / POINTS)), 1.0) for y, x in stretches
    )
    return Configurations(region, stretches, (1.0, *(each / first for each in others)))


def draw(figure: Figure, data: Configurations) -> None:
    """Draw the region (a), enlarged (b), and stretched along x (c), to one scale."""
    panels = figure.subplots(1, 3, width_ratios=[x for _, x in data.stretches[:3]])
    words = ("$k$", f"$\\lambda k$,  $\\lambda$ = {STRETCH:g}", f"{data.stiffness[2]:.3f} $k$")
    colours = ListedColormap(["#eef3f7", drawing.LINES])
    for letter, axes, (y, x), text in zip("abc", panels, data.stretches, words, strict=False):
        axes.imshow(data.region, cmap=colours, extent=(0, x, y, 0), interpolation="nearest", vmin=0, vmax=1)
        # As high as the largest, so that all have one scale.
        drawing.frameless(axes, xlim=(0, x), ylim=((STRETCH + y) / 2 + 0.25, (y - STRETCH) / 2))
        axes.set_title(f"({letter})  {text}", loc="center")
        drawing.scale_bar(axes, (0, y + 0.07), 1.0, "$L$")


def verdicts(data: Configurations) -> Verdicts:
    """Return the ratios of the stiffnesses, and where a higher surface has the same contact."""
    _, enlarged, along_x, along_y = data.stiffness
    shapes = ((1.0, 1.0), (STRETCH, 1.0)), ((10.0, 1.0), (10 * STRETCH, 1.0)), ((10.0, 1.0), (10.0, STRETCH))
    disc, along, across = (
        float(punch.ellipse(1.0, after) / punch.ellipse(1.0, before)) for before, after in shapes
    )
    yield Verdict(
        "the stiffness grows as the lateral extension, not as the area",
        "It scales linearly with the lateral extension, that is to say it does not scale linearly with the contact "
        "area",
        "section 4.1",
        f"{enlarged:.6f} for {STRETCH:g} times the extension",
        exactly(bool(abs(enlarged / STRETCH - 1) < 1e-6), "1e-6 of it"),
        "method",
    )
    yield Verdict(
        "stretched one way, the stiffness does not follow from the one before",
        "Stretching only one of the 2 planar extensions is not as trivial.",
        "section 4.1, fig. 13",
        f"times {along_x:.3f} along x and {along_y:.3f} along y; a disc {disc:.3f}, an ellipse of 10:1 {along:.3f} or "
        f"{across:.3f}",
        exactly(
            abs(along_x - along_y) > 0.01,
            "one factor for all",
            f"{abs(along_x - along_y):.3f} between x and y",
        ),
        "method",
    )
    yield _higher(SEED)


def _higher(seed: int) -> Verdict:
    """Return at which depth a surface of twice the height has the contact of the other (eqs 4.10 and 4.11)."""
    grid = rc.Grid((POINTS, POINTS), 1 / POINTS)
    low = rc.self_affine(grid, HURST, RMS, np.random.default_rng(seed))
    depth = float(low.rms)
    one, deeper, less = (
        rc.press(surface, 1.0, depth=times * depth).stiffness
        for surface, times in ((low, 1.0), (STRETCH * low, STRETCH), (STRETCH * low, 1 / STRETCH))
    )
    return Verdict(
        "a surface of greater height has the same contacts at other depths",
        "the very same contact configurations will be generated [...] only at different values of the indentation "
        "depth d",
        "section 4.2, eqs 4.10, 4.11",
        f"{STRETCH:g} times as high, the stiffness is {deeper / one:.6f} of that before at {STRETCH:g} times "
        "the depth, "
        f"and {less / one:.3f} at 1/{STRETCH:g} of it, as eq. 4.11 is printed",
        exactly(bool(abs(deeper / one - 1) < 1e-6), "1e-6 of it"),
        "method",
    )
