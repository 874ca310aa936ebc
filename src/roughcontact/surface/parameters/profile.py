"""Profile surface texture parameters of ISO 21920-2."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.surface.parameters.heights import amplitudes
from roughcontact.surface.surface import Surface

__all__ = ["ProfileParameters", "profile_parameters"]

Array = npt.NDArray[np.float64]
# The seven-point formula for the local gradient, at offsets -3 to 3, in units of 1/(60 spacing).
GRADIENT = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0])


@dataclass(frozen=True, slots=True)
class ProfileParameters:
    """Height and gradient parameters of a profile (ISO 21920-2:2021; in brackets the clause of ISO 4287:1997).

    Parameters
    ----------
    Ra : float
        Arithmetic mean height [m] (4.2.1), over the evaluation length.
    Rq : float
        Root mean square height [m] (4.2.2), over the evaluation length.
    Rsk : float
        Skewness [-] (4.2.3), over the evaluation length.
    Rku : float
        Kurtosis [-] (4.2.4), over the evaluation length.
    Rt : float
        Total height [m] (4.1.5), over the evaluation length.
    Rp : float
        Mean peak height [m] (4.1.1): the mean of the highest point of each section length.
    Rv : float
        Mean pit depth [m] (4.1.2), positive: likewise of the lowest point.
    Rz : float
        Mean height [m] (4.1.3): the mean over the section lengths of highest less lowest.
    Rdq : float
        Root mean square gradient [-] (4.4.1), of the seven-point formula.
    sections : int
        Number of whole section lengths.
    section_length : float
        Length of a section [m].
    evaluation_length : float
        Length of all sections together [m]; what is left at the end of the profile is not looked at.
    """

    Ra: float
    Rq: float
    Rsk: float
    Rku: float
    Rt: float
    Rp: float
    Rv: float
    Rz: float
    Rdq: float
    sections: int
    section_length: float
    evaluation_length: float


def profile_parameters(line: Surface, *, section_length: float | None = None) -> ProfileParameters:
    """Return the height and gradient parameters of ISO 21920-2:2021 of a profile.

    Heights count above their mean over the evaluation length. The letter R of the names assumes that the
    profile went through the roughness filters of the standard; with another profile read P or W.

    Parameters
    ----------
    line : Surface
        On a grid of one axis, without missing points.
    section_length : float, optional
        Length of a section [m], rounded to whole cells. By default a fifth of the profile, since five sections
        are the standard's default.

    Raises
    ------
    ValueError
        If the grid has two axes, points are missing, the profile is flat or shorter than seven points, or a section
        does not fit in it.
    """
    grid = line.grid
    if grid.ndim != 1:
        raise ValueError(
            f"profile parameters need a line, not shape {grid.shape}: take a row or column of the surface"
        )
    if line.missing:
        raise ValueError(
            f"{line.missing} points are missing, and sections need all of theirs: fill them first"
        )
    spacing = grid.spacing[0]
    cells = grid.shape[0] // 5 if section_length is None else round(section_length / spacing)
    sections = grid.shape[0] // max(cells, 1)
    if cells < 2 or sections * cells < GRADIENT.size:
        raise ValueError(
            f"sections of {cells} cells do not fit a profile of {grid.shape[0]}: each needs two, and all together "
            f"{GRADIENT.size}"
        )
    heights = line.heights[: sections * cells]
    if heights.max() == heights.min():
        raise ValueError("all heights are equal: there is no texture to measure")
    heights = heights - heights.mean()
    moments = amplitudes(heights)
    parts = heights.reshape(sections, cells)
    peaks, pits = parts.max(axis=1), -parts.min(axis=1)
    return ProfileParameters(
        Ra=moments.arithmetic,
        Rq=moments.rms,
        Rsk=moments.skewness,
        Rku=moments.kurtosis,
        Rt=float(heights.max() - heights.min()),
        Rp=float(peaks.mean()),
        Rv=float(pits.mean()),
        Rz=float((peaks + pits).mean()),
        Rdq=float(np.sqrt(np.mean(_gradient(heights, spacing) ** 2))),
        sections=sections,
        section_length=cells * spacing,
        evaluation_length=sections * cells * spacing,
    )


def _gradient(heights: Array, spacing: float) -> Array:
    """Return the local gradients at all points with three neighbours on each side."""
    return np.asarray(np.correlate(heights, GRADIENT, mode="valid") / (60 * spacing))
