"""Contacts of random surfaces that a combined spectrum allows: what its errors and the scatter of places mean."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Literal, TypeAlias

import numpy as np
import scipy.fft
from scipy.stats import chi2

from roughcontact.contact.convergence import ConvergenceError
from roughcontact.contact.measures import StateMeasure, measured_at
from roughcontact.contact.press import press
from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.materials import Modulus
from roughcontact.measurement.combined_spectrum import CombinedSpectrum
from roughcontact.measurement.scales import band_nodes, scales_of
from roughcontact.progress.events import tracked
from roughcontact.surface.generation.fourier import synthesise
from roughcontact.validation import Array, RngLike, as_generator, numeric, positive_scalar, require, whole

__all__ = ["PressedDraws", "press_draws"]

Target: TypeAlias = Literal["specimen", "mean"]
CELLS = 6  # of the shortest wave
LARGEST = 2048  # cells a side
WAVES = 4  # of the shortest along a side, at least
OCTAVE = math.log(2)  # over which errors of ln C are correlated
PAIRS = 2  # surfaces of a draw by its spectrum and, with the same waves, by the measured one, if the mean is asked for
NORMAL = 1e6  # degrees of freedom of a Gaussian, for which the quantile is finite
ROUNDING = 1e-9
NUMBERS = ("contact_fraction", "interfacial_stiffness_per_area", "mean_gap")


@dataclass(frozen=True, slots=True, eq=False)
class PressedDraws:
    """Numbers of a contact with their intervals, from surfaces drawn by a measured spectrum.

    Attributes
    ----------
    of : {"specimen", "mean"}
    nominal_pressure : float
        [Pa]
    size : float
        Side of the surfaces [m].
    values : dict of array, shape (draws,)
        ``contact_fraction``, ``interfacial_stiffness_per_area`` [Pa/m], ``mean_gap`` [m] and the columns of the
        measures, of each draw; without the refused ones.
    rests_on : dict of str
        The waves on which each of these numbers rests.
    refused : dict of str
        Numbers that need waves beyond the band of the spectrum: which, and what to measure.
    notes : tuple of str
        What to know of the numbers, the most important first.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rough = rc.self_affine(rc.Grid((96, 96), 1e-6, periodic=True), hurst=0.8, rms=1e-7, rng=1)
    >>> places = [rough.cropped(slice(k, k + 64), slice(k, k + 64)) for k in (0, 32)]
    >>> spectrum = rc.Measurements.of(dict(zip("ab", places))).combined_spectrum()
    >>> found = rc.press_draws(spectrum, 1e9, pressure=1e6, size=60e-6, draws=3, rng=1)
    >>> f"{found.level:.0%}", sorted(found.values), sorted(found.refused)
    ('50%', ['contact_fraction'], ['interfacial_stiffness_per_area', 'mean_gap'])
    """

    of: Target
    nominal_pressure: float
    size: float
    values: Mapping[str, Array]
    rests_on: Mapping[str, str]
    refused: Mapping[str, str]
    notes: tuple[str, ...]

    @property
    def level(self) -> float:
        """Probability of the intervals: (n - 1)/(n + 1) for n draws, since the next specimen has any rank alike."""
        count = next(iter(self.values.values())).size
        return (count - 1) / (count + 1)

    @property
    def intervals(self) -> dict[str, tuple[float, float]]:
        """The smallest and the largest value of each number."""
        return {name: (float(each.min()), float(each.max())) for name, each in self.values.items()}


@numeric(modulus="Pa", pressure="Pa", size="m")
def press_draws(
    spectrum: CombinedSpectrum,
    modulus: Modulus,
    pressure: float,
    size: float,
    *,
    measures: Sequence[StateMeasure] = (),
    draws: int = 19,
    of: Target = "specimen",
    rng: RngLike = None,
) -> PressedDraws:
    """Press random surfaces that a measured spectrum allows, and return intervals of area, stiffness and gap.

    Each draw is the spectrum with an error, on a periodic square with Gaussian heights. The square has the waves of
    the band and no others.

    Parameters
    ----------
    spectrum : CombinedSpectrum
        Of maps ("C2D"), at least two bins.
    modulus : float, Solid, Material, str, or a pair of bodies
        Reduced modulus E* [Pa], or the bodies that it follows from.
    pressure : float
        Nominal pressure [Pa].
    size : float
        Side of the specimen [m].
    measures : sequence of callables
        Further numbers of each contact, such as `Transmissivity` for the leak.
    draws : int
        Their smallest and largest value are the interval: 90 % for 19 draws, 95 % for 39.
    of : {"specimen", "mean"}
        The next specimen, whose spectrum scatters between places and whose waves are new; or the mean over specimens
        of the mean spectrum, to which only the error of the spectrum counts: each draw takes four contacts.
    rng : int, numpy.random.Generator, SeedSequence, BitGenerator or None
        Source of errors and waves.

    Returns
    -------
    PressedDraws

    Raises
    ------
    ValueError
        If the spectrum is one of profiles or does not hold the scatter between places, or the size is too small or too
        large for its band.
    ConvergenceError
        If a contact missed the tolerance.

    Notes
    -----
    The error of ln C is Gaussian (Student's t for few degrees of freedom). Its part ``log_waves`` is independent
    between bins. The rest of ``log_error`` has the covariance ``s s' exp(-(ln q - ln q')^2/(ln 2)^2)``: correlated
    over an octave. For the next specimen the square of ``log_spread`` is added to its square. The shortest wave has
    six cells.

    A mean is that of all surfaces of the measured spectrum plus the difference that the error of a draw makes on two
    of them, so that the scatter of surfaces does not widen the interval. The error of the mean of all is added by
    bootstrap.

    For draws from the distribution of the next specimen, each rank of it among them is equally probable. Therefore it
    lies between the extremes of n with the probability (n - 1)/(n + 1), whatever the distribution.

    A/A0 is that of the waves in the band: shorter waves make it smaller. K/A0 needs the band from the
    roll-off l, where q^2 C(q) is largest, to l/8. All numbers except A/A0 need the long end: waves beyond the band, as
    long as the size, may hold 5 % of the mean square height if the spectrum is flat there. A number that needs more is
    refused.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rough = rc.self_affine(rc.Grid((192, 192), 1e-6, periodic=True), hurst=0.8, rms=1e-7, rng=1)
    >>> places = [rough.cropped(slice(k, k + 128), slice(k, k + 128)) for k in (0, 64)]
    >>> spectrum = rc.Measurements.of(dict(zip("ab", places))).combined_spectrum()
    >>> found = rc.press_draws(spectrum, 1e9, pressure=1e6, size=32e-6, rng=1)
    >>> low, high = found.intervals["mean_gap"]
    >>> f"{low * 1e9:.0f} to {high * 1e9:.0f} nm at {found.level:.0%}, by {found.rests_on['mean_gap']}"
    '5 to 42 nm at 90%, by waves from 3.2e-05 m to 4e-06 m'
    """
    if spectrum.kind != "C2D":
        raise about(
            "spectrum", "must be that of maps (C2D), not of profiles", "combine maps without profiles"
        )
    require(
        spectrum.wavenumber.size > 1,
        "the spectrum needs at least two bins",
        "measure a wider band",
        place="spectrum",
    )
    require(of in ("specimen", "mean"), f"of must be 'specimen' or 'mean', not {of!r}", place="of")
    if whole(draws, "draws") < 2:
        raise about("draws", "must be at least 2", "give 19 for an interval of 90 %")
    scales = scales_of(spectrum, positive_scalar(size, "size [m]"))
    grid, (shared, notes), random = (
        _grid(size, scales.shortest),
        _shared_error(spectrum, of),
        as_generator(rng),
    )

    def pressed(density: Callable[[Array], Array], waves: RngLike) -> dict[str, float]:
        solution = press(synthesise(grid, density, waves, amplitudes="gaussian"), modulus, pressure=pressure)
        if not solution.status.converged:
            raise ConvergenceError(solution)
        numbers = {name: float(getattr(solution, name)) for name in NUMBERS}
        return numbers | measured_at(solution, measures, NUMBERS)

    measured = partial(_density, *band_nodes(spectrum))
    found, base = [], []
    for density in tracked(_curves(spectrum, shared, draws, random), "Pressing draws", "draws", draws):
        if of == "mean":
            waves = random.integers(2**63, size=PAIRS)
            found.append(_mean([pressed(density, int(seed)) for seed in waves]))
            base.append(_mean([pressed(measured, int(seed)) for seed in waves]))
        else:
            found.append(pressed(density, random))
    columns = {name: np.array([row[name] for row in found]) for name in found[0]}
    if of == "mean":
        again = random.integers(draws, size=(draws, draws))
        for name, column in columns.items():
            level = np.array([row[name] for row in base])
            columns[name] = column - level + level[again].mean(axis=1)
    refused = {name: why for name in columns if (why := scales.lacking(name))}
    lacking = [Note(Rank.LIMITED, f"{name} is refused: {why}") for name, why in refused.items()]
    given = [name for name in columns if name not in refused]
    return PressedDraws(
        of,
        pressure,
        size,
        {name: columns[name] for name in given},
        {name: scales.rests_on(name) for name in given},
        refused,
        (*in_order([*notes, *lacking]), *spectrum.notes),
    )


def _grid(size: float, shortest: float) -> Grid:
    """Return a periodic square on which the shortest wave has six cells."""
    if size < WAVES * shortest * (1 - 1e-9):
        raise about(
            "size [m]",
            f"must be at least four of the shortest waves, {shortest:.3g} m, not {size:.3g}",
            f"give {1.005 * WAVES * shortest:.3g} m or more",
        )
    cells = scipy.fft.next_fast_len(math.ceil(CELLS * size / shortest * (1 - 1e-9)), real=True)
    if cells > LARGEST:
        raise about(
            "size [m]",
            f"needs {cells} cells a side for the shortest wave of {shortest:.3g} m, more than {LARGEST}",
            f"give at most {0.995 * LARGEST / CELLS * shortest:.3g} m",
        )
    return Grid((cells, cells), size / cells, periodic=True)


def _mean(rows: Sequence[Mapping[str, float]]) -> dict[str, float]:
    """Return the mean of each number."""
    return {name: float(np.mean([row[name] for row in rows])) for name in rows[0]}


def _shared_error(spectrum: CombinedSpectrum, of: Target) -> tuple[Array, list[Note]]:
    """Return the standard deviation of ln C of a draw at each bin, without the part that bins do not share."""
    error = np.sqrt(np.maximum(spectrum.log_error**2 - spectrum.log_waves**2, 0.0))
    if of == "mean":
        return error, []
    known = np.isfinite(spectrum.log_spread)
    if not known.any():
        raise InputError(
            "the scatter between places is not known from one map",
            "measure at least two places, or give of='mean'",
            "spectrum",
        )
    q = np.log(spectrum.wavenumber)
    spread = np.interp(q, q[known], spectrum.log_spread[known])
    text = f"the scatter between places is not known in {np.sum(~known)} of {q.size} bins: that of the nearest is used"
    notes = [] if known.all() else [Note(Rank.LIMITED, text)]
    return np.hypot(error, spread), notes


def _curves(
    spectrum: CombinedSpectrum, shared: Array, draws: int, random: np.random.Generator
) -> Iterator[Callable[[Array], Array]]:
    """Yield spectra C(q) [m^4] drawn about the measured one, zero beyond its band."""
    nodes, mean = band_nodes(spectrum)
    q = nodes[1:-1]
    correlation = np.exp(-(((q[:, None] - q) / OCTAVE) ** 2))
    values, vectors = np.linalg.eigh(correlation)
    root = vectors * np.sqrt(np.maximum(values, 0.0))  # of a matrix that is singular to rounding
    freedom = np.minimum(spectrum.freedom, NORMAL)
    for _ in range(draws):
        wider = np.sqrt(freedom / chi2.ppf(random.uniform(), freedom))
        own, common = random.standard_normal((2, q.size))
        off = wider * (spectrum.log_waves * own + shared * (root @ common))
        yield partial(_density, nodes, mean + np.interp(nodes, q, off))


def _density(nodes: Array, values: Array, wavenumber: Array) -> Array:
    """Return C at wavenumbers by straight lines between the nodes ln q of ln C."""
    x = np.log(wavenumber)
    inside = (x > nodes[0] - ROUNDING) & (x < nodes[-1] + ROUNDING)
    return np.where(inside, np.exp(np.interp(x, nodes, values)), 0.0)
