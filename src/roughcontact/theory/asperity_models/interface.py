"""Predictions of theories of independent asperities for a nominally flat interface, per area and as a loading law."""

from __future__ import annotations

from functools import partial
from typing import Protocol

from roughcontact.theory.law import LoadingLaw
from roughcontact.validation import Array, positive

__all__ = ["Interface", "loading_law"]


class Interface(Protocol):
    """Nominally flat rough contact as a function of the separation of the mean planes [m].

    `greenwood_williamson.Population` and `bush_gibson_thomas.Summits` implement it.
    """

    @property
    def lowest(self) -> float:
        """The smallest separation at which the theory holds [m]."""

    @property
    def scale(self) -> float:
        """A length over which the pressure changes strongly: the standard deviation of heights [m]."""

    def pressure(self, separation: float | Array) -> Array:
        """Nominal pressure [Pa]: decreasing, convex, and log-concave."""

    def stiffness(self, separation: float | Array) -> Array:
        """-dp/ds, interfacial stiffness per nominal area [Pa/m]."""

    def contact_fraction(self, separation: float | Array) -> Array:
        """Real contact area over the nominal one [-]."""

    def spot_density(self, separation: float | Array) -> Array:
        """Contacts per nominal area [1/m^2]."""

    def energy(self, separation: float | Array) -> Array:
        """Elastic energy of the asperities per nominal area [J/m^2]: the work of the pressure."""

    def separation(self, pressure: float | Array) -> Array:
        """Separation [m] at a nominal pressure [Pa]; infinite without load."""


def loading_law(interface: Interface, area: float, *, name: str, source: str) -> LoadingLaw:
    """Return the predictions of the theory for a nominal area, as functions of the force.

    Parameters
    ----------
    interface : Interface
        The theory, with its parameters.
    area : float
        Nominal area A0 [m^2].
    name, source : str
        See `LoadingLaw`.

    Returns
    -------
    LoadingLaw
        "interfacial_stiffness", "contact_area", "mean_gap" (the separation of the mean planes), "spots" and
        "elastic_energy" (only that of the asperities). Its domain ends where the flat would reach the mean plane of
        the surface: the gap of a contact is not negative.
    """
    nominal = float(positive(area, "the nominal area [m^2]"))

    return LoadingLaw(
        name,
        source,
        {
            "interfacial_stiffness": partial(_in_all, interface, "stiffness", nominal),
            "contact_area": partial(_in_all, interface, "contact_fraction", nominal),
            "mean_gap": partial(_separation, interface, nominal),
            "spots": partial(_in_all, interface, "spot_density", nominal),
            "elastic_energy": partial(_in_all, interface, "energy", nominal),
        },
        domain=(0.0, nominal * float(interface.pressure(max(0.0, interface.lowest)))),
    )


def _separation(interface: Interface, area: float, force: Array) -> Array:
    return interface.separation(force / area)


def _in_all(interface: Interface, quantity: str, area: float, force: Array) -> Array:
    per_area: Array = getattr(interface, quantity)(interface.separation(force / area))
    return area * per_area
