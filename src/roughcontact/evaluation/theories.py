"""Theories for the contact of a surface: their inputs from its heights, and the body below it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any, Unpack

import numpy as np

from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError
from roughcontact.grid import Grid
from roughcontact.halfspace.operators.build import half_space
from roughcontact.labels.engineering_units import written
from roughcontact.materials import Modulus, as_modulus
from roughcontact.surface.analysis.hurst import hurst_exponent
from roughcontact.surface.analysis.spectra import power_spectrum
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.theory import laws
from roughcontact.theory.asperity_models import interaction
from roughcontact.theory.law import LoadingLaw, Scope
from roughcontact.theory.persson_theory import persson
from roughcontact.theory.random_surfaces.waves import Waves
from roughcontact.validation import Array, numeric

__all__ = ["inputs_for", "loading_laws", "persson_pressures"]

SQUARE = 0.02  # relative difference of two sides of a square


@numeric(modulus="Pa")
@analysed_on_host
def loading_laws(
    surface: Surface,
    modulus: Modulus,
    names: str | Sequence[str],
    **given: Unpack[laws.GivenValues],
) -> list[LoadingLaw]:
    """Return theories of the contact of a surface, to be compared with its loading curve by `Curve.compare`.

    Parameters
    ----------
    surface : Surface
        Without tilt, on a grid of two axes; missing points are filled for the spectrum.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    names : str or sequence of str
        Names in ``roughcontact.theory.laws.LAWS``: ``"persson"``, ``"gw"``, ``"bgt"``, ``"power-law"`` and others, in
        upper or lower case.
    **given : dict
        Values to use instead of those from the heights: ``hurst``, ``rms``, ``spectrum``, ``moments``, ``rolloff``,
        ``radius``, ``hardness``, see `roughcontact.theory.laws.LawInputs`.

    Returns
    -------
    list of LoadingLaw
        In the order of the names, each with the contact it was `made_for`. A theory of only the interface also gets the
        stiffness against the approach: on a periodic grid it is the same, on a free grid the compliance of the body
        under its nominal area is added.

    Raises
    ------
    ValueError
        If there is no theory of a name, if the surface is a line, or if a theory needs a value that the surface does
        not give.

    Notes
    -----
    Spectrum and moments are those of the waves of a periodic surface; for a free surface, those of its power spectrum
    under a window, over the reliable band. The Hurst exponent is fitted if it is not given.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((32, 32), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=np.random.default_rng(1))
    >>> [law.name for law in rc.loading_laws(surface, 1e9, ["persson", "gw"])]
    ['Persson', 'Greenwood-Williamson']
    """
    if not isinstance(surface, Surface) or surface.grid.ndim != 2:
        raise InputError("these theories are for surfaces", "give a surface on a grid of two axes")
    wanted = [str(name).casefold() for name in ([names] if isinstance(names, str) else names)]
    value = as_modulus(modulus)
    if "cgp" in wanted and all(surface.grid.periodic):
        raise InputError("cgp is for a body that is indented as a whole, unlike a periodic surface", "use gw")
    if any(name.startswith("rough-square") for name in wanted):
        _require_rough_square(surface, given.get("rolloff"))
    known = {"modulus": value, "area": surface.grid.area} | inputs_for(surface, wanted, **given)
    found = _on_their_body([laws.named(name, **known) for name in wanted], surface.grid, value)
    scope = Scope(value, surface.grid.area, surface.rms, known.get("spectrum"))
    return [replace(law, made_for=scope) for law in found]


def inputs_for(surface: Surface, names: Sequence[str], **given: Unpack[laws.GivenValues]) -> dict[str, Any]:
    """Return the inputs of theories: the `given` values, and the others from the heights of a surface.

    The keys are those of `roughcontact.theory.laws.LawInputs`.
    """
    needs = {need for name in names if name in laws.LAWS for need in laws.LAWS[name].needs} - given.keys()
    found = dict(given)
    if needs & {"spectrum", "moments"}:  # the moments follow from the spectrum, also from a given one
        found.setdefault("spectrum", _waves(surface))
    if "rms" in needs:
        found["rms"] = surface.rms
    if "hurst" in needs:
        found["hurst"] = hurst_exponent(_whole(surface)).hurst
    if "rolloff" in needs:
        found["rolloff"] = math.sqrt(surface.grid.area)
    return found


def _require_rough_square(surface: Surface, rolloff: float | None) -> None:
    """Raise an error for a map that is not a free square with longest waves of its side.

    The fit finds roll-offs up to about an eighth of the side.
    """
    grid = surface.grid
    if any(grid.periodic):
        raise InputError(
            "the rough-square laws are those of a free square, and this map is periodic", "use persson"
        )
    height, width = (count * each for count, each in zip(grid.shape, grid.spacing, strict=True))
    if abs(height / width - 1) > SQUARE:
        shown = f"{written(width, 'm')} by {written(height, 'm')}"
        raise InputError(
            f"the rough-square laws are those of a square, and this map is {shown}", "crop it to a square"
        )
    longest = hurst_exponent(_whole(surface)).rolloff if rolloff is None else rolloff
    if longest is not None and longest < width * (1 - SQUARE):
        raise InputError(
            "the rough-square laws are those of surfaces that are self-affine up to their side, and this map has a "
            f"roll-off at {written(longest, 'm')}, with a side of {written(width, 'm')}",
            "use finite-size or persson",
        )


def persson_pressures(solution: Solution) -> Callable[[Array], Array]:
    """Return Persson's probability density of the pressure [1/Pa] at the load of a solution.

    It is a function of an array of pressures above zero [Pa]. Its integral is Persson's contact fraction, its first
    moment the nominal pressure; compare it with `Solution.pressure_histogram` times the contact fraction.

    Raises
    ------
    ValueError
        If the solution is not that of a surface on a grid of two axes.
    """
    surface = solution.on_host().problem.surface
    if not isinstance(surface, Surface) or surface.grid.ndim != 2:
        raise InputError("Persson's theory is for surfaces on a grid of two axes")
    waves = _waves(surface)
    nominal = solution.nominal_pressure
    modulus = solution.problem.modulus
    return partial(persson.pressure_density, pressure=nominal, modulus=modulus, surface=waves)


def _whole(surface: Surface) -> Surface:
    """Return the surface with a height at every point, as a spectrum requires."""
    return surface.filled() if surface.missing else surface


def _waves(surface: Surface) -> Waves:
    """Return the waves of a periodic surface, or the spectrum of a free surface in its reliable band."""
    whole = _whole(surface)
    if all(whole.grid.periodic):
        dy, dx = whole.grid.spacing
        return Waves.of_heights(whole.heights, (dy, dx))
    return Waves.of(power_spectrum(whole))


def _on_their_body(found: list[LoadingLaw], grid: Grid, modulus: float) -> list[LoadingLaw]:
    """Return laws with the stiffness against the approach, if they have a stiffness."""
    of_interface = [
        "stiffness" not in law.quantities and "interfacial_stiffness" in law.quantities for law in found
    ]
    if not any(of_interface):
        return found
    if all(grid.periodic):

        def standing(law: LoadingLaw) -> LoadingLaw:
            return replace(
                law, quantities={**law.quantities, "stiffness": law.quantities["interfacial_stiffness"]}
            )

    else:
        # Mean displacement under a uniform unit pressure, for E* = 1, over the length.
        deflection = float(half_space(grid, 1.0).apply(np.ones(grid.shape)).mean()) / math.sqrt(grid.area)

        def standing(law: LoadingLaw) -> LoadingLaw:
            return interaction.finite_body(law, modulus, grid.area, deflection=deflection)

    return [standing(law) if alone else law for law, alone in zip(found, of_interface, strict=True)]
