"""Profile surface texture parameters of ISO 21920-2."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.parameters.heights import amplitudes
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric, require

__all__ = ["ProfileParameters", "profile_parameters"]

# The seven-point formula for the local gradient, at offsets -3 to 3, in units of 1/(60 spacing).
GRADIENT = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0])


@dataclass(frozen=True, slots=True)
class ProfileParameters:
    """Height and gradient parameters of a profile (clauses of ISO 21920-2:2021).

    Attributes
    ----------
    Ra : float
        Arithmetic mean height [m], 4.2.2, over the evaluation length.
    Rq : float
        Root mean square height [m], 4.2.3, over the evaluation length.
    Rsk : float
        Skewness [-], 4.2.4, over the evaluation length.
    Rku : float
        Kurtosis [-], 4.2.5, over the evaluation length; 3 for normally distributed heights.
    Rt : float
        Total height [m], 4.2.6: highest less lowest point of the evaluation length.
    Rp : float
        Mean peak height [m], 5.1.3: the mean over the sections of the largest height of a peak.
    Rv : float
        Mean pit depth [m], 5.1.5, positive: likewise of the pits.
    Rz : float
        Maximum height [m], 5.1.6: Rp + Rv.
    Rdq : float
        Root mean square gradient [-], 4.4.2, of the seven-point formula.
    sections : int
        Number of whole section lengths.
    section_length : float
        Length of a section [m].
    evaluation_length : float
        Length of all sections together [m]; the rest at the end of the profile is ignored.
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


@numeric(section_length="m")
@analysed_on_host
def profile_parameters(line: Surface, *, section_length: float | None = None) -> ProfileParameters:
    """Return the height and gradient parameters of ISO 21920-2:2021 of a profile.

    No filter is applied and no tilt removed: heights count above their mean over the evaluation length. The letter R of
    the names holds for a profile that went through the roughness filters; without them read P. Ra, Rq, Rsk, Rku and Rt
    are those of the whole evaluation length, over all its points; Rp, Rv and Rz are means over its sections. See the
    notes for the filters, and for ISO 4287.

    A peak is the highest point of a hill, between two crossings of the mean line, and belongs to the section in which
    it lies; a pit is likewise the lowest point of a dale. A section without a peak or pit counts with zero. ISO 4287
    used the highest and lowest point of each section instead, even on the flank of a hill whose peak lies in another
    section.

    Parameters
    ----------
    line : Surface
        On a grid of one axis, without missing points.
    section_length : float, optional
        Length of a section [m], rounded to whole cells. By default a fifth of the profile, because five sections are
        the default of the standard.

    Returns
    -------
    ProfileParameters
        Heights [m] and the gradient [-] by the names of the standard.

    Raises
    ------
    ValueError
        If the grid has two axes, points are missing, the profile is flat or shorter than seven points, or a section
        does not fit in it.

    Notes
    -----
    For R-parameters remove the tilt or form, then filter by the Gaussian of ISO 16610-21 between the nesting indices
    lambda_s and lambda_c (for ground surfaces usually 2.5 um and 0.8 mm), and give lambda_c as the section length; the
    default of the standard is five such sections. Cut off half a lambda_c at either end of a profile that is not
    periodic, because the filter is affected by the ends.

    ISO 4287 (1997) takes Ra and Rq of each sampling length, which is the section, about the common mean line, and ISO
    4288 the mean over five of them. For Ra the result is the same. The mean of the Rq of the sections is at most the
    Rq here, and less if sections differ: for two sections with the rms heights 1 and 3 um it is 2 um, where Rq is 2.24
    um. The areal Sq of ISO 25178-2 has no sections and uses other filters (`areal_parameters`): the Rq of a row of a
    map is not its Sq.

    Examples
    --------
    >>> import roughcontact as rc
    >>> wave = rc.shapes.wave(rc.Grid(640, 1e-6, periodic=True), amplitude=1e-6, wavelength=64e-6)
    >>> parameters = rc.profile_parameters(wave)
    >>> f"Rq = {parameters.Rq:.3g} m, Rz = {parameters.Rz:.2g} m"
    'Rq = 7.07e-07 m, Rz = 2e-06 m'
    >>> roughness = wave.levelled("plane").filtered(short_cutoff=8e-6, long_cutoff=128e-6)
    >>> parameters = rc.profile_parameters(roughness, section_length=128e-6)
    >>> parameters.sections, f"Rq = {parameters.Rq:.3g} m"  # 2^-(8/64)^2 (1 - 2^-(128/64)^2) of it
    (5, 'Rq = 6.56e-07 m')
    """
    grid = line.grid
    if grid.ndim != 1:
        raise InputError(
            f"profile parameters need a line, not shape {grid.shape}", "take a row or column of the surface"
        )
    if line.missing:
        raise InputError(
            f"{line.missing} points are missing, and sections need all their points", "fill them first"
        )
    spacing = grid.spacing[0]
    if section_length is not None and not 0 < section_length < math.inf:
        raise about("section_length", f"must be positive and finite [m], not {section_length}")
    cells = grid.shape[0] // 5 if section_length is None else round(section_length / spacing)
    sections = grid.shape[0] // max(cells, 1)
    if cells < 2 or sections * cells < GRADIENT.size:
        raise InputError(
            f"sections of {cells} cells do not fit a profile of {grid.shape[0]}, of which each needs two, and all "
            f"together {GRADIENT.size}",
            f"give a section_length of {2 * spacing:g} m to {grid.lengths[0]:g} m, or a longer profile",
        )
    heights = line.heights[: sections * cells]
    require(heights.max() != heights.min(), "all heights are equal: there is no texture to measure")
    heights = heights - heights.mean()
    arithmetic, rms, skewness, kurtosis = amplitudes(heights)
    peaks, pits = _largest(heights, sections)
    peak, pit = float(peaks.mean()), float(pits.mean())
    return ProfileParameters(
        Ra=arithmetic,
        Rq=rms,
        Rsk=skewness,
        Rku=kurtosis,
        Rt=float(heights.max() - heights.min()),
        Rp=peak,
        Rv=pit,
        Rz=peak + pit,
        Rdq=float(np.sqrt(np.mean(_gradient(heights, spacing) ** 2))),
        sections=sections,
        section_length=cells * spacing,
        evaluation_length=sections * cells * spacing,
    )


def _largest(heights: Array, sections: int) -> tuple[Array, Array]:
    """Return the largest height of a peak and the largest depth of a pit in each section, shape (sections,)."""
    above = heights > 0
    starts = np.concatenate([[0], np.flatnonzero(np.diff(above)) + 1])
    size = np.abs(heights)
    extremes = np.maximum.reduceat(size, starts)
    # Position of the extreme of each hill or dale; the first of several equal ones.
    run = np.repeat(np.arange(starts.size), np.diff(starts, append=heights.size))
    places = np.flatnonzero(size == extremes[run])
    places = places[np.unique(run[places], return_index=True)[1]]
    section = places // (heights.size // sections)
    peaks, pits = np.zeros(sections), np.zeros(sections)
    hills = above[starts]
    np.maximum.at(peaks, section[hills], extremes[hills])
    np.maximum.at(pits, section[~hills], extremes[~hills])
    return peaks, pits


def _gradient(heights: Array, spacing: float) -> Array:
    """Return the local gradients at all points with three neighbours on each side."""
    return np.asarray(np.correlate(heights, GRADIENT, mode="valid") / (60 * spacing))
