"""Reduced models of an interface under shear at one pressure: parallel Jenkins elements, Iwan's distribution.

The backbone is ``tau(s) = int phi(y) min(s, y) dy`` with ``phi = -tau''``: springs in parallel, of which those with the
slip y slide at the displacement y (Iwan, J. Appl. Mech. 33, 893 (1966)). A chord of the backbone between two
displacements is a finite number of such elements.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from roughcontact.guesses import hinted
from roughcontact.joints.masing import distance_slid
from roughcontact.joints.shear_law import BELOW, TOUCH, ShearLaw
from roughcontact.units import in_si
from roughcontact.validation import Array, numeric, positive, positive_scalar, require, whole

__all__ = ["JenkinsElements", "iwan_distribution", "jenkins_elements"]

_RESOLVED = 5  # first slips, from which on the loss is compared: it is 1 % too small there
_AMPLITUDES = 200
_NEAR = 1.02  # factor between pressures, over which the exponent of the stiffness is taken
_TINY = 1e-12  # of the pressure: the whole contact slides


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class JenkinsElements:
    """Springs with sliders, in parallel, which replace the law of an interface at one nominal pressure only.

    Attributes
    ----------
    stiffness : array, shape (n,)
        Stiffness of each spring per area [Pa/m].
    slip : array, shape (n,)
        Displacement at which each element slides [m], increasing; its traction is then stiffness times slip.
    pressure : float
        Nominal pressure of the law [Pa]. At another pressure the elements are wrong.
    misfit : dict of float
        Largest relative difference from the law: of the ``"traction"``, and of the ``"loss"`` for amplitudes from five
        times the first slip to the last.

    Examples
    --------
    >>> import roughcontact as rc
    >>> steel = rc.Solid(210e9, 0.3)
    >>> curve = rc.loading_curve(rc.examples.surface("ground"), (steel, steel), pressures=[1e6, 1e7, 3e7, 1e8])
    >>> law = rc.shear_law(curve, (steel, steel), friction=0.2).fitted
    >>> elements = law.elements(5e7, count=16)
    >>> elements
    JenkinsElements(16, only at 5e+07 Pa, slips 3.1e-09 to 3.1e-07 m, misfit of the loss 3.2%)
    >>> f"{elements.traction(1e-7) / 1e6:.2f} MPa, {elements.loss(1e-7):.2f} J/m^2"
    '8.01 MPa, 0.65 J/m^2'
    """

    stiffness: Array
    slip: Array
    pressure: float
    misfit: Mapping[str, float]

    @numeric(displacement="m")
    def traction(self, displacement: float | Array) -> Array:
        """Return the traction [Pa] as the displacement rises from zero.

        Parameters
        ----------
        displacement : float or array
            Tangential displacement [m].

        Returns
        -------
        float or array
            Sum over the elements [Pa].
        """
        s = np.asarray(displacement, dtype=np.float64)[..., None]
        return np.asarray(np.clip(s, -self.slip, self.slip) @ self.stiffness)

    @numeric(displacement="m")
    def loss(self, displacement: float | Array) -> Array:
        """Return the energy dissipated in a cycle between +displacement and -displacement [J/m^2].

        Parameters
        ----------
        displacement : float or array
            Amplitude of the displacement [m].

        Returns
        -------
        float or array
            Loss per cycle and area; 0 up to the first slip [J/m^2].
        """
        s = positive(displacement, "the displacement [m]", zero=True)[..., None]
        return np.asarray(4 * np.maximum(s - self.slip, 0.0) @ (self.stiffness * self.slip))

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these elements, in sentences."""
        return (
            f"The elements belong to the nominal pressure {self.pressure:.3g} Pa only: use the levels of the law "
            "(`history`) where the pressure varies.",
            f"Below an amplitude of {self.slip[0]:.3g} m nothing is dissipated.",
        )

    def __repr__(self) -> str:
        """Return count, pressure and misfit."""
        return (
            f"JenkinsElements({len(self.slip)}, only at {self.pressure:.4g} Pa, slips {self.slip[0]:.2g} to "
            f"{self.slip[-1]:.2g} m, misfit of the loss {self.misfit['loss']:.1%})"
        )


def jenkins_elements(
    law: ShearLaw, pressure: float, *, count: int = 16, first: float = 0.01
) -> JenkinsElements:
    """Return parallel elements whose backbone has the tractions of the law at geometric displacements.

    Parameters
    ----------
    law : ShearLaw
        The law of the interface.
    pressure : float
        Nominal pressure, to which the elements belong [Pa].
    count : int
        Number of elements, at least 2.
    first : float
        First slip over the last, which is that of gross slip or of the lowest load of the law. Below the first slip
        nothing is dissipated: choose a fifth of the smallest amplitude.

    Returns
    -------
    JenkinsElements
        Stiffness and slip of each, and their misfit. Between the slips the chord lies below the backbone, and the loss
        is too large.

    Raises
    ------
    ValueError
        If a number is out of range.

    Examples
    --------
    >>> import roughcontact as rc
    >>> steel = rc.Solid(210e9, 0.3)
    >>> curve = rc.loading_curve(rc.examples.surface("ground"), (steel, steel), pressures=[1e6, 1e7, 3e7, 1e8])
    >>> law = rc.shear_law(curve, (steel, steel), friction=0.2).fitted
    >>> [f"{law.elements(5e7, count=count).misfit['loss']:.1%}" for count in (8, 16, 32)]
    ['15.8%', '3.2%', '1.2%']
    """
    pressure = positive_scalar(in_si(pressure, "Pa", "pressure"), "pressure")
    require(whole(count, "count") > 1, "the backbone needs at least two elements", value=count, place="count")
    low, part = law.normal.lowest, "`first` is a fraction of the last slip"
    require(0 < first < 1, part, "give a number such as 0.01", value=first, place="first")
    least = f"elements need a pressure above {low:g} Pa"
    require(pressure > low, least, "give a larger pressure", value=pressure, place="pressure")
    last = law.displacement(end := law.friction * (pressure - low), pressure)

    def backbone(s: Array) -> Array:  # the traction of the last slip may lie beyond the law by rounding
        return np.where(s < last, law.traction(s, pressure), end)

    slip = last * np.geomspace(first, 1.0, count)
    slopes = np.append(np.diff(backbone(slip), prepend=0.0) / np.diff(slip, prepend=0.0), 0.0)
    stiffness = np.maximum(-np.diff(slopes), 0.0)  # below 0 by rounding only
    elements = JenkinsElements(stiffness, slip, pressure, {})
    smooth = replace(law, normal=replace(law.normal, cells=np.full_like(law.normal.cells, np.inf)))
    s = np.geomspace(min(_RESOLVED * slip[0], last), last, _AMPLITUDES)
    slid = distance_slid(s, law.displacement(tau := backbone(s), pressure))
    loss = [smooth.loss(pressure, traction=each) for each in tau] + 4 * tau * slid
    pairs = {"traction": (elements.traction(s), tau), "loss": (elements.loss(s), loss)}
    return replace(elements, misfit={name: float(abs(a / b - 1).max()) for name, (a, b) in pairs.items()})


def iwan_distribution(law: ShearLaw, pressure: float, displacement: float | Array) -> Array:
    """Return Iwan's distribution phi of a fitted law: stiffness per area of the elements that slide at a displacement.

    ``int phi dy`` is the stiffness without slip, ``int y phi dy`` is mu p. The distribution belongs to one pressure.

    Parameters
    ----------
    law : ShearLaw
        A fitted law.
    pressure : float
        Nominal pressure [Pa].
    displacement : float or array
        Slips y [m].

    Returns
    -------
    float or array
        phi [Pa/m^2]; 0 beyond gross slip.

    Raises
    ------
    ValueError
        If the law is not `fitted`: between computed loads, the slope of the stiffness has steps.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> steel = rc.Solid(210e9, 0.3)
    >>> curve = rc.loading_curve(rc.examples.surface("ground"), (steel, steel), pressures=[1e6, 1e7, 3e7, 1e8])
    >>> law = rc.shear_law(curve, (steel, steel), friction=0.2).fitted
    >>> slips = np.linspace(0, float(law.gross_slip(5e7)), 1001)
    >>> share = np.trapezoid(law.iwan(5e7, slips), slips) / law.stiffness(5e7)
    >>> round(float(share), 3)
    1.0
    """
    pressure, normal = positive_scalar(in_si(pressure, "Pa", "pressure"), "pressure"), law.normal
    require(np.isinf(normal.cells), "Iwan's distribution needs a smooth stiffness", "use the law `fitted`")
    traction = law.traction(displacement, pressure)
    require(~np.isnan(traction), BELOW, TOUCH, place="displacement")
    held = np.maximum(pressure - traction / law.friction, _TINY * pressure)
    # The local exponent of the stiffness
    low, high = np.maximum(held / _NEAR, normal.lowest), np.minimum(held * _NEAR, normal.highest)
    exponent = np.log(normal.stiffness_at(high) / normal.stiffness_at(low)) / np.log(high / low)
    phi = exponent * normal.stiffness_at(held) ** 2 / (held * law.friction * law.ratio**2)
    return np.where(held > _TINY * pressure, phi, 0.0)
