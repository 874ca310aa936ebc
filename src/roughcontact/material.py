"""Elastic solids, and the reduced modulus of a pair of them."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from roughcontact.errors import InputError, about
from roughcontact.guesses import hinted
from roughcontact.validation import moderate, require_numbers, shown

__all__ = ["Bodies", "Solid", "inverse_sum", "pair_of", "require_solid"]


@hinted
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
            raise about("poisson_ratio", f"must be above -1 and at most 0.5, not {self.poisson_ratio}")

    @property
    def shear_modulus(self) -> float:
        """Shear modulus, E / 2(1 + nu) [Pa]."""
        return self.young_modulus / (2 * (1 + self.poisson_ratio))


Bodies = Solid | tuple[Solid, Solid]


def pair_of(bodies: Bodies) -> tuple[Solid, Solid | None]:
    """Return the two bodies of a contact; None for a rigid one.

    Raises
    ------
    ValueError
        If `bodies` is neither a Solid nor a pair of Solids.
    """
    if isinstance(bodies, Solid):
        return bodies, None
    if isinstance(bodies, tuple) and len(bodies) == 2:
        return bodies
    raise InputError(
        f"a Solid or a pair of Solids is needed, not {shown(bodies)}; E* does not determine how bodies shear",
        place="bodies",
    )


def require_solid(body: Any) -> Solid:
    """Return `body` if it is a Solid.

    Raises
    ------
    ValueError
        If `body` is not a Solid.
    """
    if not isinstance(body, Solid):
        raise InputError(
            f"a Solid (young_modulus, poisson_ratio) is needed, not {shown(body)}",
            "give for example rc.Solid(210e9, 0.3), or use names: rc.reduced_modulus('steel', 'aluminium')",
        )
    return body


def inverse_sum(compliances: Iterable[float]) -> float:
    """Return the modulus [Pa] of bodies whose compliances [1/Pa] add up.

    Raises
    ------
    ValueError
        If all bodies are rigid.
    """
    compliance = sum(compliances)
    if compliance == 0:
        raise InputError(
            "two rigid bodies have no reduced modulus", "give one of them a finite young_modulus"
        )
    return 1 / compliance
