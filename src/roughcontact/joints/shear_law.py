"""Shear of an interface per area from only its normal curve: backbone, stiffness, loss per cycle.

While the nominal pressure p is constant, the traction of partial slip is mu times the increase of the contact pressure
from a smaller load. With the mean gap g, the interfacial stiffness per area K and C = E*/G*,

    s(tau) = mu C [g(p - tau/mu) - g(p)],    dtau/ds = K(p - tau/mu)/C,

and the loss of a cycle between +tau and -tau is ``8 mu^2 C`` times the integral of the chord of g less g between
p - tau/mu and p (Masing's rule). Ciavarella, Int. J. Solids Struct. 35, 2349 (1998); Jäger, J. Tribol. 120, 677
(1998). Exact for Poisson's ratio 0; otherwise slip is assumed to be along the traction, and C is the ratio of a disc.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from roughcontact import methods
from roughcontact.contact.curve import Curve
from roughcontact.contact.loop import Loop
from roughcontact.friction.slip_solution import UNLIKE
from roughcontact.guesses import hinted
from roughcontact.halfspace.shear.shear_operator import dundurs_parameter
from roughcontact.joints.masing import ROUNDING, ShearCycle, distance_slid, masing_cycle
from roughcontact.joints.normal_law import NormalLaw, normal_law
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.material import Solid
from roughcontact.materials import Elastic, reduced_modulus, solids_of
from roughcontact.theory.joints.mindlin import pair_ratio
from roughcontact.validation import Array, exactly_one, numeric, positive, positive_scalar, require

__all__ = ["FLOWED", "ShearLaw", "shear_law"]

BELOW = "p - tau/mu lies below the lowest load of the curve, and the gap at first touch is not known"
FLOWED = "The surface has flowed: junction growth and the plastic flow under shear are neglected."
TOUCH = "give a smaller amplitude, or use a curve with smaller loads, of a periodic map without missing cells"


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class ShearLaw:
    """The law of an interface under tangential traction, per nominal area, at any pressure of its normal law.

    Attributes
    ----------
    normal : NormalLaw
        Mean gap and stiffness against pressure.
    friction : float
        Coefficient of friction mu.
    ratio : float
        C = E*/G*.
    bodies : tuple of Solid
        One or two bodies.
    shear_strength : float
        Largest tangential traction of a cell that the softer body bears [Pa].

    Examples
    --------
    >>> import roughcontact as rc
    >>> steel = rc.Solid(210e9, 0.3)
    >>> curve = rc.loading_curve(rc.examples.surface("ground"), (steel, steel), pressures=[1e6, 1e7, 3e7, 1e8])
    >>> law = rc.shear_law(curve, (steel, steel), friction=0.2)
    >>> law
    ShearLaw(friction 0.2, E*/G* 1.214, 4 loads, 1e+06 to 1e+08 Pa)
    >>> s = float(law.displacement(5e6, 5e7))  # half of mu p
    >>> f"K_t/A0 = {law.stiffness(5e7) / 1e12:.0f} N/um/mm^2; {law.traction(s, 5e7):.2g} Pa at {s * 1e9:.0f} nm"
    'K_t/A0 = 147 N/um/mm^2; 5e+06 Pa at 45 nm'
    >>> law.loss(5e7, displacement=s) == law.cycle(5e7, displacement=s).loss, round(law.smallest_share(5e7), 3)
    (True, 0.058)
    >>> f"{law.fitted.gross_slip(5e7) * 1e9:.0f} nm by the fitted stiffness"
    '308 nm by the fitted stiffness'
    """

    normal: NormalLaw
    friction: float
    ratio: float
    bodies: tuple[Solid, ...]
    shear_strength: float = math.inf

    @property
    def exact(self) -> bool:
        """Whether the law is exact: Poisson's ratio is 0, the bodies are alike, and no edge of the map is free."""
        return not (any(body.poisson_ratio for body in self.bodies) or self._beta or self.normal.free)

    @property
    def fitted(self) -> ShearLaw:
        """The law whose normal stiffness is the fitted power of the pressure, for small amplitudes."""
        return replace(self, normal=self.normal.fitted)

    @numeric(pressure="Pa")
    def stiffness(self, pressure: float | Array) -> Array:
        """Return the tangential stiffness per area while nothing slips, K_t/A0 [Pa/m].

        Parameters
        ----------
        pressure : float or array
            Nominal pressure [Pa].

        Returns
        -------
        float or array
            K/(A0 C) [Pa/m].
        """
        return self.normal.stiffness_at(pressure) / self.ratio

    @numeric(pressure="Pa")
    def gross_slip(self, pressure: float | Array) -> Array:
        """Return the displacement at which the whole contact begins to slide [m].

        Parameters
        ----------
        pressure : float or array
            Nominal pressure [Pa].

        Returns
        -------
        float or array
            s_max [m]; NaN if the gap at first touch is not known.
        """
        return np.asarray(self.friction * self.ratio * (self.normal.touch - self.normal.gap_at(pressure)))

    @numeric(traction="Pa", pressure="Pa")
    def displacement(self, traction: float | Array, pressure: float | Array) -> Array:
        """Return the tangential displacement [m] as the traction rises from zero.

        Parameters
        ----------
        traction : float or array
            Nominal tangential traction, at most mu p [Pa].
        pressure : float or array
            Nominal pressure [Pa].

        Returns
        -------
        float or array
            Displacement of the surfaces [m], without the elastic displacement of the bodies.

        Raises
        ------
        ValueError
            If the traction exceeds mu p, or p - tau/mu lies below the lowest pressure of the normal law.
        """
        held = self._held(traction, pressure)
        closure = self.normal.gap_at(held) - self.normal.gap_at(pressure)
        return np.asarray(self.friction * self.ratio * closure)

    @numeric(displacement="m", pressure="Pa")
    def traction(self, displacement: float | Array, pressure: float | Array) -> Array:
        """Return the nominal tangential traction [Pa] as the displacement rises from zero, the backbone.

        Parameters
        ----------
        displacement : float or array
            Tangential displacement of the surfaces [m].
        pressure : float or array
            Nominal pressure [Pa].

        Returns
        -------
        float or array
            Traction [Pa]: mu p from `gross_slip` on; NaN below the lowest load of a law whose first touch is not known.
        """
        s = positive(displacement, "the displacement [m]", zero=True)
        gap = self.normal.gap_at(pressure) + s / (self.friction * self.ratio)
        # At a small displacement, rounding may leave a pressure above the given one.
        return np.asarray(self.friction * np.maximum(pressure - self.normal.pressure_at(gap), 0.0))

    @numeric(pressure="Pa", traction="Pa", displacement="m")
    def loss(
        self, pressure: float, *, traction: float | None = None, displacement: float | None = None
    ) -> float:
        """Return the energy that friction dissipates in a cycle between +amplitude and -amplitude [J/m^2].

        Parameters
        ----------
        pressure : float
            Nominal pressure, constant during the cycle [Pa].
        traction, displacement : float, optional
            Exactly one: the amplitude of the nominal traction, at most mu p [Pa], or of the displacement [m]. Beyond
            `gross_slip`, the surfaces slide in each half of the cycle.

        Returns
        -------
        float
            Loss per cycle and nominal area [J/m^2].

        Raises
        ------
        ValueError
            If the amplitude is out of range, or so small that only single cells slip: use `fitted`.
        """
        tau, slid = self._amplitude(pressure, traction, displacement)
        held = float(self._held(tau, pressure))
        least = self.smallest_share(pressure)
        require(
            tau == 0 or tau >= least * self.friction * pressure,
            f"at a traction below {least:.3g} of mu p, only single cells of the map slip",
            "use the law `fitted`, whose stiffness has no steps",
            value=tau,
            place="traction" if displacement is None else "displacement",
        )
        slip = 8 * self.friction**2 * self.ratio * self.normal.bow(held, float(pressure))
        return slip + 4 * tau * slid

    @numeric(pressure="Pa", traction="Pa", displacement="m")
    def cycle(
        self, pressure: float, *, traction: float | None = None, displacement: float | None = None
    ) -> ShearCycle:
        """Return the steady loop between +amplitude and -amplitude at constant pressure.

        Parameters
        ----------
        pressure : float
            Nominal pressure [Pa].
        traction, displacement : float, optional
            Exactly one amplitude, as of `loss`.

        Returns
        -------
        ShearCycle
            The loop, its loss and its damping.
        """
        loss = self.loss(pressure, traction=traction, displacement=displacement)
        tau, slid = self._amplitude(pressure, traction, displacement)
        return masing_cycle(lambda rising: self.displacement(rising, pressure), tau, slid, loss)

    @numeric(pressure="Pa")
    def smallest_share(self, pressure: float) -> float:
        """Return the smallest share of mu p at which a loss is given: one over the root of the cells in contact.

        Parameters
        ----------
        pressure : float
            Nominal pressure [Pa].

        Returns
        -------
        float
            Share; 0 for a fitted law.
        """
        return float(1 / math.sqrt(np.interp(pressure, self.normal.pressure, self.normal.cells)))

    elements = methods.jenkins_elements
    history = methods.shear_history
    iwan = methods.iwan_distribution

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of this law, in sentences, the most important first."""
        return in_order(self._notes())

    def _notes(self) -> Iterator[Note]:
        if self._beta:
            yield Note(
                Rank.DOUBTFUL,
                f"The bodies are unlike (Dundurs's parameter {self._beta:.2g}): the coupling of traction and pressure "
                "is neglected.",
            )
        if math.isnan(self.normal.touch):
            yield Note(
                Rank.LIMITED,
                "The gap at first touch is not known, as for free maps and maps with missing cells: the law ends where "
                f"p - tau/mu is {self.normal.lowest:.3g} Pa, and the displacement at gross slip is NaN.",
            )
        if self.normal.free:
            yield Note(
                Rank.LIMITED,
                "The edges of the map are free: the loss is that of the mean displacement of the surfaces. Friction "
                "dissipates more, which rc.shear_cycle computes.",
            )
        if any(body.poisson_ratio for body in self.bodies):
            yield Note(
                Rank.LIMITED,
                "Shear from the normal curve is exact for Poisson's ratio 0. Here slip across the traction is "
                "neglected, and K/K_t is that of a disc.",
            )
        if math.isfinite(self.normal.hardness):
            yield Note(Rank.LIMITED, FLOWED)
        if self.shear_strength < math.inf:
            means = self.friction * self.normal.pressure / self.normal.columns["contact_fraction"]
            if (beyond := means > self.shear_strength).any():
                p = float(self.normal.pressure[beyond][0])
                yield Note(
                    Rank.WRONG,
                    f"From {p:.3g} Pa on, the mean traction of sliding contact exceeds the shear strength of "
                    f"{self.shear_strength:.3g} Pa: Coulomb's law is wrong there.",
                )

    def __repr__(self) -> str:
        """Return the constants and the range of the law."""
        normal = repr(self.normal).removeprefix("NormalLaw(")
        return f"ShearLaw(friction {self.friction:g}, E*/G* {self.ratio:.4g}, {normal}"

    @property
    def _beta(self) -> float:
        beta = dundurs_parameter(*self.bodies)
        return beta if abs(beta) > UNLIKE else 0.0

    def _held(self, traction: float | Array, pressure: float | Array) -> Array:
        """Return the pressure p - tau/mu [Pa] whose contact sticks."""
        p = np.asarray(pressure, dtype=np.float64)
        tau = positive(traction, "the traction [Pa]", zero=True)
        require(
            tau <= self.friction * p * (1 + ROUNDING),
            f"the traction exceeds mu p with mu = {self.friction:g}: the surfaces slide",
            "give a smaller traction, or a displacement",
            value=tau,
            place="traction",
        )
        held = np.maximum(p - tau / self.friction, 0.0)
        require(held >= self.normal.lowest * (1 - ROUNDING), BELOW, TOUCH, value=held, place="traction")
        return np.asarray(held)

    def _amplitude(
        self, pressure: float, traction: float | None, displacement: float | None
    ) -> tuple[float, float]:
        """Return the traction at the reversal [Pa] and the distance that the surfaces slide before it [m]."""
        name, value = exactly_one(traction=traction, displacement=displacement)
        if name == "traction":
            return float(positive(value, "the traction [Pa]", zero=True)), 0.0
        s = float(positive(value, "the displacement [m]", zero=True))
        tau = float(self.traction(s, pressure)) if s else 0.0
        require(not math.isnan(tau), BELOW, TOUCH, place="displacement")
        return tau, float(distance_slid(np.array(s), self.displacement(tau, pressure)))


@numeric(shear_strength="Pa")
def shear_law(
    pressed: Curve | Loop,
    bodies: Elastic | tuple[Elastic, Elastic],
    *,
    friction: float,
    shear_strength: float | None = None,
    exact: bool = False,
) -> ShearLaw:
    """Return the law of an interface under shear, per nominal area, from its normal curve: no further solve is needed.

    Parameters
    ----------
    pressed : Curve or Loop
        The curve of a map, best of a periodic one, from small loads on; after plastic flow the loop of `loading_loop`.
    bodies : Solid, Material, str, or a pair of them
        The bodies of the curve.
    friction : float
        Coefficient of friction mu.
    shear_strength : float, optional
        Largest traction that a cell bears [Pa], for a note where mu p exceeds it.
    exact : bool
        Raise an error unless the law is exact.

    Returns
    -------
    ShearLaw
        Stiffness, backbone, loops and losses at any pressure of the curve.

    Raises
    ------
    ValueError
        If the bodies have another reduced modulus than the curve, a number is out of range, or the law is asked to be
        exact and is not.

    Examples
    --------
    >>> import roughcontact as rc
    >>> bodies = (rc.Solid(2e9, 0.0), rc.Solid(2e9, 0.0))
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, long_cutoff=3e-5)
    >>> curve = rc.loading_curve(surface, bodies, pressures=[1e6, 2e6, 4e6, 8e6])
    >>> law = rc.shear_law(curve, bodies, friction=0.3, exact=True)
    >>> f"slides at {law.gross_slip(4e6) * 1e9:.0f} nm; {law.loss(4e6, traction=0.6e6) * 1e3:.1f} mJ/m^2 a cycle"
    'slides at 106 nm; 3.3 mJ/m^2 a cycle'
    """
    normal, solids = normal_law(pressed), solids_of(*(bodies if isinstance(bodies, tuple) else (bodies,)))
    modulus = reduced_modulus(*solids)
    require(
        abs(modulus - normal.modulus) <= 1e-6 * normal.modulus,
        f"these bodies have a reduced modulus of {modulus:.6g} Pa, but were pressed with {normal.modulus:.6g} Pa",
        "use the same bodies for both",
        place="bodies",
    )
    law = ShearLaw(
        normal,
        positive_scalar(friction, "the friction coefficient"),
        pair_ratio(*solids),
        solids,
        math.inf if shear_strength is None else positive_scalar(shear_strength, "the shear strength [Pa]"),
    )
    require(
        law.exact or not exact,
        "the law from the normal curve is exact only for alike bodies of Poisson's ratio 0 and for periodic maps",
        "leave out `exact`, or compute cycles by rc.shear_cycle",
        place="exact",
    )
    return law
