"""The material ratio curve and the Sk family of parameters."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.errors import InputError
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.validation import Array, numeric, require

__all__ = ["MaterialRatio", "StratifiedParameters", "material_ratio", "stratified_parameters"]

# The central region of the curve that the equivalent straight line follows.
CENTRAL = 0.4


@dataclass(frozen=True, slots=True, eq=False)
class MaterialRatio:
    """The material ratio (Abbott-Firestone) curve: the share of the points above a height.

    ISO 25178-2:2021, 4.5.1; for profiles ISO 21920-2:2021, 4.5.1. Straight between the sorted points, the i-th highest
    of n at the ratio (i - 1/2)/n, and level beyond the first and the last.

    Attributes
    ----------
    ratio : array, shape (n,)
        Material ratios, increasing, from 0 to 1.
    height : array, shape (n,)
        Heights above the mean [m], decreasing.
    """

    ratio: Array
    height: Array

    def height_at(self, ratio: npt.ArrayLike) -> Array:
        """Return the height above which a share of the points lies (ISO 25178-2:2021, 4.5.2).

        Parameters
        ----------
        ratio : array
            Material ratios [-], from 0 to 1.

        Returns
        -------
        array, the same shape
            Heights above the mean [m].
        """
        at = np.asarray(ratio, dtype=np.float64)
        return np.asarray(np.interp(at, self.ratio, self.height))

    def ratio_at(self, height: npt.ArrayLike) -> Array:
        """Return the share of the points above a height.

        Parameters
        ----------
        height : array
            Heights above the mean [m].

        Returns
        -------
        array, the same shape
            Material ratios [-], from 0 to 1.
        """
        at = np.asarray(height, dtype=np.float64)
        share = np.interp(at, self.height[::-1], self.ratio[::-1])
        share = np.where(at > self.height[0], 0.0, share)
        return np.asarray(np.where(at < self.height[-1], 1.0, share))

    def integral(self, start: float, stop: float) -> float:
        """Return the integral of the height over the material ratio.

        Parameters
        ----------
        start, stop : float
            Material ratios [-] between which is integrated.

        Returns
        -------
        float
            [m]
        """
        inside = (self.ratio > start) & (self.ratio < stop)
        ratio = np.concatenate([[start], self.ratio[inside], [stop]])
        return float(np.trapezoid(self.height_at(ratio), ratio))


@dataclass(frozen=True, slots=True)
class StratifiedParameters:
    """The parameters of stratified surfaces and volumes (clauses of ISO 25178-2:2021).

    For profiles they are those of ISO 21920-2:2021, 4.5.3 (Rk, Rpk, Rvk, ...) and 4.5.5.

    Attributes
    ----------
    Sk : float
        Core height [m], 4.5.4: the height that the equivalent straight line spans.
    Spk, Svk : float
        Reduced peak height and reduced dale depth [m], 4.5.4: heights of the triangles with the areas of the curve
        above and below the core.
    Smr1, Smr2 : float
        Material ratios between which the core lies [-], 4.5.4, shares, not percent.
    Vmp, Vmc : float
        Material volumes of peaks and core per area [m], 4.5.6, with the default limits of 10 % and 80 %.
    Vvc, Vvv : float
        Void volumes of core and dales per area [m], 4.5.7, with the same limits.
    """

    Sk: float
    Spk: float
    Svk: float
    Smr1: float
    Smr2: float
    Vmp: float
    Vmc: float
    Vvc: float
    Vvv: float


@numeric
@analysed_on_host
def material_ratio(surface: Surface) -> MaterialRatio:
    """Return the material ratio curve of a surface or a line (ISO 25178-2:2021, 4.5.1).

    Parameters
    ----------
    surface : Surface
        Missing points are ignored.

    Returns
    -------
    MaterialRatio
        Heights above the mean over the share of the points that lie above them.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> line = rc.Surface(np.arange(100) * 1e-8, rc.Grid(100, 1e-6))
    >>> curve = rc.material_ratio(line)
    >>> f"{curve.height_at(0.25) * 1e6:.3f} um, {curve.ratio_at(0.0):.2f}"
    '0.250 um, 0.50'
    """
    heights = np.sort(surface.heights[surface.measured])[::-1]
    heights -= heights.mean()
    ratio = (np.arange(heights.size) + 0.5) / heights.size
    return MaterialRatio(ratio, heights)


@numeric
def stratified_parameters(
    surface: Surface, *, peak_ratio: float = 0.1, dale_ratio: float = 0.8
) -> StratifiedParameters:
    """Return the Sk family of a surface, or the Rk family of a line.

    ISO 25178-2:2021, 4.5.4, 4.5.6 and 4.5.7; for profiles ISO 21920-2:2021, 4.5.3 and 4.5.5. The construction is that
    of ISO 13565-2: the central region is the 40 % of the curve over which it falls least, the first of several, and
    the equivalent straight line its least-squares line there. The region begins at one of the points, which limits the
    accuracy of Sk to about a percent with some hundred points. Outliers are not removed: remove them first. Missing
    points are ignored.

    Parameters
    ----------
    surface : Surface
        Filtered as the standard requires; heights count above the mean.
    peak_ratio, dale_ratio : float
        Material ratios that separate peaks from core and core from dales, for the volumes.

    Returns
    -------
    StratifiedParameters
        Heights [m], ratios [-] and volumes per area [m] by the names of the standard.

    Raises
    ------
    ValueError
        If fewer than ten heights are measured, all are equal, or the ratios are not in order within 0 and 1.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> line = rc.Surface(np.linspace(0, 1e-6, 100), rc.Grid(100, 1e-6))
    >>> f"Sk = {rc.stratified_parameters(line).Sk * 1e6:.2f} um"
    'Sk = 1.01 um'
    """
    if not 0 < peak_ratio < dale_ratio < 1:
        raise InputError(
            f"ratios must increase between 0 and 1, not {peak_ratio} and {dale_ratio}",
            place="peak_ratio, dale_ratio",
        )
    curve = material_ratio(surface)
    require(curve.height.size >= 10, f"a material ratio curve needs ten heights, not {curve.height.size}")
    require(curve.height[0] != curve.height[-1], "all heights are equal: there is no core to measure")
    slope, offset = _equivalent_line(curve)
    top, bottom = offset, offset + slope  # where the line meets the ratios 0 and 1
    smr1, smr2 = (float(curve.ratio_at(height)) for height in (top, bottom))
    hill = curve.integral(0, smr1) - top * smr1
    dale = bottom * (1 - smr2) - curve.integral(smr2, 1)
    peak, low = (float(curve.height_at(ratio)) for ratio in (peak_ratio, dale_ratio))

    def material(ratio: float, height: float) -> float:
        return curve.integral(0, ratio) - ratio * height

    def void(ratio: float, height: float) -> float:
        return (1 - ratio) * height - curve.integral(ratio, 1)

    return StratifiedParameters(
        Sk=top - bottom,
        Spk=2 * hill / smr1 if smr1 > 0 else 0.0,
        Svk=2 * dale / (1 - smr2) if smr2 < 1 else 0.0,
        Smr1=smr1,
        Smr2=smr2,
        Vmp=material(peak_ratio, peak),
        Vmc=material(dale_ratio, low) - material(peak_ratio, peak),
        Vvc=void(peak_ratio, peak) - void(dale_ratio, low),
        Vvv=void(dale_ratio, low),
    )


def _equivalent_line(curve: MaterialRatio) -> tuple[float, float]:
    """Return the slope and the height at ratio 0 of the equivalent straight line [m]."""
    last = curve.ratio[-1] - CENTRAL
    starts = curve.ratio[curve.ratio <= last]
    if not starts.size:
        starts = np.array([(1 - CENTRAL) / 2])
    falls = curve.height_at(starts) - curve.height_at(starts + CENTRAL)
    start = float(starts[int(np.argmin(falls))])
    inside = (curve.ratio >= start) & (curve.ratio <= start + CENTRAL * (1 + 1e-12))
    ratio, height = curve.ratio[inside], curve.height[inside]
    centred = ratio - ratio.mean()
    slope = float(centred @ height / (centred @ centred))
    return slope, float(height.mean() - slope * ratio.mean())
