r"""Whether a rough surface sticks, from its slopes and curvatures: the criterion of Pastewka and Robbins.

Proc. Natl. Acad. Sci. 111, 3298 (2014). At small contact areas the reaction acts on the same area as without
attraction, and a band beside the edge is attracted by the constant w/range. Both areas grow with the length P of the
edge,

    A_rep = P d_rep/pi  under  E* h'/kappa,        A_att = P d_att  under  -w/range

and the attraction is a fixed part of the reaction, whatever the load. If it exceeds 1, contacts hold under tension.

    stickiness = pi kappa w/(E* h' range) d_att/d_rep

d_rep is the mean chord of the contact spots. d_att is the width over which the gap beside a cylinder with the slope h'
at the edge, g = (4/3) h' d_rep (x/d_rep)^(3/2), grows to the range:

    d_rep = 4 h'/h'',        d_att = d_rep (3 range/(4 h' d_rep))^(2/3)

h' and h'' are the root mean squares of the gradient and of the Laplacian; 2/h'' is the radius of a summit. The
criterion is then ``E* h' range/(kappa w) (h'^2/(h'' range))^(2/3) < pi (3/16)^(2/3) = 1.03``.

**Constants.** Some authors use half the Laplacian as h'' in d_rep = 4 h'/h'', which makes the stickiness 1.6 times
smaller. In contacts without attraction (``benchmarks/stickiness.py``) d_rep is 1.5 to 2.3 h'/h'', below both, and
A_att/A_rep is 1.2 to 2.7 times that of the criterion; kappa is 2.3 to 2.6, and P d_att with the measured d_rep is
right to 40 %. The criterion is therefore accurate to a factor of three; otherwise give kappa and d_rep.

**Limits.** Small contact areas, a range far below h' d_rep, and an attraction that does not change the contact. The
criterion gives no pull-off force. Ciavarella (J. Tribol. 2017, doi 10.1115/1.4034530) disputes that slopes and
curvatures are decisive: see `bearing_area_model`, which depends on the rms height and the longest wave.
"""

from __future__ import annotations

import math

from roughcontact.theory.random_surfaces.waves import Spectrum, Waves
from roughcontact.validation import numeric, positive_scalar

__all__ = ["KAPPA", "attracted_width", "contact_diameter", "stickiness"]

KAPPA = 2.0  # contact fraction times E* h' over the pressure, without attraction


@numeric
def contact_diameter(spectrum: Spectrum) -> float:
    """Return the mean chord of the contact spots, d_rep = 4 h'/h''.

    Parameters
    ----------
    spectrum : Waves, measured or continuous spectrum
        C2D of the surface, see `Waves.of`.

    Returns
    -------
    float
        d_rep [m].

    Raises
    ------
    ValueError
        If `spectrum` is not a spectrum.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import pastewka_robbins
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-4, short_cutoff=1e-6).scaled(1e-7)
    >>> f"{pastewka_robbins.contact_diameter(spectrum) * 1e6:.2f} um"
    '1.43 um'
    """
    waves = Waves.of(spectrum)
    return 4 * waves.rms_slope / math.sqrt(8 / 3 * waves.m4)


@numeric
def attracted_width(slope: float, diameter: float, range: float) -> float:
    """Return the width d_att beside the edge of contact in which the gap is below the range.

    Parameters
    ----------
    slope : float
        Slope h' of the undeformed surface at the edge [-].
    diameter : float
        Chord of the contact, d_rep [m].
    range : float
        Range of the attraction [m], far below slope times diameter.

    Returns
    -------
    float
        d_att [m].

    Raises
    ------
    ValueError
        If a number is not positive.

    Examples
    --------
    >>> from roughcontact.theory import pastewka_robbins
    >>> f"{pastewka_robbins.attracted_width(0.1, 1e-6, 1e-9) * 1e9:.0f} nm"
    '38 nm'
    """
    steep = positive_scalar(slope, "the slope")
    chord = positive_scalar(diameter, "the diameter of the contact [m]")
    ratio = 0.75 * positive_scalar(range, "the range [m]") / (steep * chord)
    return chord * math.pow(ratio, 2 / 3)


@numeric
def stickiness(
    spectrum: Spectrum,
    modulus: float,
    work: float,
    range: float,
    *,
    kappa: float = KAPPA,
    diameter: float | None = None,
) -> float:
    """Return the attraction over the reaction; above 1 the surface sticks.

    Parameters
    ----------
    spectrum : Waves, measured or continuous spectrum
        C2D of the surface, see `Waves.of`.
    modulus : float
        Reduced modulus E* [Pa].
    work : float
        Work of adhesion w [J/m^2].
    range : float
        Largest gap of the attraction w/range [m].
    kappa : float
        Contact fraction times E* h' over the pressure, without attraction [-].
    diameter : float, optional
        Mean chord of the contact spots d_rep [m], pi times their area over the length of their edges; by default that
        of `contact_diameter`.

    Returns
    -------
    float
        [-]

    Raises
    ------
    ValueError
        If a number is not positive, or `spectrum` is not a spectrum.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import pastewka_robbins
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-4, short_cutoff=1e-6).scaled(1e-7)
    >>> for modulus in (1e6, 1e9):
    ...     print(f"{pastewka_robbins.stickiness(spectrum, modulus, 0.05, 2e-9):.2f}")
    593.46
    0.59
    """
    waves = Waves.of(spectrum)
    chord = contact_diameter(waves) if diameter is None else diameter
    attracted = attracted_width(waves.rms_slope, chord, range) / chord
    tension = positive_scalar(work, "the work of adhesion [J/m^2]") / range
    pressure = positive_scalar(modulus, "the reduced modulus [Pa]") * waves.rms_slope
    return math.pi * positive_scalar(kappa, "kappa") * tension / pressure * attracted
