"""Elastic solids and the moduli that a pair of them presents to a contact."""

from __future__ import annotations

import math
from dataclasses import dataclass

from roughcontact.errors import InputError, about
from roughcontact.validation import moderate, require_numbers, scalar, shown

__all__ = ["Bodies", "Solid", "as_modulus", "pair_of", "reduced_modulus", "reduced_shear_modulus"]


@dataclass(frozen=True, slots=True)
class Solid:
    """An isotropic, linearly elastic solid.

    Parameters
    ----------
    young_modulus : float
        Young's modulus [Pa]; infinite for a rigid body.
    poisson_ratio : float
        Poisson's ratio, above -1 and at most 1/2.

    Examples
    --------
    >>> import roughcontact as rc
    >>> steel = rc.Solid(young_modulus=210e9, poisson_ratio=0.3)
    >>> f"{steel.shear_modulus / 1e9:.2f} GPa"
    '80.77 GPa'
    """

    young_modulus: float
    poisson_ratio: float

    def __post_init__(self) -> None:
        require_numbers(self, young_modulus="Pa")
        if not self.young_modulus > 0:
            raise about("young_modulus", f"must be positive [Pa], not {self.young_modulus}")
        if self.young_modulus < math.inf:
            moderate(self.young_modulus, "young_modulus [Pa]")
        if not -1 < self.poisson_ratio <= 0.5:
            raise about("poisson_ratio", f"must lie above -1 and at most at 0.5, not {self.poisson_ratio}")

    @property
    def shear_modulus(self) -> float:
        """Shear modulus, E / 2(1 + nu) [Pa]."""
        return self.young_modulus / (2 * (1 + self.poisson_ratio))


Bodies = Solid | tuple[Solid, Solid]


def reduced_modulus(first: Solid, second: Solid | None = None) -> float:
    """Return the reduced modulus E* of two solids (thesis, eq. 4.3).

    1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2.

    Parameters
    ----------
    first : Solid
    second : Solid, optional
        The other body; by default it is rigid.

    Returns
    -------
    float
        E* [Pa].

    Raises
    ------
    ValueError
        If a body is not a `Solid`, or both are rigid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> f"{rc.reduced_modulus(rc.Solid(210e9, 0.3), rc.Solid(70e9, 0.33)) / 1e9:.2f} GPa"
    '58.61 GPa'
    """
    compliance = sum((1 - s.poisson_ratio**2) / s.young_modulus for s in _bodies(first, second))
    return _inverse(compliance)


def reduced_shear_modulus(first: Solid, second: Solid | None = None) -> float:
    """Return the reduced shear modulus G* of two solids (beside thesis, eq. 4.5).

    1/G* = (2 - nu1)/(4 G1) + (2 - nu2)/(4 G2), so that k/k_t = E*/G* for a circle.

    Parameters
    ----------
    first : Solid
    second : Solid, optional
        The other body; by default it is rigid.

    Returns
    -------
    float
        G* [Pa].

    Raises
    ------
    ValueError
        If a body is not a `Solid`, or both are rigid.

    Examples
    --------
    >>> import roughcontact as rc
    >>> steel = rc.Solid(210e9, 0.3)
    >>> f"k/k_t = {rc.reduced_modulus(steel) / rc.reduced_shear_modulus(steel):.4f} = (1 - nu/2)/(1 - nu)"
    'k/k_t = 1.2143 = (1 - nu/2)/(1 - nu)'
    """
    compliance = sum((2 - s.poisson_ratio) / (4 * s.shear_modulus) for s in _bodies(first, second))
    return _inverse(compliance)


def as_modulus(modulus: float | Solid | tuple[Solid, Solid]) -> float:
    """Return the reduced modulus E* [Pa] of a number, a solid, or a pair of solids.

    Raises
    ------
    ValueError
        If the modulus is not positive and finite.
    """
    if isinstance(modulus, Solid):
        value = reduced_modulus(modulus)
    elif isinstance(modulus, tuple):
        if len(modulus) != 2:
            raise InputError(
                f"two solids have a reduced modulus, not {len(modulus)}",
                "give one Solid, or a pair",
                place="modulus",
            )
        value = reduced_modulus(*modulus)
    else:
        value = scalar(modulus, "reduced modulus")
    if not (math.isfinite(value) and value > 0):
        raise InputError(f"the reduced modulus must be positive and finite [Pa], not {value}")
    return moderate(value, "the reduced modulus [Pa]")


def pair_of(bodies: Bodies) -> tuple[Solid, Solid | None]:
    """Return the two bodies of a contact; None for a rigid one.

    Raises
    ------
    ValueError
        If what is given is neither a Solid nor two of them.
    """
    if isinstance(bodies, Solid):
        return bodies, None
    if isinstance(bodies, tuple) and len(bodies) == 2:
        return bodies
    raise InputError(
        f"a Solid or a pair of Solids is wanted, since E* alone does not say how bodies shear, not {shown(bodies)}",
        place="bodies",
    )


def _bodies(first: Solid, second: Solid | None) -> tuple[Solid, ...]:
    bodies = (first,) if second is None else (first, second)
    for body in bodies:
        if not isinstance(body, Solid):
            raise InputError(f"a Solid is wanted (young_modulus, poisson_ratio), not {body!r}")
    return bodies


def _inverse(compliance: float) -> float:
    if compliance == 0:
        raise InputError(
            "two rigid bodies have no reduced modulus", "give one of them a finite young_modulus"
        )
    return 1 / compliance
