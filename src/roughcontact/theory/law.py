"""The predictions of a theory for a loading curve, for comparison with any curve."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.errors import InputError
from roughcontact.validation import Array, number

if TYPE_CHECKING:
    from roughcontact.theory.random_surfaces.waves import Spectrum

__all__ = ["LoadingLaw", "Scope", "composed", "over_area"]


@dataclass(frozen=True, slots=True, eq=False)
class Scope:
    """The contact for which a law was made.

    Parameters
    ----------
    modulus : float
        Reduced modulus E* [Pa].
    area : float
        Nominal area [m^2].
    rms : float
        Root mean square of the heights [m].
    spectrum : Waves, measured or continuous spectrum, optional
        Spectrum that the law took from the surface; None if it needs none.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((32, 32), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> [law] = rc.loading_laws(surface, 1e9, "persson")
    >>> f"{law.made_for.area * 1e12:.0f} um^2, rms {law.made_for.rms * 1e9:.0f} nm"
    '1024 um^2, rms 100 nm'
    """

    modulus: float
    area: float
    rms: float
    spectrum: Spectrum | None = None


@dataclass(frozen=True, eq=False, repr=False)
class LoadingLaw:
    """A theory's quantities as functions of the normal force.

    Parameters
    ----------
    name : str
        Name of the theory, for legends: ``"Persson"``.
    source : str
        Paper, or thesis and equation number.
    quantities : mapping of str to callable
        Maps the name of a quantity of a curve (``"stiffness"`` [N/m], ``"interfacial_stiffness"`` [N/m],
        ``"contact_area"`` [m^2], ``"mean_gap"`` [m], ``"depth"`` [m], ``"elastic_energy"`` [J], ``"spots"`` [-]) to
        a function of an array of forces [N] that returns an array of its shape.
    domain : tuple of float
        Lowest and highest force [N] at which the theory holds.
    made_for : Scope, optional
        The contact for which `roughcontact.loading_laws` made it: it is compared with the curve of another contact
        only on request.
    plastic : bool
        Whether its stiffness includes spots that have yielded, unlike the stiffness of a curve with a hardness.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.theory.law import LoadingLaw
    >>> spring = LoadingLaw("spring", "Hooke", {"depth": lambda force: force / 1e6}, domain=(0.0, 10.0))
    >>> spring.predict("depth", np.array([1.0, 20.0]))
    array([1.e-06,    nan])
    >>> law = spring.derived("depth", {"elastic_energy": lambda depth: 1e6 * depth**2 / 2})
    >>> law, float(law.predict("elastic_energy", 1.0))
    (LoadingLaw(spring: elastic_energy), 5e-07)
    """

    name: str
    source: str
    quantities: Mapping[str, Callable[[Array], Array]]
    domain: tuple[float, float] = (0.0, math.inf)
    made_for: Scope | None = None
    plastic: bool = False

    def predict(self, quantity: str, force: float | Array) -> Array:
        """Return a quantity at the forces [N]; NaN outside the domain.

        Parameters
        ----------
        quantity : str
            Name of one of the quantities.
        force : float or array
            Normal forces [N].

        Returns
        -------
        float or array
            In the unit of the quantity, of the shape of the forces.

        Raises
        ------
        ValueError
            If the theory does not predict the quantity, or a force is not a number.

        Examples
        --------
        >>> from roughcontact.theory import hertz
        >>> law = hertz.law(radius=1e-2, modulus=1e11)
        >>> f"{float(law.predict('stiffness', 1.0)) / 1e6:.2f} N/um"
        '8.43 N/um'
        >>> (law.predict("contact_area", [1.0, 8.0]) * 1e12).round()  # [um^2], as F^(2/3)
        array([ 5587., 22349.])
        """
        if quantity not in self.quantities:
            raise InputError(f"{self.name} has no {quantity!r}; it has {sorted(self.quantities)}")
        given = np.atleast_1d(number(force, "force [N]"))
        inside = (given >= self.domain[0]) & (given <= self.domain[1])
        values = np.full(given.shape, np.nan)
        if inside.any():
            values[inside] = self.quantities[quantity](given[inside])
        return values.reshape(np.shape(force))

    def derived(self, quantity: str, functions: Mapping[str, Callable[[Array], Array]]) -> LoadingLaw:
        """Return the law of quantities that follow from a single quantity of this law.

        Parameters
        ----------
        quantity : str
            Its name.
        functions : mapping of str to callable
            Functions of the values of this quantity, by the names of the derived quantities.

        Returns
        -------
        LoadingLaw
            The law of the same theory, on the same domain.

        Raises
        ------
        ValueError
            If the theory does not predict the quantity.
        """
        if quantity not in self.quantities:
            raise InputError(f"{self.name} has no {quantity!r}; it has {sorted(self.quantities)}")
        found = self.quantities[quantity]
        return replace(self, quantities={name: composed(of, found) for name, of in functions.items()})

    def __repr__(self) -> str:
        """Return the name of the theory and its quantities."""
        return f"LoadingLaw({self.name}: {', '.join(sorted(self.quantities))})"


def composed(outer: Callable[[Array], Array], inner: Callable[[Array], Array]) -> Callable[[Array], Array]:
    """Return ``outer(inner(force))`` as a function that can be pickled if both can.

    Parameters
    ----------
    outer, inner : Callable[[Array], Array]
        Functions of an array.

    Returns
    -------
    Callable[[Array], Array]

    Examples
    --------
    >>> from math import exp, log
    >>> from roughcontact.theory.law import composed
    >>> round(composed(exp, log)(2.0), 12)
    2.0
    """
    return partial(_composed, outer, inner)


def _composed(outer: Callable[[Array], Array], inner: Callable[[Array], Array], force: Array) -> Array:
    return outer(inner(force))


def over_area(quantity: Callable[[Array], Array], area: float, force: Array) -> Array:
    """Return the total over a nominal area [m^2] of a quantity per area, a function of the nominal pressure [Pa].

    Parameters
    ----------
    quantity : Callable[[Array], Array]
        Quantity per area as a function of the nominal pressure [Pa].
    area : float
        Nominal area A0 [m^2].
    force : float or array
        Normal forces [N].

    Returns
    -------
    float or array
        Total over the area.

    Examples
    --------
    >>> from roughcontact.theory.law import over_area
    >>> over_area(lambda pressure: 2 * pressure, 1e-6, 3.0)
    6.0
    """
    return area * quantity(force / area)
