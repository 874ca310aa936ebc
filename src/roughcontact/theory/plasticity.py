"""Plasticity indices: whether asperities of a surface yield before they are crushed, at any load.

Two forms of one idea: the pressure in the contact spots of an elastic surface hardly depends on the load, so
its ratio to the hardness tells the kind of contact from roughness and material alone.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from roughcontact.theory.nayak import summits
from roughcontact.theory.profile_moments import ProfileMoments, moment
from roughcontact.validation import numeric, positive

__all__ = ["PlasticityIndex", "asperity_index", "slope_index"]


@dataclass(frozen=True, slots=True, repr=False)
class PlasticityIndex:
    """An index with the limits its authors gave it.

    Attributes
    ----------
    value : float
        [-].
    elastic_below : float
        Contact is elastic at any usual load if the index is lower.
    plastic_above : float
        Contact is plastic at the lightest load if it is higher; infinite where the source states none.
    """

    value: float
    elastic_below: float
    plastic_above: float

    @property
    def regime(self) -> str:
        """What the index predicts: "elastic", "plastic", or "mixed", where it depends on the load."""
        if self.value < self.elastic_below:
            return "elastic"
        return "plastic" if self.value > self.plastic_above else "mixed"

    def __repr__(self) -> str:
        """Say the index, what it predicts, and by which limits."""
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
        m2 [-]; on a fractal with H <= 1 it grows without limit as shorter waves come into view.
    modulus : float
        Reduced modulus E* [Pa].
    hardness : float
        Indentation hardness of the softer body sigma_0 [Pa].

    Notes
    -----
    The thesis names Greenwood and Williamson, whose own index is `asperity_index`; one of slopes is Mikic's (Int. J.
    Heat Mass Transfer 17, 205 (1974)). On a Gaussian surface their ratio is a function of Nayak's parameter.
    """
    slope = math.sqrt(2 * moment(moments, "m2", " (it is infinite without a shortest wave)"))
    return PlasticityIndex(slope * _ratio(modulus, hardness), 2 / 3, math.inf)


@numeric
def asperity_index(moments: ProfileMoments, modulus: float, hardness: float) -> PlasticityIndex:
    """Return ``(E*/sigma_0) sqrt(s/R)`` of the summits; elastic below 0.6, plastic above 1.

    Parameters
    ----------
    moments, modulus, hardness
        See `slope_index`. The summits' standard deviation s and mean radius R are those of `nayak.summits`.

    Notes
    -----
    Greenwood and Williamson, Proc. R. Soc. A 295, 300 (1966): with it the nominal pressure at which a fiftieth of
    the contact area has begun to yield falls from above any usual one to next to nothing.
    """
    mean = summits(moments)
    return PlasticityIndex(math.sqrt(mean.std / mean.radius) * _ratio(modulus, hardness), 0.6, 1.0)


def _ratio(modulus: float, hardness: float) -> float:
    return float(positive(modulus, "the reduced modulus [Pa]") / positive(hardness, "the hardness [Pa]"))
