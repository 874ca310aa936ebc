r"""Linear viscoelastic materials as a spring, a dashpot and Maxwell elements in parallel.

The reduced modulus E* becomes a relaxation function E(t), its compliance a creep function J(t); Poisson's ratio is
constant in time.

    E(t) = c delta(t) + E_inf + sum E_k exp(-t/tau_k)         J(t) = J_0 + t/eta_0 + sum J_j (1 - exp(-t/theta_j))

with the identity that the convolution of E with dJ is 1 (Lee & Radok, J. Appl. Mech. 27, 438 (1960)).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import brentq

from roughcontact.errors import InputError, about
from roughcontact.validation import Array, number, scalar, shown

__all__ = ["Creep", "Viscoelastic", "checked_material"]


@dataclass(frozen=True, slots=True)
class Creep:
    """J(t) as a sum of instantaneous, viscous, and retarded parts.

    Attributes
    ----------
    instantaneous : float
        J_0 [1/Pa].
    fluidity : float
        1/eta_0 [1/(Pa s)].
    compliances, times : tuple of float
        J_j [1/Pa] and theta_j [s].

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> creep = viscoelastic.standard_solid(1e8, 1e9, 1.0).creep()
    >>> [round(float(creep(t)) * 1e9, 3) for t in (0.0, 1000.0)], creep.times  # 1/E_0 and 1/E_inf; tau E_0/E_inf
    ([1.0, 10.0], (10.0,))
    """

    instantaneous: float
    fluidity: float
    compliances: tuple[float, ...]
    times: tuple[float, ...]

    def __call__(self, time: float | Array) -> Array:
        """Return J(t) [1/Pa] at times >= 0 [s]."""
        t = _times(time)
        retarded = (J * -np.expm1(-t / theta) for J, theta in zip(self.compliances, self.times, strict=True))
        return self.instantaneous + self.fluidity * t + sum(retarded)


@dataclass(frozen=True, slots=True)
class Viscoelastic:
    """A linear viscoelastic half-space in terms of its reduced modulus.

    Made by `viscous`, `kelvin_voigt`, `maxwell`, `standard_solid` and `prony`.

    Parameters
    ----------
    equilibrium : float
        E_inf, the value of E* after a long time [Pa]; 0 for a fluid.
    moduli, times : tuple of float
        E_k [Pa] and the different relaxation times tau_k [s] of the Maxwell elements.
    dashpot : float
        c of a parallel dashpot [Pa s]; with a dashpot, no jump of the depth is possible.

    Raises
    ------
    ValueError
        If a number is negative, two times are equal, or all moduli and viscosities are zero.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Viscoelastic(equilibrium=1e6, moduli=(4e6, 5e6), times=(0.1, 1.0))
    >>> rubber.instantaneous, round(float(rubber.relaxation(100.0))), round(float(rubber.creep()(0.0)) * 1e6, 6)
    (10000000.0, 1000000, 0.1)
    """

    equilibrium: float = 0.0
    moduli: tuple[float, ...] = ()
    times: tuple[float, ...] = ()
    dashpot: float = 0.0

    def __post_init__(self) -> None:
        if len(self.moduli) != len(self.times):
            raise InputError(
                f"each modulus needs its time: {len(self.moduli)} moduli and {len(self.times)} times are given"
            )
        for name, values in (("modulus", (self.equilibrium, *self.moduli)), ("time", self.times)):
            for value in values:
                scalar(value, f"{name} of a viscoelastic material")
        scalar(self.dashpot, "viscosity")
        if not all(math.isfinite(v) and v >= 0 for v in (self.equilibrium, self.dashpot)):
            raise about("moduli", f"and viscosities must not be negative: {self.equilibrium}, {self.dashpot}")
        if not all(math.isfinite(v) and v > 0 for v in (*self.moduli, *self.times)):
            raise InputError(
                f"moduli {self.moduli} and times {self.times} of elements must be positive", place="moduli"
            )
        if len(set(self.times)) != len(self.times):
            raise InputError(f"the relaxation times of the elements must differ: {self.times}")
        if self.equilibrium == 0 and self.dashpot == 0 and not self.moduli:
            raise InputError("a material needs a modulus or a viscosity")

    @property
    def instantaneous(self) -> float:
        """E_inf + sum E_k, the modulus under a sudden load if there is no dashpot [Pa]."""
        return self.equilibrium + math.fsum(self.moduli)

    def relaxation(self, time: float | Array) -> Array:
        """Return E(t) [Pa] at times >= 0 [s], at 0 the limit from above; a dashpot adds the pulse c delta(t).

        Parameters
        ----------
        time : float or array
            Times, not negative [s].

        Returns
        -------
        float or array
            E(t) [Pa].
        """
        t = _times(time)
        return self.equilibrium + sum(
            (E * np.exp(-t / tau) for E, tau in zip(self.moduli, self.times, strict=True)), np.zeros_like(t)
        )

    def creep(self) -> Creep:
        """Return the creep function.

        Its retardation times theta_j are the roots s = -1/theta of c s + E_inf + sum E_k s/(s + 1/tau_k): one between
        any two relaxation times, one beyond the longest if the material is a solid, and one below the shortest if it
        has a dashpot.

        Returns
        -------
        Creep
        """
        pairs = sorted(zip(self.times, self.moduli, strict=True))
        taus = [tau for tau, _ in pairs]
        flow = self.dashpot + math.fsum(tau * E for tau, E in pairs)

        def balance(theta: float) -> float:
            elements = math.fsum(E * tau / (theta - tau) for tau, E in pairs)
            return self.equilibrium - self.dashpot / theta - elements

        ends = [*([0.0] if self.dashpot else []), *taus]
        if self.equilibrium:
            ends.append(max(taus, default=0.0) + 2 * flow / self.equilibrium)
        thetas = [_zero(balance, low, high) for low, high in pairwise(ends)]
        compliances = tuple(self._compliance(theta) for theta in thetas)
        instantaneous = 0.0 if self.dashpot else 1 / self.instantaneous
        return Creep(instantaneous, 0.0 if self.equilibrium else 1 / flow, compliances, tuple(thetas))

    def _compliance(self, theta: float) -> float:
        """Return the residue of the creep function's transform at s = -1/theta."""
        elements = (E * tau / (1 - tau / theta) ** 2 for tau, E in zip(self.times, self.moduli, strict=True))
        return theta / (self.dashpot + math.fsum(elements))


def checked_material(material: Viscoelastic) -> Viscoelastic:
    """Return a viscoelastic material, or refuse anything else.

    Parameters
    ----------
    material : Viscoelastic
        Made by `standard_solid`, `maxwell`, `kelvin_voigt`, `viscous` or `prony`.

    Returns
    -------
    Viscoelastic

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> checked_material(viscoelastic.maxwell(1e8, 1.0)).moduli
    (100000000.0,)
    """
    if not isinstance(material, Viscoelastic):
        raise InputError(
            "a viscoelastic material is needed, such as standard_solid(equilibrium, instantaneous, relaxation_time), "
            f"not {shown(material)}",
            place="material",
        )
    return material


def _times(time: float | Array) -> Array:
    t = np.asarray(number(time, "time [s]"))
    if not (t >= 0).all():
        raise InputError(
            f"times must not be negative [s], not {t[~(t >= 0)].flat[0]:g}: there is no response before the load"
        )
    return t


def _zero(balance: Callable[[float], float], low: float, high: float) -> float:
    """Return the zero between two ends; `balance` rises from minus infinity above `low` to above 0 below `high`."""
    first, last = low + (high - low) * 2.0**-50, high - (high - low) * 2.0**-50
    return float(brentq(balance, first, last, xtol=1e-300, rtol=2.0**-50, maxiter=500))
