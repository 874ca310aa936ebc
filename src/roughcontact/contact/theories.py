"""From a surface to the theories of its contact: what they need to know, and what body they stand on."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import numpy.typing as npt

from roughcontact.arrays import is_numpy
from roughcontact.contact.solution import Solution
from roughcontact.halfspace.build import half_space
from roughcontact.material import Solid, as_modulus
from roughcontact.surface.analysis.hurst import hurst_exponent
from roughcontact.surface.analysis.spectra import power_spectrum
from roughcontact.surface.analysis.spectrum_moments import spectrum_moments
from roughcontact.surface.moments import surface_moments
from roughcontact.surface.surface import Surface
from roughcontact.theory import interaction, laws, persson
from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.waves import Waves

__all__ = ["loading_laws", "persson_pressures"]

Array = npt.NDArray[np.float64]


def loading_laws(
    surface: Surface, modulus: float | Solid | tuple[Solid, Solid], names: str | Sequence[str], **knowns: Any
) -> list[LoadingLaw]:
    """Return theories of the contact of a surface, to be laid over its loading curve by `Curve.compare`.

    Parameters
    ----------
    surface : Surface
        Levelled, on a grid of two axes; missing points are filled for the spectrum.
    modulus : float, Solid or pair of Solids
        Reduced modulus E* [Pa], or what it follows from.
    names : str or sequence of str
        Of `roughcontact.theory.laws.LAWS`: ``"persson"``, ``"gw"``, ``"bgt"``, ``"power-law"`` and others.
    **knowns
        What is known better than the surface tells: ``hurst``, ``rms``, ``spectrum``, ``moments``, ``rolloff``,
        ``radius``, see `roughcontact.theory.laws.SurfaceFacts`.

    Returns
    -------
    list of LoadingLaw
        In the order of the names. A theory of the interface alone gets the stiffness against the approach as
        well: on a periodic grid the same, on a free one with the compliance of the body under its nominal area.

    Raises
    ------
    ValueError
        If a name is none, the surface is a line, or a theory needs what the surface does not tell.

    Notes
    -----
    Spectrum and moments are those of the very waves of a periodic surface; of a free one those of its power
    spectrum under a window, over the band to be relied upon. The Hurst exponent is fitted where none is given.
    """
    if not isinstance(surface, Surface) or surface.grid.ndim != 2:
        raise ValueError("these theories are about surfaces; give a grid of two axes")
    if not is_numpy(surface.heights):
        raise ValueError("theories look at the heights in NumPy's memory: give a Surface of NumPy's numbers")
    wanted = [names] if isinstance(names, str) else list(names)
    value = as_modulus(modulus)
    if "cgp" in wanted and all(surface.grid.periodic):
        raise ValueError("cgp is about a body that sinks in as a whole: a periodic surface has none, take gw")
    whole = surface.filled() if surface.missing else surface  # a spectrum wants every point
    known = {"modulus": value, "area": surface.grid.area} | knowns
    for need in {
        need for name in wanted if name in laws.LAWS for need in laws.LAWS[name].needs
    } - known.keys():
        known |= _told_by(whole, need)
    return [_on_its_body(laws.named(name, **known), surface, value) for name in wanted]


def persson_pressures(solution: Solution) -> Callable[[Array], Array]:
    """Return Persson's probability density of the pressure [1/Pa] at the load of a solution, for comparison.

    A function of an array of pressures above zero [Pa]. Its integral is his contact fraction, its first moment the
    nominal pressure; compare with `Solution.pressure_histogram` times the contact fraction.

    Raises
    ------
    ValueError
        If the solution is not that of a surface on a grid of two axes.
    """
    surface = solution.on_host().problem.surface
    if not isinstance(surface, Surface) or surface.grid.ndim != 2:
        raise ValueError("Persson's theory is about surfaces on a grid of two axes")
    whole = surface.filled() if surface.missing else surface
    waves = Waves.of(_told_by(whole, "spectrum")["spectrum"])
    nominal = solution.force / surface.grid.area
    return lambda stress: persson.pressure_density(stress, nominal, solution.problem.modulus, waves)


def _told_by(surface: Surface, need: str) -> dict[str, Any]:
    """Return what the surface tells about one of the facts that theories need."""
    periodic = all(surface.grid.periodic)
    if need == "spectrum":
        if periodic:
            dy, dx = surface.grid.spacing
            return {"spectrum": Waves.of_heights(surface.heights, (dy, dx))}
        return {"spectrum": power_spectrum(surface)}
    if need == "moments":
        return {
            "moments": surface_moments(surface) if periodic else spectrum_moments(power_spectrum(surface))
        }
    if need == "rms":
        return {"rms": surface.rms}
    if need == "hurst":
        return {"hurst": hurst_exponent(surface).hurst}
    return {}


def _on_its_body(law: LoadingLaw, surface: Surface, modulus: float) -> LoadingLaw:
    """Return a law that speaks of the stiffness against the approach, if it speaks of any."""
    if "stiffness" in law.quantities or "interfacial_stiffness" not in law.quantities:
        return law
    grid = surface.grid
    if all(grid.periodic):
        more = {"stiffness": law.quantities["interfacial_stiffness"]}
        return replace(law, quantities=dict(law.quantities) | more)
    sunk = float(
        half_space(grid, modulus).apply(np.ones(grid.shape)).mean()
    )  # under a unit pressure everywhere
    deflection = sunk * modulus / math.sqrt(grid.area)
    return interaction.finite_body(law, modulus, grid.area, deflection=deflection)
