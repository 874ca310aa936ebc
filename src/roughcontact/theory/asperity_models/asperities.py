"""The discrete asperity model: each summit of a surface a Hertz contact that pushes all others down.

Ciavarella, Delfine and Demelio (J. Mech. Phys. Solids 54, 2569 (2006); thesis, figs 31 and 32). Position, height and
curvature of each summit are taken from the surface; outside its contact it displaces the half-space like a point
force. Without interaction the model is Greenwood and Williamson's theory for this one surface.

The model holds for separate spots: two equal spheres carry the force of the exact solution to 0.1 % until their spots
touch. For merged spots, counted by `AsperityContact.merged`, it is an estimate.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from roughcontact.theory.asperity_models.asperity_balance import Asperities, balance, independent_depth
from roughcontact.theory.law import LoadingLaw
from roughcontact.validation import Array, numeric, positive, require

__all__ = ["Asperities", "AsperityContact", "law", "press"]

SOURCE = "Ciavarella, Delfine and Demelio, J. Mech. Phys. Solids 54, 2569 (2006)"


@dataclass(frozen=True, slots=True, eq=False)
class AsperityContact:
    """Summits pressed by a flat.

    Attributes
    ----------
    asperities : Asperities
    compression : array, shape (n,)
        Compression of each summit relative to the half-space around it [m]; 0 without contact.
    depth : float
        Displacement of the flat since it touched the highest summit [m].
    stiffness : float
        dF/dd at constant contact area [N/m]. With interaction d is the approach of the bodies, as in thesis eq. 4.1;
        without it, the stiffness is that of only the summits, an interfacial stiffness.
    interaction : bool
        Whether summits push each other down.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.theory import asperities
    >>> x, flat = np.array([0.0, 1e-4]), np.zeros(2)
    >>> two = asperities.Asperities(x, flat, flat, np.full(2, 1e-3), 1e9)
    >>> alone, together = (asperities.press(two, force=0.1, interaction=each) for each in (False, True))
    >>> together.count, f"{together.depth / alone.depth:.2f} times as deep, since each lowers the other"
    (2, '1.14 times as deep, since each lowers the other')
    """

    asperities: Asperities
    compression: Array
    depth: float
    stiffness: float
    interaction: bool

    @property
    def forces(self) -> Array:
        """Force on each summit [N], shape (n,)."""
        return self.asperities.coefficient * self.compression**1.5

    @property
    def spot_radius(self) -> Array:
        """Radius of each contact spot [m], shape (n,)."""
        return np.asarray(np.sqrt(self.asperities.radius * self.compression))

    @property
    def force(self) -> float:
        """Total force [N]."""
        return float(self.forces.sum())

    @property
    def plane(self) -> float:
        """Height of the flat, counted like those of the summits [m]."""
        return float(self.asperities.height.max()) - self.depth

    @property
    def contact_area(self) -> float:
        """Sum of the areas of all spots [m^2]; the overlap of merged spots counts twice."""
        return float(np.pi * (self.asperities.radius * self.compression).sum())

    @property
    def count(self) -> int:
        """Number of summits in contact."""
        return int((self.compression > 0).sum())

    @property
    def elastic_energy(self) -> float:
        """Work done by the flat [J]: 2/5 of force times compression, and half of force times deflection."""
        touching = self.compression > 0
        forces, compression = self.forces[touching], self.compression[touching]
        deflection = self.depth - self.asperities.fall[touching] - compression
        return float(forces @ (0.4 * compression + 0.5 * deflection * self.interaction))

    @property
    def merged(self) -> int:
        """Number of spots that overlap another one: if it is not 0, the model is outside its domain."""
        touching = self.compression > 0
        x, y, a = self.asperities.x[touching], self.asperities.y[touching], self.spot_radius[touching]
        apart = (x[:, None] - x) ** 2 + (y[:, None] - y) ** 2 >= (a[:, None] + a) ** 2
        np.fill_diagonal(apart, True)
        return int((~apart).any(axis=1).sum())


@numeric
def press(
    asperities: Asperities,
    *,
    force: float | None = None,
    depth: float | None = None,
    interaction: bool = True,
) -> AsperityContact:
    """Press a flat against summits.

    Parameters
    ----------
    asperities : Asperities
        At most a few thousand of them in contact: their mutual influence is a dense matrix.
    force, depth : float
        One of the two: the total force [N], or the displacement of the flat since first touch [m].
    interaction : bool
        Whether summits push each other down.

    Returns
    -------
    AsperityContact

    Raises
    ------
    ValueError
        If not exactly one of force and depth is given, or it is not positive, or too many summits are in reach.
    RuntimeError
        If the iteration does not converge, which has not been observed for separate spots.

    Notes
    -----
    Every summit is in balance: ``compression = depth - fall - sum_j F_j/(pi E* r_j)``, or its force is 0 if that is
    negative. Inside the spot of another summit r is taken as the radius of the spot.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.theory import asperities
    >>> x, flat = np.array([0.0, 1e-3]), np.zeros(2)
    >>> two = asperities.Asperities(x, flat, flat, np.full(2, 1e-3), 1e9)
    >>> contact = asperities.press(two, force=2.0)  # two equal summits share the force
    >>> contact.forces.round(6).tolist(), contact.merged
    ([1.0, 1.0], 0)
    """
    require((force is None) != (depth is None), "give either a force [N] or a depth [m]")
    if force is not None:
        depth = independent_depth(asperities, float(positive(force, "the force [N]")))
    depth = float(positive(depth or 0.0, "the depth [m]"))
    if interaction:
        return AsperityContact(asperities, *balance(asperities, depth, force), interaction)
    compression = np.maximum(depth - asperities.fall, 0.0)
    stiffness = float(2 * asperities.modulus * np.sqrt(asperities.radius * compression).sum())
    return AsperityContact(asperities, compression, depth, stiffness, interaction)


def law(asperities: Asperities, *, interaction: bool = True) -> LoadingLaw:
    """Return the model as functions of the force.

    Parameters
    ----------
    asperities : Asperities
    interaction : bool
        See `press`.

    Returns
    -------
    LoadingLaw
        "contact_area", "spots" and "elastic_energy"; with interaction "depth" and "stiffness", those of the approach
        of the bodies; without it only "interfacial_stiffness", because there is no body beneath the summits. Each call
        solves for all forces again. The law has no upper force: `AsperityContact.merged` counts the merged spots.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.theory import asperities
    >>> one = asperities.Asperities(np.zeros(1), np.zeros(1), np.zeros(1), np.full(1, 1e-3), 1e9)
    >>> law = asperities.law(one)  # a single summit is Hertz' sphere: F = (4/3) E* R^(1/2) d^(3/2)
    >>> round(float(4 / 3 * 1e9 * 1e-3**0.5 * law.predict("depth", 2.0) ** 1.5), 6)
    2.0
    """
    found = {
        "contact_area": "contact_area",
        "spots": "count",
        "elastic_energy": "elastic_energy",
        "stiffness" if interaction else "interfacial_stiffness": "stiffness",
        **({"depth": "depth"} if interaction else {}),
    }
    quantities = {name: partial(_of, asperities, interaction, value) for name, value in found.items()}
    name = "Interacting asperities" if interaction else "Independent asperities"
    return LoadingLaw(name, SOURCE, quantities, domain=(math.ulp(0.0), math.inf))


def _of(asperities: Asperities, interaction: bool, quantity: str, force: Array) -> Array:
    contacts = (press(asperities, force=one, interaction=interaction) for one in force)
    return np.array([getattr(contact, quantity) for contact in contacts])
