"""Summits of a surface, as the discrete asperity model takes them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from roughcontact.validation import Array, number, positive, require, require_numbers

__all__ = ["Asperities"]


@dataclass(frozen=True, slots=True, eq=False)
class Asperities:
    """Summits of a surface on an elastic half-space.

    Parameters
    ----------
    x, y : array, shape (n,)
        Where they are [m]. From the summits of a surface: columns and rows times the spacing.
    height : array, shape (n,)
        Above any common plane [m].
    radius : array, shape (n,)
        Radius of curvature [m].
    modulus : float
        Reduced modulus E* [Pa].

    Raises
    ------
    ValueError
        If the arrays are not of one length, not finite, a radius is not positive, or two summits are in one place.

    Examples
    --------
    >>> import numpy as np
    >>> from roughcontact.theory import asperities
    >>> x, y = np.array([0.0, 1e-3]), np.zeros(2)
    >>> summits = asperities.Asperities(x, y, np.array([0.0, -1e-6]), np.full(2, 1e-3), modulus=1e9)
    >>> summits.fall.tolist(), asperities.press(summits, depth=5e-7).count  # the lower one is not reached
    ([0.0, 1e-06], 1)
    """

    x: Array
    y: Array
    height: Array
    radius: Array
    modulus: float

    def __post_init__(self) -> None:
        require_numbers(self)
        for name in ("x", "y", "height", "radius"):
            given = np.array(number(getattr(self, name), f"{name} [m]"), ndmin=1)
            require(np.isfinite(given), f"{name} must be finite [m]")
            require(
                given.ndim == 1 and given.size > 0 and given.size == np.size(self.x),
                f"x, y, height and radius must be of one length above 0, not {name} of shape {given.shape}",
            )
            object.__setattr__(self, name, given)
        positive(self.radius, "a radius [m]")
        positive(self.modulus, "the reduced modulus [Pa]")
        places = np.unique(np.stack([self.x, self.y]), axis=1)
        require(places.shape[1] == self.x.size, "two summits are in the same place: leave the lower one out")

    @property
    def fall(self) -> Array:
        """Of each summit below the highest one [m], shape (n,)."""
        return np.asarray(self.height.max() - self.height)

    @property
    def coefficient(self) -> Array:
        """Of Hertz' law, force over compression to the power 3/2 [N/m^1.5], shape (n,)."""
        return np.asarray(4 / 3 * self.modulus * np.sqrt(self.radius))
