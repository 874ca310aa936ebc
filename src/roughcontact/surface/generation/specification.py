"""The specification of a joint: rms height, mean slope, and the numbers that determine its spectrum."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from roughcontact.errors import InputError
from roughcontact.grid import Grid
from roughcontact.surface.generation.fourier import self_affine
from roughcontact.surface.generation.spectrum import SelfAffineSpectrum
from roughcontact.surface.moments import grid_moments
from roughcontact.surface.surface import Surface
from roughcontact.validation import RngLike, exactly_one, numeric, positive, require, require_numbers

__all__ = ["SurfaceSpecification", "specified"]

SLOPE_ERROR = 0.02  # of a surface: waves of a grid are a sum, with steps at the short cut-off
WIDEST = math.log(1e6)  # largest ratio of roll-off and short cut-off in the search
# Each fixes one of the two lengths of a spectrum with known rms height and Hurst exponent.
LENGTHS = ("slope", "rolloff", "correlation_length", "short_cutoff", "nayak")
NODES = 8193  # of the autocorrelation, even in the logarithm
FIRST_ZERO = 3.8317  # zero of J1: there the autocorrelation of a flat disc is 0, that of other spectra lower
_UNITS = {"sigma": " m", "rolloff": " m", "correlation_length": " m", "short_cutoff": " m"}


@dataclass(frozen=True, slots=True, kw_only=True)
class SurfaceSpecification:
    """Rms height and mean slope of a joint, both faces together, and further numbers of its roughness.

    It has the profile moments of an isotropic Gaussian surface, and theories accept it in place of the moments of a
    surface. A moment, or the spectrum, that the given numbers do not determine raises an error that names what is
    missing. Create it by `roughcontact.specified`.

    Parameters
    ----------
    sigma : float
        Root mean square height [m].
    slope : float, optional
        Mean absolute slope m of a profile [-].
    hurst : float, optional
        Hurst exponent of the spectrum, from 0 to 1.
    nayak : float, optional
        Nayak's parameter ``m0 m4/m2^2`` [-], above 3/2.
    rolloff, correlation_length, short_cutoff : float, optional
        Lengths of the spectrum [m], see `roughcontact.specified`.

    Raises
    ------
    ValueError
        If a number is out of range, a length is given without `hurst`, or there are more numbers than unknowns of the
        spectrum.

    Examples
    --------
    >>> import roughcontact as rc
    >>> joint = rc.SurfaceSpecification(sigma=1.2e-6, slope=0.12)
    >>> f"rms height {joint.m0**0.5 * 1e6:.1f} um, rms slope of a profile {joint.m2**0.5:.4f}"
    'rms height 1.2 um, rms slope of a profile 0.1504'
    """

    sigma: float
    slope: float | None = None
    hurst: float | None = None
    nayak: float | None = None
    rolloff: float | None = None
    correlation_length: float | None = None
    short_cutoff: float | None = None

    def __post_init__(self) -> None:
        require_numbers(self, sigma="m", rolloff="m", correlation_length="m", short_cutoff="m")
        for name in ("sigma", *LENGTHS):
            value = getattr(self, name)
            if value is not None and not (math.isfinite(value) and value > 0):
                raise InputError(
                    f"`{name}` must be positive and finite, not {value}", "give a positive number", name
                )
        if self.hurst is not None and not 0 <= self.hurst <= 1:
            raise InputError(
                f"`hurst` lies between 0 and 1, not {self.hurst}", "give 0.8, for example", "hurst"
            )
        if self.nayak is not None and self.nayak <= 1.5:
            raise InputError(
                f"Nayak's parameter of a surface is above 3/2, not {self.nayak}",
                "give a larger `nayak`: 2 is a narrow band of waves, 100 a wide one",
                "nayak",
            )
        if self.rolloff is not None and self.correlation_length is not None:
            raise InputError(
                "`rolloff` and `correlation_length` both fix the long end of the spectrum",
                "give one of them",
                "rolloff, correlation_length",
            )
        given = self._given
        if self.hurst is None and (alone := [name for name in given if name not in ("slope", "nayak")]):
            raise InputError(
                f"`{alone[0]}` is a length of a self-affine spectrum, whose exponent is not given",
                "also give `hurst`",
                "hurst",
            )
        if len(given) > 2:
            names = ", ".join(f"`{name}`" for name in given)
            raise InputError(
                f"{names} are {len(given)} numbers for the two lengths of the spectrum",
                "omit one of them",
                ", ".join(given),
            )

    @property
    def m0(self) -> float:
        """Mean square height [m^2]."""
        return self.sigma**2

    @property
    def m2(self) -> float:
        """Mean square slope of a profile [-]: ``pi m^2/2`` for Gaussian slopes, otherwise that of the spectrum."""
        return self._spectrum("slope").moments().m2 if self.slope is None else math.pi / 2 * self.slope**2

    @property
    def m4(self) -> float:
        """Mean square curvature of a profile [1/m^2]."""
        if self.nayak is not None and self.slope is not None:
            return self.nayak * self.m2**2 / self.m0
        return self._spectrum("nayak" if self.slope else "").moments().m4

    @property
    def has_spectrum(self) -> bool:
        """Whether the given numbers determine the spectrum."""
        return self.hurst is not None and len(self._given) == 2

    @property
    def spectrum(self) -> SelfAffineSpectrum:
        """Spectrum C2D: constant up to a roll-off, then self-affine up to a short cut-off.

        Raises
        ------
        ValueError
            If the given numbers do not determine it, or no such spectrum has them.
        """
        return self._spectrum()

    def surface(self, grid: Grid, rng: RngLike) -> Surface:
        """Return a random surface with this rms height and spectrum.

        Parameters
        ----------
        grid : Grid
            Of two axes. A side must hold several roll-offs, and the shortest wave several cells.
        rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
            Source of the phases, see `roughcontact.self_affine`.

        Returns
        -------
        Surface
            Its rms height is `sigma`, and its rms slope that of the specification within 2 %.

        Raises
        ------
        ValueError
            If the spectrum is not determined, or the waves of the grid do not have its slope.

        Examples
        --------
        >>> import roughcontact as rc
        >>> joint = rc.specified(sigma=1.2e-6, slope=0.12, hurst=0.8, rolloff=64e-6)
        >>> surface = joint.surface(rc.Grid((256, 256), 2e-6, periodic=True), rng=1)
        >>> f"{surface.rms * 1e6:.2f} um, {rc.theory.thermal.mean_absolute_slope(rc.surface_moments(surface)):.3f}"
        '1.20 um, 0.120'
        """
        if grid.ndim != 2:
            raise InputError(
                "a specification describes a surface, not a line", "give a grid of two axes", "grid"
            )
        law = self.spectrum
        longest, shortest = 2 * math.pi / law.q_rolloff, 2 * math.pi / law.q_max
        moments = grid_moments(grid, law.scaled(self.sigma, grid))
        made = math.sqrt(moments.m2 / law.moments().m2)
        if made < 1 - SLOPE_ERROR:
            points = " x ".join(str(math.ceil(4 * length / shortest)) for length in grid.lengths)
            raise InputError(
                f"the waves of this grid have {made:.3g} times the slope that was specified: the shortest wave, "
                f"{shortest:.3g} m, has {shortest / max(grid.spacing):.2g} cells",
                f"give it four cells: {points} points on the same sides",
            )
        if made > 1 + SLOPE_ERROR:
            raise InputError(
                f"the waves of this grid have {made:.3g} times the slope that was specified: a side holds "
                f"{min(grid.lengths) / longest:.2g} roll-offs of {longest:.3g} m",
                f"make each side at least {8 * longest:.3g} m long, eight roll-offs, with the same cells",
            )
        surface = self_affine(grid, law.hurst, self.sigma, rng, rolloff=longest, short_cutoff=shortest)
        stated = self._words("sigma", "hurst", *self._given).replace("`", "")
        line = (
            f"as specified: {stated}; its waves have the mean slope {math.sqrt(2 * moments.m2 / math.pi):.4g}"
        )
        return replace(surface, provenance=(*surface.provenance, line))

    @property
    def _given(self) -> tuple[str, ...]:
        return tuple(name for name in LENGTHS if getattr(self, name) is not None)

    def _spectrum(self, instead: str = "") -> SelfAffineSpectrum:
        """Return the spectrum; the error about missing numbers names what can be given `instead` of it."""
        if self.hurst is None or not self.has_spectrum:
            raise self._open(instead)
        hurst, (first, last) = self.hurst, self._given
        wanted: float = getattr(self, last)

        def excess(width: float) -> float:
            return math.log(self._of_width(hurst, first, width)[last] / wanted)

        ends = excess(0.0), excess(WIDEST)
        if ends[0] * ends[1] > 0:
            low, high = sorted(wanted * math.exp(end) for end in ends)
            raise InputError(
                f"no self-affine spectrum has {self._words('sigma', 'hurst', first, last)}",
                f"give a `{last}` between {low:.4g} and {high:.4g}{_UNITS.get(last, '')}",
                last,
            )
        from scipy.optimize import brentq

        found = self._of_width(hurst, first, brentq(excess, 0.0, WIDEST, xtol=1e-13))
        law = SelfAffineSpectrum(hurst, rolloff=found["rolloff"], short_cutoff=found["short_cutoff"])
        return law.scaled(self.sigma)

    def _of_width(self, hurst: float, first: str, width: float) -> dict[str, float]:
        """Return lengths and Nayak's parameter of the spectrum for the first given number.

        Its `width` is the logarithm of roll-off over short cut-off.
        """
        unit = SelfAffineSpectrum(hurst, rolloff=1.0, short_cutoff=math.exp(-width))
        moments = unit.moments()
        given: float = getattr(self, first)
        decay = _correlation_length(unit) if self.correlation_length else math.nan
        rolloff = {
            "slope": math.sqrt(moments.m2 / moments.m0) * self.sigma / (math.sqrt(math.pi / 2) * given),
            "rolloff": given,
            "correlation_length": given / decay,
            "short_cutoff": given * math.exp(width),
        }[first]
        return {
            "rolloff": rolloff,
            "correlation_length": rolloff * decay,
            "short_cutoff": rolloff * math.exp(-width),
            "nayak": moments.nayak,
        }

    def _open(self, instead: str) -> InputError:
        """Return the error that names the missing numbers."""
        given = self._given
        known = ["sigma", *(["hurst"] if self.hurst is not None else []), *given]
        long_end = {"rolloff", "correlation_length"}
        left = [
            name
            for name in LENGTHS
            if name not in (*given, instead) and not (name in long_end and long_end.intersection(given))
        ]
        missing = [] if self.hurst is not None else ["`hurst`"]
        if len(given) < 2:
            missing.append(f"{('two', 'one')[len(given)]} of {', '.join(f'`{name}`' for name in left)}")
        or_else = f"`{instead}`, or " if instead else ""
        return InputError(
            f"{', '.join(known[:-1])} and {known[-1]} do not determine the bandwidth of the roughness",
            f"give {or_else}{' and '.join(missing)}",
            instead or ("hurst" if self.hurst is None else ", ".join(left)),
        )

    def _words(self, *names: str) -> str:
        return ", ".join(f"`{name}` {getattr(self, name):.6g}{_UNITS.get(name, '')}" for name in names)


@numeric(sigma="m", ra="m", rz="m", rolloff="m", correlation_length="m", short_cutoff="m")
def specified(
    *,
    sigma: float | tuple[float, float] | None = None,
    ra: float | tuple[float, float] | None = None,
    rz: float | tuple[float, float] | None = None,
    rz_over_ra: float | None = None,
    slope: float | tuple[float, float] | None = None,
    hurst: float | None = None,
    nayak: float | None = None,
    rolloff: float | None = None,
    correlation_length: float | None = None,
    short_cutoff: float | None = None,
) -> SurfaceSpecification:
    """Return a joint from the numbers of a specification: heights, slope, and numbers that determine its spectrum.

    Heights and slope are those of both faces together, or a pair of numbers, one of each face, which are combined:
    ``sigma^2 = sigma1^2 + sigma2^2``, ``m^2 = m1^2 + m2^2``.

    Parameters
    ----------
    sigma : float or pair of floats, optional
        Root mean square height [m].
    ra : float or pair of floats, optional
        Mean absolute height Ra [m] instead: for Gaussian heights sigma is ``sqrt(pi/2) Ra``.
    rz : float or pair of floats, optional
        Rz of a drawing [m] instead, a height of peaks and valleys. It needs `rz_over_ra`.
    rz_over_ra : float, optional
        Measured ratio of Rz and Ra of faces made in the same way.
    slope : float or pair of floats, optional
        Mean absolute slope m of a profile [-]. For Gaussian slopes it is ``sqrt(2/pi)`` times the rms slope of a
        profile (Rdq), and ``1/sqrt(pi)`` times that of the surface (Sdq).
    hurst : float, optional
        Hurst exponent, from 0 to 1. With two of `slope` and the following numbers, it determines the spectrum.
    nayak : float, optional
        Nayak's parameter ``m0 m4/m2^2`` [-], the bandwidth. With `slope` it determines the moments without `hurst`.
    rolloff : float, optional
        Roll-off wavelength [m]: the spectrum of longer waves is constant.
    correlation_length : float, optional
        Lag [m] at which the autocorrelation falls to 1/e, instead of `rolloff`.
    short_cutoff : float, optional
        Shortest wavelength [m].

    Returns
    -------
    SurfaceSpecification

    Raises
    ------
    ValueError
        If not exactly one height is given, a pair stands beside a single number, Rz is given without its ratio, or
        `SurfaceSpecification` refuses the numbers.

    Examples
    --------
    >>> import roughcontact as rc
    >>> joint = rc.specified(sigma=(1.2e-6, 1.2e-6), slope=(0.12, 0.12))  # two faces
    >>> f"sigma {joint.sigma * 1e6:.3f} um, m {joint.slope:.4f}"
    'sigma 1.697 um, m 0.1697'
    >>> ground = rc.specified(ra=0.8e-6, slope=0.1, hurst=0.8, correlation_length=20e-6)
    >>> f"roll-off {ground.spectrum.rolloff * 1e6:.0f} um, shortest wave {ground.spectrum.short_cutoff * 1e6:.1f} um"
    'roll-off 82 um, shortest wave 4.2 um'
    """
    name, height = exactly_one(sigma=sigma, ra=ra, rz=rz)
    if (rz is None) != (rz_over_ra is None):
        message = "`rz` is a height of peaks and valleys, which does not determine the rms height"
        remedy = "give `rz_over_ra`, as measured on such faces, or `ra` or `sigma` in place of `rz`"
        if rz is None:
            message, remedy = "`rz_over_ra` belongs to `rz`, which is not given", "omit it"
        raise InputError(message, remedy, "rz_over_ra")
    if slope is not None and np.ndim(slope) != np.ndim(height):
        raise InputError(
            f"one of `{name}` and `slope` is a pair, one number for each face, and the other is a single number",
            "give both as pairs, or both as single numbers for the two faces together",
            f"{name}, slope",
        )
    factor = 1.0 if name == "sigma" else math.sqrt(math.pi / 2) / (1.0 if rz_over_ra is None else rz_over_ra)
    return SurfaceSpecification(
        sigma=factor * _together(height, name),
        slope=None if slope is None else _together(slope, "slope"),
        hurst=hurst,
        nayak=nayak,
        rolloff=rolloff,
        correlation_length=correlation_length,
        short_cutoff=short_cutoff,
    )


def _together(values: float | tuple[float, float], name: str) -> float:
    """Return the number of both faces together."""
    given = np.atleast_1d(positive(values, f"`{name}`"))
    require(
        given.shape in ((1,), (2,)), f"`{name}` is one number or two", "give one for each face", place=name
    )
    return float(np.hypot.reduce(given))


def _correlation_length(law: SelfAffineSpectrum) -> float:
    """Return the lag at which the autocorrelation of a spectrum with a roll-off of 1 m falls to 1/e [m]."""
    from scipy.optimize import brentq
    from scipy.special import j0, j1

    bend, m0 = law.q_rolloff, law.moments().m0
    q = np.geomspace(bend, law.q_max, NODES)
    powers = 2 * math.pi * q**2 * law(q)
    flat = 2 * math.pi * bend * float(law(np.array([bend]))[0])

    def above(lag: float) -> float:
        waves = float(np.trapezoid(powers * j0(q * lag), np.log(q))) + flat * float(j1(bend * lag)) / lag
        return waves / m0 - math.exp(-1)

    return float(brentq(above, 1e-9, FIRST_ZERO / bend, xtol=1e-12))
