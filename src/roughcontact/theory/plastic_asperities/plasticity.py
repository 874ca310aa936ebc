"""Plasticity indices: whether the asperities of a surface yield, at any load.

There are two forms of one idea: the pressure in the contact spots of an elastic surface is almost independent of the
load. Its ratio to the hardness therefore determines the regime from only roughness and material.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roughcontact.theory.random_surfaces.nayak import summits
from roughcontact.theory.random_surfaces.profile_moments import ProfileMoments, moment
from roughcontact.validation import Array, number, numeric, positive, require

__all__ = ["PlasticityIndex", "asperity_index", "slope_index", "summit_index"]

ELASTIC_BELOW, PLASTIC_ABOVE = 0.6, 1.0  # Greenwood and Williamson (1966)


@dataclass(frozen=True, slots=True, repr=False)
class PlasticityIndex:
    """An index with the limits given by its authors.

    Attributes
    ----------
    value : float
        [-].
    elastic_below : float
        Contact is elastic at any usual load if the index is lower.
    plastic_above : float
        Contact is plastic at the lightest load if the index is higher; infinite if the source states none.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import plasticity
    >>> index = plasticity.asperity_index(rc.Moments(1e-12, 0.005, 1e9), 1e11, 8e10)
    >>> f"{index.value:.2f}", index.elastic_below, index.plastic_above, index.regime
    ('0.27', 0.6, 1.0, 'elastic')
    """

    value: float
    elastic_below: float
    plastic_above: float

    @property
    def regime(self) -> str:
        """The predicted regime: "elastic", "plastic", or "mixed", where it depends on the load."""
        if self.value < self.elastic_below:
            return "elastic"
        return "plastic" if self.value > self.plastic_above else "mixed"

    def __repr__(self) -> str:
        """Return the index, the predicted regime, and the limits."""
        limits = f"elastic below {self.elastic_below:.3g}"
        if math.isfinite(self.plastic_above):
            limits += f", plastic above {self.plastic_above:.3g}"
        return f"PlasticityIndex({self.value:.4g}, {self.regime}: {limits})"


@numeric
def slope_index(moments: ProfileMoments, modulus: float, hardness: float) -> PlasticityIndex:
    """Return ``E* g/sigma_0`` of a surface with rms slope g = sqrt(2 m2); elastic below 2/3 (thesis, eq. 4.17).

    Parameters
    ----------
    moments : ProfileMoments
        m2 [-]; on a fractal with H <= 1 it diverges as shorter waves are included.
    modulus : float
        Reduced modulus E* [Pa].
    hardness : float
        Indentation hardness of the softer body sigma_0 [Pa].

    Returns
    -------
    PlasticityIndex

    Notes
    -----
    The thesis cites Greenwood and Williamson, whose index is `asperity_index`; the index from slopes is Mikic's (Int.
    J. Heat Mass Transfer 17, 205 (1974)). On a Gaussian surface their ratio is a function of Nayak's parameter.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import plasticity
    >>> plasticity.slope_index(rc.Moments(1e-12, 0.005, 1e9), 1e11, 2e9)
    PlasticityIndex(5, mixed: elastic below 0.667)
    """
    slope = math.sqrt(2 * moment(moments, "m2", " (it is infinite without a shortest wave)"))
    return PlasticityIndex(slope * _ratio(modulus, hardness), 2 / 3, math.inf)


@numeric
def asperity_index(moments: ProfileMoments, modulus: float, hardness: float) -> PlasticityIndex:
    """Return ``(E*/sigma_0) sqrt(s/R)`` of the summits; elastic below 0.6, plastic above 1.

    Parameters
    ----------
    moments : ProfileMoments
        Moments for `nayak.summits`, which returns the standard deviation s and the mean radius R of the summits.
    modulus : float
        Reduced modulus E* [Pa].
    hardness : float
        Indentation hardness of the softer body sigma_0 [Pa].

    Returns
    -------
    PlasticityIndex

    Notes
    -----
    Greenwood and Williamson, Proc. R. Soc. A 295, 300 (1966): as it rises between these limits, the nominal pressure
    at which a fiftieth of the contact area has begun to yield falls from above any usual pressure to almost zero.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import plasticity
    >>> plasticity.asperity_index(rc.Moments(1e-12, 0.005, 1e9), 1e11, 2e10).regime
    'plastic'
    """
    mean = summits(moments)
    value = math.sqrt(mean.std / mean.radius) * _ratio(modulus, hardness)
    return PlasticityIndex(value, ELASTIC_BELOW, PLASTIC_ABOVE)


@numeric
def summit_index(height: Array, curvature: Array, modulus: float, hardness: float) -> PlasticityIndex:
    """Return ``(E*/sigma_0) sqrt(s kappa)`` of summits that were found on a surface; limits as for `asperity_index`.

    Parameters
    ----------
    height : array, shape (n,)
        Height of each summit above a common plane [m]; s is their standard deviation.
    curvature : array, shape (n,)
        Mean curvature of each summit [1/m]; kappa is the mean of all.
    modulus : float
        Reduced modulus E* [Pa].
    hardness : float
        Indentation hardness of the softer body sigma_0 [Pa].

    Returns
    -------
    PlasticityIndex

    Raises
    ------
    ValueError
        If there are fewer than two summits, heights and curvatures are not finite or differ in number, or the mean
        curvature is not positive.

    Notes
    -----
    Greenwood and Williamson, Proc. R. Soc. A 295, 300 (1966). On an isotropic Gaussian surface whose shortest waves are
    well resolved it is `asperity_index`; it is also defined for any other surface. Spikes of a measurement count as
    summits: remove them first.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> from roughcontact.theory import plasticity
    >>> grid = rc.Grid((128, 128), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, 0.8, 1e-6, np.random.default_rng(0), short_cutoff=16e-6)
    >>> summits = rc.find_summits(surface)
    >>> plasticity.summit_index(summits.height, summits.mean_curvature, 1e10, 1e10).regime
    'elastic'
    """
    heights, curvatures = (
        np.ravel(number(each, name)) for each, name in ((height, "height"), (curvature, "curvature"))
    )
    require(
        heights.size == curvatures.size and heights.size > 1,
        f"an index needs heights and curvatures of at least two summits, not {heights.size} and {curvatures.size}",
    )
    for each, name in ((heights, "height [m]"), (curvatures, "curvature [1/m]")):
        require(np.isfinite(each), f"every {name} of a summit must be finite")
    kappa = float(positive(float(curvatures.mean()), "the mean curvature of the summits [1/m]"))
    value = math.sqrt(float(heights.std()) * kappa) * _ratio(modulus, hardness)
    return PlasticityIndex(value, ELASTIC_BELOW, PLASTIC_ABOVE)


def _ratio(modulus: float, hardness: float) -> float:
    return float(positive(modulus, "the reduced modulus [Pa]") / positive(hardness, "the hardness [Pa]"))
