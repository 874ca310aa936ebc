"""Viscoelastic materials of springs and dashpots."""

from __future__ import annotations

from roughcontact.errors import InputError
from roughcontact.validation import numeric
from roughcontact.viscoelastic.prony_series import Viscoelastic

__all__ = ["kelvin_voigt", "maxwell", "standard_solid", "viscous"]


@numeric(viscosity="Pa*s")
def viscous(viscosity: float) -> Viscoelastic:
    """Return an incompressible viscous fluid of `viscosity` eta [Pa s]: E* becomes 4 eta d/dt.

    Parameters
    ----------
    viscosity : float
        eta [Pa s].

    Returns
    -------
    Viscoelastic

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> viscoelastic.viscous(10.0).dashpot
    40.0
    """
    return Viscoelastic(dashpot=4 * viscosity)


@numeric(modulus="Pa", retardation_time="s")
def kelvin_voigt(modulus: float, retardation_time: float) -> Viscoelastic:
    """Return spring and dashpot in parallel: ``J(t) = (1 - exp(-t/tau))/E``; modulus E* [Pa], time [s].

    Parameters
    ----------
    modulus : float
        E* of the spring [Pa].
    retardation_time : float
        tau [s].

    Returns
    -------
    Viscoelastic

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> creep = viscoelastic.kelvin_voigt(1e8, 2.0).creep()
    >>> round(float(creep(2.0)) * 1e8, 6)  # 1 - 1/e after the retardation time
    0.632121
    """
    return Viscoelastic(equilibrium=modulus, dashpot=modulus * retardation_time)


@numeric(modulus="Pa", relaxation_time="s")
def maxwell(modulus: float, relaxation_time: float) -> Viscoelastic:
    """Return spring and dashpot in series: ``E(t) = E exp(-t/tau)``; modulus E* [Pa], time [s].

    Parameters
    ----------
    modulus : float
        E* of the spring [Pa].
    relaxation_time : float
        tau [s].

    Returns
    -------
    Viscoelastic

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> round(float(viscoelastic.maxwell(1e8, 2.0).relaxation(2.0)) / 1e8, 6)  # 1/e after the relaxation time
    0.367879
    """
    return Viscoelastic(moduli=(modulus,), times=(relaxation_time,))


@numeric(equilibrium="Pa", instantaneous="Pa", relaxation_time="s")
def standard_solid(equilibrium: float, instantaneous: float, relaxation_time: float) -> Viscoelastic:
    """Return ``E(t) = E_inf + (E_0 - E_inf) exp(-t/tau)``.

    Parameters
    ----------
    equilibrium, instantaneous : float
        Reduced moduli after a long time and immediately, E_inf < E_0 [Pa].
    relaxation_time : float
        tau [s].

    Returns
    -------
    Viscoelastic

    Examples
    --------
    >>> from roughcontact import viscoelastic
    >>> soft = viscoelastic.standard_solid(1e8, 1e9, 1.0)
    >>> [round(float(soft.relaxation(t)) / 1e8, 4) for t in (0.0, 1.0, 100.0)]
    [10.0, 4.3109, 1.0]
    """
    if not 0 < equilibrium < instantaneous:
        raise InputError(
            f"a standard solid softens from its instantaneous modulus {instantaneous} Pa to a lower one, "
            f"not to {equilibrium} Pa"
        )
    return Viscoelastic(equilibrium, (instantaneous - equilibrium,), (relaxation_time,))
