r"""The work of adhesion less the elastic energy of full contact with a rough surface.

Persson and Tosatti, J. Chem. Phys. 115, 5597 (2001). To press an elastic body flat against every
wave costs the elastic energy per area

    U = E*/4 int q C2D(q) d^2q = pi E*/2 int q^2 C2D(q) dq

because the pressure under a wave of wavenumber q and height h is E* q h/2. The remainder is w - U: if it is negative,
full contact releases no energy. The true area is assumed to equal the nominal one (small slopes), and partial contact,
which costs less, is not considered. The result is an energy, not a force.
"""

from __future__ import annotations

from roughcontact.theory.random_surfaces.waves import Spectrum, Waves
from roughcontact.validation import numeric, positive_scalar

__all__ = ["effective_work", "full_contact_energy", "stickable_modulus"]


@numeric
def full_contact_energy(spectrum: Spectrum, modulus: float) -> float:
    """Return the elastic energy of full contact per area.

    Parameters
    ----------
    spectrum : Waves, measured or continuous spectrum
        C2D of the surface, see `Waves.of`.
    modulus : float
        Reduced modulus E* [Pa].

    Returns
    -------
    float
        U [J/m^2].

    Raises
    ------
    ValueError
        If the modulus is not positive, or `spectrum` is not a spectrum.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_tosatti
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-4, short_cutoff=1e-6).scaled(1e-7)
    >>> f"{persson_tosatti.full_contact_energy(spectrum, 1e6) * 1e3:.2f} mJ/m^2"
    '0.39 mJ/m^2'
    """
    waves = Waves.of(spectrum)
    return 0.25 * positive_scalar(modulus, "the reduced modulus [Pa]") * float(waves.wavenumber @ waves.power)


@numeric
def effective_work(spectrum: Spectrum, modulus: float, work: float) -> float:
    """Return the work of adhesion less the elastic energy of full contact; negative if the energy is larger.

    Parameters
    ----------
    spectrum : Waves, measured or continuous spectrum
        C2D of the surface, see `Waves.of`.
    modulus : float
        Reduced modulus E* [Pa].
    work : float
        Work of adhesion w of smooth surfaces [J/m^2].

    Returns
    -------
    float
        [J/m^2]

    Raises
    ------
    ValueError
        If a number is not positive, or `spectrum` is not a spectrum.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_tosatti
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-4, short_cutoff=1e-6).scaled(1e-7)
    >>> for modulus in (1e6, 1e9):
    ...     print(f"{persson_tosatti.effective_work(spectrum, modulus, 0.05) * 1e3:.1f} mJ/m^2")
    49.6 mJ/m^2
    -342.7 mJ/m^2
    """
    return positive_scalar(work, "the work of adhesion [J/m^2]") - full_contact_energy(spectrum, modulus)


@numeric
def stickable_modulus(spectrum: Spectrum, work: float) -> float:
    """Return the reduced modulus up to which full contact releases energy.

    Parameters
    ----------
    spectrum : Waves, measured or continuous spectrum
        C2D of the surface, see `Waves.of`.
    work : float
        Work of adhesion w of smooth surfaces [J/m^2].

    Returns
    -------
    float
        [Pa]

    Raises
    ------
    ValueError
        If the work is not positive, or `spectrum` is not a spectrum.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import persson_tosatti
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-4, short_cutoff=1e-6).scaled(1e-7)
    >>> f"{persson_tosatti.stickable_modulus(spectrum, 0.05) / 1e6:.0f} MPa"
    '127 MPa'
    """
    per_modulus = full_contact_energy(spectrum, 1.0)
    return positive_scalar(work, "the work of adhesion [J/m^2]") / per_modulus
