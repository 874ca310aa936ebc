r"""Linear viscoelastic materials as a spring, a dashpot and Maxwell elements in parallel.

The reduced modulus E* becomes a relaxation function E(t), and its compliance a creep function J(t). A frictionless
contact depends on the body only through E*(t), whether or not Poisson's ratio is constant in time.

    E(t) = c delta(t) + E_inf + sum E_k exp(-t/tau_k)         J(t) = J_0 + t/eta_0 + sum J_j (1 - exp(-t/theta_j))

with the identity that the convolution of E with dJ is 1 (Lee & Radok, J. Appl. Mech. 27, 438 (1960)).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from roughcontact import methods
from roughcontact.errors import InputError, about
from roughcontact.guesses import hinted
from roughcontact.late import static
from roughcontact.validation import Array, number, numeric, positive_scalar, require_numbers, shown

__all__ = ["Creep", "Viscoelastic", "checked_material", "partner_terms"]

Band = tuple[float, float] | None
TINY = 2.0**-50  # of an interval between poles: closer to a pole the zero is at the pole


@hinted
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
    band : tuple of float, optional
        Shortest and longest time of the data [s].

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> creep = viscoelastic.standard_solid(1e8, 1e9, 1.0).creep()
    >>> [round(float(creep(t)) * 1e9, 3) for t in (0.0, 1000.0)]  # 1/E_0 and 1/E_inf
    [1.0, 10.0]
    >>> round(creep.times[0], 12)  # tau E_0/E_inf
    10.0
    """

    instantaneous: float
    fluidity: float
    compliances: tuple[float, ...]
    times: tuple[float, ...]
    band: Band = None

    @numeric(time="s")
    def __call__(self, time: float | Array) -> Array:
        """Return J(t) [1/Pa] at times >= 0 [s]."""
        t = _times(time, self.band)
        retarded = (J * -np.expm1(-t / theta) for J, theta in zip(self.compliances, self.times, strict=True))
        return self.instantaneous + self.fluidity * t + sum(retarded)


@hinted
@dataclass(frozen=True, slots=True)
class Viscoelastic:
    """A linear viscoelastic half-space in terms of its reduced modulus.

    The functions of `roughcontact.viscoelastic` make materials from spring models, creep, power laws and DMA tables.

    Parameters
    ----------
    equilibrium : float
        E_inf, the value of E* after a long time [Pa]; 0 for a fluid.
    moduli, times : tuple of float
        E_k [Pa] and the different relaxation times tau_k [s] of the Maxwell elements.
    dashpot : float
        c of a parallel dashpot [Pa s]; with a dashpot, no jump of the depth is possible.
    band : tuple of float, optional
        Shortest and longest time [s] that the data behind the material cover. Other times raise an error.
    temperature : float, optional
        Temperature to which the times belong [K].
    misfit : float, optional
        Largest relative deviation of the material from the data or law to which it was fitted [-].

    Raises
    ------
    ValueError
        If a modulus or viscosity is negative, a time is not positive, two times are equal, or all moduli and
        viscosities are zero.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Viscoelastic(equilibrium=1e6, moduli=(4e6, 5e6), times=(0.1, 1.0))
    >>> rubber.instantaneous, round(float(rubber.relaxation(100.0))), round(float(rubber.creep()(0.0)) * 1e6, 6)
    (10000000.0, 1000000, 0.1)
    >>> f"{rubber.complex_modulus(1.0) / 1e6:.2f}"  # storage and loss [MPa]
    '3.54+2.90j'
    >>> rubber.shifted(10.0).times  # colder: ten times slower
    (1.0, 10.0)
    """

    equilibrium: float = 0.0
    moduli: tuple[float, ...] = ()
    times: tuple[float, ...] = ()
    dashpot: float = 0.0
    band: Band = None
    temperature: float | None = None
    misfit: float | None = None

    def __post_init__(self) -> None:
        units = {"equilibrium": "Pa", "moduli": "Pa", "times": "s", "dashpot": "Pa*s"}
        require_numbers(self, **units, band="s", temperature="K")
        for name in ("moduli", "times") if self.band is None else ("moduli", "times", "band"):
            values = np.asarray(number(getattr(self, name), name))
            if values.ndim != 1:
                raise about(name, f"must be a list, such as [0.1, 1.0], not {shown(getattr(self, name))}")
            object.__setattr__(self, name, tuple(values.tolist()))
        if len(self.moduli) != len(self.times):
            raise InputError(
                f"each modulus needs its time: {len(self.moduli)} moduli and {len(self.times)} times are given",
                place="moduli",
            )
        if not all(math.isfinite(v) and v >= 0 for v in (self.equilibrium, self.dashpot, *self.moduli)):
            raise about(
                "moduli",
                "and viscosities must be finite and not negative: "
                f"{self.equilibrium:g} Pa, {shown(self.moduli)}, {self.dashpot:g} Pa s",
            )
        if not all(math.isfinite(tau) and tau > 0 for tau in self.times):
            raise about("times", f"of elements must be positive and finite [s], not {shown(self.times)}")
        if len(set(self.times)) != len(self.times):
            raise InputError(
                f"the relaxation times of the elements must differ: {self.times}",
                "add the moduli of equal times",
                "times",
            )
        if self.equilibrium == 0 and self.dashpot == 0 and not any(self.moduli):
            raise InputError("a material needs a modulus or a viscosity")
        if self.band is not None and not (len(self.band) == 2 and 0 < self.band[0] < self.band[1] < math.inf):
            raise about("band", f"must be two positive times that rise [s], not {self.band}")

    read = static(methods.read_material)
    write = methods.write_material

    @property
    def instantaneous(self) -> float:
        """E_inf + sum E_k, the modulus under a sudden load if there is no dashpot [Pa]."""
        return self.equilibrium + math.fsum(self.moduli)

    @numeric(time="s")
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

        Raises
        ------
        ValueError
            If a time is negative or outside the band of the data.
        """
        t = _times(time, self.band)
        return self.equilibrium + sum(
            (E * np.exp(-t / tau) for E, tau in zip(self.moduli, self.times, strict=True)), np.zeros_like(t)
        )

    @numeric(angular_frequency="rad/s")
    def complex_modulus(self, angular_frequency: float | Array) -> npt.NDArray[np.complex128]:
        """Return storage + i loss of E* [Pa].

        Parameters
        ----------
        angular_frequency : float or array
            omega, not negative [rad/s]; 2 pi times the frequency in Hz.

        Returns
        -------
        complex or array of complex
            E*(omega) [Pa].

        Raises
        ------
        ValueError
            If a frequency is negative, or its inverse is outside the band of the data.
        """
        w = np.asarray(number(angular_frequency, "angular_frequency [rad/s]"))
        if not (w >= 0).all():
            raise about("angular_frequency", "must not be negative [rad/s]", "give its absolute value")
        if self.band is not None:
            with np.errstate(divide="ignore"):
                _times(1 / w, self.band)
        elements = (
            E * 1j * w * tau / (1 + 1j * w * tau) for E, tau in zip(self.moduli, self.times, strict=True)
        )
        return np.asarray(self.equilibrium + 1j * w * self.dashpot + sum(elements))[()]

    @numeric(temperature="K")
    def shifted(self, factor: float, temperature: float | None = None) -> Viscoelastic:
        """Return the material at another temperature: all times are multiplied by the shift factor a_T.

        Parameters
        ----------
        factor : float
            a_T [-], above 1 for a colder material; 1 at the reference temperature.
        temperature : float, optional
            The other temperature [K].

        Returns
        -------
        Viscoelastic
        """
        a = positive_scalar(factor, "factor")
        return replace(
            self,
            times=tuple(a * tau for tau in self.times),
            dashpot=a * self.dashpot,
            band=self.band and (a * self.band[0], a * self.band[1]),
            temperature=temperature,
        )

    def creep(self) -> Creep:
        """Return the creep function, exactly.

        Its retardation times theta_j are the roots s = -1/theta of c s + E_inf + sum E_k s/(s + 1/tau_k): one between
        any two relaxation times, one beyond the longest if the material is a solid, and one below the shortest if it
        has a dashpot.

        Returns
        -------
        Creep
        """
        rates = [1 / tau for tau in self.times]
        terms = partner_terms(self.equilibrium, self.dashpot, self.moduli, rates)
        flow = self.dashpot + math.fsum(tau * E for tau, E in zip(self.times, self.moduli, strict=True))
        return Creep(
            0.0 if self.dashpot else 1 / self.instantaneous,
            0.0 if self.equilibrium else 1 / flow,
            tuple(J for _, J in terms[::-1]),
            tuple(1 / rate for rate, _ in terms[::-1]),
            self.band,
        )


def partner_terms(
    constant: float, linear: float, weights: Sequence[float], poles: Sequence[float]
) -> list[tuple[float, float]]:
    """Return the exponential terms of the inverse of a viscoelastic function, as pairs of place x and weight.

    The places are the zeros of ``constant - linear x - sum w x/(p - x)``, which interlace with the poles p. For
    moduli as weights, x and p are rates of retardation and relaxation; for compliances they are times.

    Examples
    --------
    >>> [(rate, weight)] = partner_terms(1.0, 0.0, [2.0], [1.0])  # E_inf = 1, E_1 = 2, tau = 1
    >>> round(1 / rate, 12), round(weight, 12)  # theta = 3, J_1 = 2/3
    (3.0, 0.666666666667)
    """
    terms = sorted((p, w) for p, w in zip(poles, weights, strict=True) if w)

    def balance(origin: float, shift: float) -> float:
        x = origin + shift
        return constant - linear * x - math.fsum(w * x / (p - origin - shift) for p, w in terms)

    def weight(origin: float, shift: float) -> float:
        x = origin + shift
        return 1 / (linear * x + math.fsum(w * x * p / (p - origin - shift) ** 2 for p, w in terms))

    ends = [*([0.0] if constant else []), *(p for p, _ in terms)]
    if linear:
        most = 2 * (constant + 2 * math.fsum(w for _, w in terms)) / linear
        ends.append(max(most, 2 * max((p for p, _ in terms), default=0.0)))
    zeros = [_zero(balance, low, high) for low, high in pairwise(ends)]
    return [(origin + shift, weight(origin, shift)) for origin, shift in zeros]


def checked_material(material: Viscoelastic) -> Viscoelastic:
    """Return a viscoelastic material, or refuse anything else.

    Parameters
    ----------
    material : Viscoelastic
        Made by `standard_solid`, `maxwell`, `kelvin_voigt`, `viscous`, `prony` or `from_dma`.

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


def _times(time: float | Array, band: Band) -> Array:
    t = np.asarray(number(time, "time [s]"))
    if not (t >= 0).all():
        raise InputError(
            f"times must not be negative [s], not {t[~(t >= 0)].flat[0]:g}: there is no response before the load"
        )
    if band is not None and (outside := t[(t < band[0] * (1 - 1e-9)) | (t > band[1] * (1 + 1e-9))]).size:
        raise about(
            "time",
            f"must lie in the band of the data, {band[0]:g} to {band[1]:g} s, not at {outside.flat[0]:g} s",
            "measure in a wider band, or extrapolate with dataclasses.replace(material, band=None)",
        )
    return t


def _zero(balance: Callable[[float, float], float], low: float, high: float) -> tuple[float, float]:
    """Return the zero as the nearer end and the distance to it, which keeps its digits beside a pole.

    `balance` is positive above `low` and negative below `high`.
    """
    half = (high - low) / 2
    origin, sign = (high, -1.0) if balance(low, half) > 0 else (low, 1.0)
    if sign * balance(origin, sign * half * TINY) <= 0:  # a weight below rounding
        return origin, sign * half * TINY
    shift = brentq(
        lambda y: balance(origin, sign * y), half * TINY, half, xtol=1e-300, rtol=2.0**-50, maxiter=500
    )
    return origin, sign * float(shift)
