"""Loading laws by name: the data that each needs, and the function that makes it."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, replace
from functools import partial
from types import MappingProxyType
from typing import TypedDict, Unpack

from roughcontact.errors import InputError
from roughcontact.theory.asperity_models import bush_gibson_thomas, greenwood_williamson, interaction
from roughcontact.theory.joints import joint
from roughcontact.theory.law import LoadingLaw
from roughcontact.theory.persson_theory import persson, persson_plastic
from roughcontact.theory.plastic_asperities import chang_etsion_bogy, kogut_etsion, pullen_williamson
from roughcontact.theory.random_surfaces.profile_moments import ProfileMoments
from roughcontact.theory.random_surfaces.waves import Spectrum, Waves
from roughcontact.theory.spheres_and_punches import hertz, rough_sphere
from roughcontact.theory.stiffness_laws import finite_size, pohrt_popov, rough_square
from roughcontact.validation import require

__all__ = ["LAWS", "LawInputs", "NamedLaw", "named"]


@dataclass(frozen=True, slots=True, eq=False)
class LawInputs:
    """Known data of a rough contact; None means unknown.

    Parameters
    ----------
    modulus : float, optional
        Reduced modulus E* [Pa].
    area : float, optional
        Nominal area [m^2]; by default the square of `length`.
    length : float, optional
        Side of the surface [m]; by default the square root of `area`.
    spectrum : Waves, measured or continuous spectrum, optional
        C2D of the surface, see `Waves.of`.
    moments : ProfileMoments, optional
        By default those of the spectrum.
    rms : float, optional
        Root mean square height [m]; by default that of the moments.
    hurst : float, optional
        Hurst exponent [-].
    rolloff : float, optional
        Length of the longest waves [m]; by default `length`.
    radius : float, optional
        Radius of curvature of the nominal shape [m].
    hardness : float, optional
        Indentation hardness of the softer body [Pa].

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.theory import laws
    >>> spectrum = rc.SelfAffineSpectrum(0.8, long_cutoff=1e-3, short_cutoff=1e-5).scaled(1e-6)
    >>> inputs = laws.LawInputs(area=1e-6, spectrum=spectrum).completed()
    >>> f"length {inputs.length:.0e} m, rms {inputs.rms:.2e} m, slope {inputs.moments.rms_slope:.3f}"
    'length 1e-03 m, rms 1.00e-06 m, slope 0.029'
    """

    modulus: float | None = None
    area: float | None = None
    length: float | None = None
    spectrum: Spectrum | None = None
    moments: ProfileMoments | None = None
    rms: float | None = None
    hurst: float | None = None
    rolloff: float | None = None
    radius: float | None = None
    hardness: float | None = None

    def completed(self) -> LawInputs:
        """Return the inputs with defaults that follow from other inputs.

        Returns
        -------
        LawInputs
        """
        area, length, moments = self.area, self.length, self.moments
        if area is None and length is not None:
            area = length**2
        if length is None and area is not None:
            length = math.sqrt(area)
        if moments is None and self.spectrum is not None:
            moments = Waves.of(self.spectrum)
        rms = math.sqrt(moments.m0) if self.rms is None and moments is not None else self.rms
        rolloff = length if self.rolloff is None else self.rolloff
        return replace(self, area=area, length=length, moments=moments, rms=rms, rolloff=rolloff)


class GivenValues(TypedDict, total=False):
    """The fields of `LawInputs` except the modulus as keywords, for completion in editors."""

    area: float
    length: float
    spectrum: Spectrum
    moments: ProfileMoments
    rms: float
    hurst: float
    rolloff: float
    radius: float
    hardness: float


@dataclass(frozen=True, slots=True)
class NamedLaw:
    """A law with a name.

    Parameters
    ----------
    about : str
        One line for a list of laws.
    needs : tuple of str
        The inputs that it needs, in the order of the arguments of `make`.
    make : callable
        Returns the `LoadingLaw`.

    Examples
    --------
    >>> from roughcontact.theory import laws
    >>> laws.LAWS["persson"].about, laws.LAWS["persson"].needs
    ('nominally flat, many contacts (Persson)', ('spectrum', 'modulus', 'area'))
    """

    about: str
    needs: tuple[str, ...]
    make: Callable[..., LoadingLaw]


def _finite_size(
    hurst: float, rms: float, rolloff: float, spectrum: Spectrum, modulus: float, area: float
) -> LoadingLaw:
    return finite_size.law(finite_size.Cell(hurst, rms, rolloff), spectrum, modulus, area)


_NOMINALLY_FLAT = ("moments", "modulus", "area")
_WITH_HARDNESS = ("moments", "hardness", "modulus", "area")
_CUTS: Mapping[rough_square.Cut, str] = {
    "interior": "without contact at its border",
    "period": "one period cut at random",
    "patch": "cut out of a larger surface",
}

LAWS: Mapping[str, NamedLaw] = MappingProxyType(
    {
        "persson": NamedLaw(
            "nominally flat, many contacts (Persson)", ("spectrum", "modulus", "area"), persson.law
        ),
        "finite-size": NamedLaw(
            "Persson's law, and one cell of roughness at low loads (after Pastewka and others, heuristic)",
            ("hurst", "rms", "rolloff", "spectrum", "modulus", "area"),
            _finite_size,
        ),
        "gw": NamedLaw(
            "independent asperities of Gaussian heights (Greenwood and Williamson)",
            _NOMINALLY_FLAT,
            greenwood_williamson.law,
        ),
        "gw-exponential": NamedLaw(
            "independent asperities of exponential heights",
            _NOMINALLY_FLAT,
            partial(greenwood_williamson.law, distribution="exponential"),
        ),
        "bgt": NamedLaw(
            "independent elliptic summits of a Gaussian surface (Bush, Gibson and Thomas)",
            _NOMINALLY_FLAT,
            bush_gibson_thomas.law,
        ),
        "cgp": NamedLaw(
            "asperities on a body that yields as a whole (Ciavarella, Greenwood and Paggi)",
            _NOMINALLY_FLAT,
            interaction.law,
        ),
        "mikic": NamedLaw("elastic spots of a nominally flat joint (Mikic)", _NOMINALLY_FLAT, joint.mikic),
        "cmy": NamedLaw(
            "spots of a nominally flat joint that flow (Cooper, Mikic and Yovanovich)",
            _WITH_HARDNESS,
            joint.cooper_mikic_yovanovich,
        ),
        "ceb": NamedLaw(
            "asperities that keep their volume as they yield (Chang, Etsion and Bogy)",
            _WITH_HARDNESS,
            chang_etsion_bogy.law,
        ),
        "kogut-etsion": NamedLaw(
            "asperities from first yield to full plasticity (Kogut and Etsion)",
            _WITH_HARDNESS,
            kogut_etsion.law,
        ),
        "persson-plastic": NamedLaw(
            "elastic and plastic parts of the area (Persson)",
            ("spectrum", "hardness", "modulus", "area"),
            persson_plastic.law,
        ),
        "pullen-williamson": NamedLaw(
            "plastic contact under large loads (Pullen and Williamson)",
            ("hardness", "area"),
            pullen_williamson.law,
        ),
        "power-law": NamedLaw(
            "self-affine up to its own size (Pohrt and Popov)",
            ("hurst", "rms", "length", "modulus"),
            pohrt_popov.law,
        ),
        **{
            f"rough-square-{cut}": NamedLaw(
                f"free square, self-affine up to its own size, {words} (ensembles, with errors)",
                ("hurst", "rms", "length", "modulus"),
                partial(rough_square.law, cut=cut),
            )
            for cut, words in _CUTS.items()
        },
        "hertz": NamedLaw("smooth sphere (Hertz)", ("radius", "modulus"), hertz.law),
        "rough-sphere": NamedLaw(
            "sphere with self-affine roughness (thesis, eq. 5.9)",
            ("radius", "hurst", "rms", "length", "modulus"),
            rough_sphere.law,
        ),
    }
)


def named(name: str, *, modulus: float | None = None, **given: Unpack[GivenValues]) -> LoadingLaw:
    """Return a loading law by its name.

    Parameters
    ----------
    name : str
        One of ``LAWS``.
    modulus : float, optional
        Reduced modulus E* [Pa].
    **given
        The other fields of `LawInputs`, as far as they are known; further fields are ignored.

    Returns
    -------
    LoadingLaw

    Raises
    ------
    ValueError
        If the name or an input is not known, an input that the law needs is missing, or the law refuses one.

    Examples
    --------
    >>> from roughcontact.theory import laws
    >>> round(float(laws.named("hertz", radius=1e-2, modulus=1e11).predict("stiffness", 1.0)))
    8434327
    """
    require(name in LAWS, f"there is no law named {name!r}; there are {', '.join(LAWS)}")
    if strange := given.keys() - {field.name for field in fields(LawInputs)}:
        raise InputError(f"no law has the input {', '.join(sorted(strange))}")
    law, inputs = LAWS[name], LawInputs(modulus, **given).completed()
    wanted = {need: getattr(inputs, need) for need in law.needs}
    if missing := [need for need, value in wanted.items() if value is None]:
        raise InputError(f"the law {name!r} needs {', '.join(law.needs)}: {', '.join(missing)} missing")
    return law.make(*wanted.values())
