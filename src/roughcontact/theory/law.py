"""What a theory says about a loading curve, as a value that can be laid over any curve."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.validation import number

__all__ = ["LoadingLaw", "over_area"]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False, repr=False)
class LoadingLaw:
    """A theory's quantities as functions of the normal force.

    Parameters
    ----------
    name : str
        Of the theory, for legends: ``"Persson"``.
    source : str
        Paper, or thesis and equation number.
    quantities : mapping of str to callable
        From the name of a curve's quantity (``"stiffness"`` [N/m], ``"interfacial_stiffness"`` [N/m],
        ``"contact_area"`` [m^2], ``"mean_gap"`` [m], ``"depth"`` [m], ``"elastic_energy"`` [J], ``"spots"`` [-]) to
        a function of an array of forces [N] that returns an array of its shape.
    domain : tuple of float
        Lowest and highest force [N] at which the theory claims to hold.
    """

    name: str
    source: str
    quantities: Mapping[str, Callable[[Array], Array]]
    domain: tuple[float, float] = (0.0, math.inf)

    def predict(self, quantity: str, force: float | Array) -> Array:
        """Return a quantity at the forces [N]; NaN outside the domain.

        Raises
        ------
        ValueError
            If the theory says nothing about the quantity, or a force is no number.
        """
        if quantity not in self.quantities:
            raise ValueError(
                f"{self.name} says nothing about {quantity!r}, only about {sorted(self.quantities)}"
            )
        given = np.atleast_1d(number(force, "force [N]"))
        inside = (given >= self.domain[0]) & (given <= self.domain[1])
        values = np.full(given.shape, np.nan)
        if inside.any():
            values[inside] = self.quantities[quantity](given[inside])
        return values.reshape(np.shape(force))

    def __repr__(self) -> str:
        """Say whose theory it is and what it is about."""
        return f"LoadingLaw({self.name}: {', '.join(sorted(self.quantities))})"


def over_area(quantity: Callable[[Array], Array], area: float, force: Array) -> Array:
    """Return what a nominal area [m^2] has in all of a quantity per area, a function of the nominal pressure [Pa]."""
    return area * quantity(force / area)
