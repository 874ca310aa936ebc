"""The finite-size crossover: a single cell of roughness at low loads, Persson's linear law above.

HEURISTIC: an argument and a fitted prefactor, not a theorem. A nominally flat surface consists of cells of the size of
its longest waves. At the lowest loads only the highest cell carries the load, as a rough indenter. As the load grows,
further cells come into contact, and the stiffness grows in proportion to their number. Pastewka, Prodanov, Lorenz,
Mueser, Robbins and Persson, Phys. Rev. E 87, 062809 (2013), have found both in computed contacts; the pressure of the
crossover falls with the nominal area.

The prefactors here are not theirs: the larger of the power law of the thesis (eq. 4.74) and Persson's stiffness is
used. Computed periodic surfaces (H = 0.8, 128 x 128 cells, roll-off at 1, 1/2, 1/4 and 1/8 of the side L, shortest
waves L/32, means of six samples) have 0.9 to 1.8 times that stiffness, from F/(E* h L) = 0.001 to 3.

Without a roll-off the surface is one cell, and both laws meet near full contact: there is no linear regime.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import partial

import numpy as np

from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.persson_theory import persson_separation as separation
from roughcontact.theory.random_surfaces.waves import Spectrum, Waves
from roughcontact.theory.stiffness_laws import pohrt_popov
from roughcontact.validation import Array, moderate, numeric, positive, require, require_numbers

__all__ = ["Cell", "law"]


@dataclass(frozen=True, slots=True)
class Cell:
    """A cell of roughness as an indenter, ``k = zeta E* l (F/(E* h l))^(1/(H+1))`` (thesis, eq. 4.74).

    Parameters
    ----------
    hurst : float
        Hurst exponent H, above 0 and at most 2.
    rms : float
        Root mean square height h [m].
    length : float
        Side l [m]: the roll-off wavelength, or the side of a surface without one.
    prefactor : float, optional
        zeta, by default 1.7/(H+1).

    Raises
    ------
    ValueError
        If a number is out of range.

    Examples
    --------
    >>> from roughcontact.theory import finite_size
    >>> cell = finite_size.Cell(0.8, rms=1e-6, length=1e-3)
    >>> round(float(cell.stiffness(16.0, 1e11) / cell.stiffness(1.0, 1e11)), 3)  # 16^(1/1.8)
    4.666
    >>> f"{cell.crossover_force(1e11, decay=1e-6):.2f} N"
    '87.93 N'
    """

    hurst: float
    rms: float
    length: float
    prefactor: float | None = None

    def __post_init__(self) -> None:
        require_numbers(self)
        require(
            0 < self.hurst <= pohrt_popov.SMOOTH,
            f"the power law of a cell is known for Hurst exponents above 0 and at most 2, not {self.hurst}: "
            "below, no cell is dominant; above, the exponent stays at 1/3",
            place="hurst",
        )
        positive(self.rms, "the rms height [m]")
        positive(self.length, "the side of a cell [m]")
        positive(self.zeta, "the prefactor of the power law")

    @property
    def zeta(self) -> float:
        """Prefactor of the power law [-]."""
        return float(pohrt_popov.prefactor(self.hurst)) if self.prefactor is None else self.prefactor

    @numeric
    def stiffness(self, force: float | Array, modulus: float) -> Array:
        """Return the stiffness [N/m] if the cell carries the whole `force` [N]; `modulus` is E* [Pa].

        Parameters
        ----------
        force : float or array
            Normal force F [N].
        modulus : float
            Reduced modulus E* [Pa].

        Returns
        -------
        float or array
            k [N/m].
        """
        scale = positive(modulus, "the modulus [Pa]") * self.length
        ratio = positive(force, "the force [N]", zero=True) / (scale * self.rms)
        return np.asarray(scale * self.zeta * ratio ** (1 / (self.hurst + 1)))

    @numeric
    def crossover_force(self, modulus: float, decay: float) -> float:
        """Return the force [N] at which the cell is as stiff as F/u0, ``E* h l (zeta u0/h)^((H+1)/H)``.

        Over the nominal area of the surface it is the crossover pressure.

        Parameters
        ----------
        modulus : float
            Reduced modulus E* [Pa].
        decay : float
            u0 [m], see `persson_separation.decay_length`.

        Returns
        -------
        float
            F [N].
        """
        scale = float(positive(modulus, "the modulus [Pa]")) * self.length * self.rms
        length = moderate(float(positive(decay, "the decay length [m]")), "the decay length [m]")
        meeting = self.zeta * length / self.rms
        return scale * math.pow(meeting, (self.hurst + 1) / self.hurst)


@numeric
def law(
    cell: Cell, spectrum: Spectrum, modulus: float, area: float, *, gamma: float = separation.GAMMA
) -> LoadingLaw:
    """Return the stiffness of the interface with the finite-size crossover: the stiffer of a cell and Persson's law.

    Parameters
    ----------
    cell : Cell
        With the rms height of the surface and the length of its longest waves.
    spectrum : Waves, measured or continuous spectrum
        Of the surface.
    modulus : float
        Reduced modulus E* [Pa].
    area : float
        Nominal area [m^2], at least that of a cell.
    gamma : float
        See `persson_separation`.

    Returns
    -------
    LoadingLaw
        "interfacial_stiffness".

    Raises
    ------
    ValueError
        If a number is out of range, or the cell larger than the surface.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import finite_size, persson_separation
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> law = finite_size.law(finite_size.Cell(0.8, rms=1e-6, length=1e-3), spectrum, 1e11, area=1e-6)
    >>> persson = 1e-6 * persson_separation.stiffness(1e-3 / 1e-6, 1e11, spectrum)
    >>> bool(law.predict("interfacial_stiffness", 1e-3) > persson)  # at low force a single cell is stiffer
    True
    """
    waves, nominal = Waves.of(spectrum), float(positive(area, "the nominal area [m^2]"))
    fits = cell.length**2 <= nominal * (1 + 1e-9)
    require(
        fits, f"a cell of side {cell.length} m is larger than the nominal area of {area} m^2", place="cell"
    )

    stiffness = partial(_stiffness, cell, waves, modulus, nominal, gamma)
    stiffness(np.array([0.0]))  # invalid numbers raise here, not at the first prediction
    return LoadingLaw(
        "Finite size",
        "after Pastewka et al., Phys. Rev. E 87, 062809 (2013), heuristic",
        {"interfacial_stiffness": stiffness},
    )


def _stiffness(cell: Cell, waves: Waves, modulus: float, area: float, gamma: float, force: Array) -> Array:
    many = area * separation.stiffness(force / area, modulus, waves, gamma=gamma)
    return np.asarray(np.maximum(cell.stiffness(force, modulus), many))
