"""The Hurst exponent from the structure function of a band-limited surface."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Literal

import numpy as np
import numpy.typing as npt
from scipy.optimize import least_squares

from roughcontact.errors import InputError, about
from roughcontact.surface.analysis.correlation import tapered_structure
from roughcontact.surface.analysis.hurst import HurstFit
from roughcontact.surface.in_memory import analysed_on_host
from roughcontact.surface.surface import Surface
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array, numeric, require

__all__ = ["fit_structure"]

Limit = Literal["none", "rolloff", "long_cutoff"]
# Quadrature over the waves: directions to a quarter turn (twice this many), and wavenumbers on each.
ANGLES, WAVES = 12, 1500
# Longer lags than this many cells are not resolved by that quadrature.
LONGEST = 200
# Relative error of S by the quadrature and the model, added to the covariance.
ROUNDING = 1e-5


@dataclass(frozen=True, slots=True, eq=False)
class _Band:
    """All waves of a grid, by quadrature.

    Parameters
    ----------
    ln_q : array, shape (m,)
        Logarithms of the wavenumbers [rad/m].
    weight : array, shape (m,)
        Areas in the plane of wave vectors [rad^2/m^2].
    jumps : array, shape (k, m)
        ``1 - cos(q . r)`` for each lag.
    step : float
        Distance of the nodes in ln q.
    edge : array, shape (m,)
        Areas of only the Nyquist waves, zero except at the last node of each direction [rad^2/m^2].
    """

    ln_q: Array
    weight: Array
    jumps: Array
    step: float
    edge: Array

    def law(self, level: float, hurst: float, ln_low: float, limit: Limit) -> Array:
        """Return C2D of each wave: exp(level) at ln q = 0, a power law above `ln_low`."""
        bent = np.maximum(self.ln_q, ln_low) if limit == "rolloff" else self.ln_q
        density = np.exp(level - 2 * (hurst + 1) * bent)
        if limit == "long_cutoff":
            # A node that the limit cuts counts in part, so that S is continuous in the limit.
            density *= np.clip((self.ln_q - ln_low) / self.step + 0.5, 0, 1)
        return np.asarray(density)


@numeric
@analysed_on_host
def fit_structure(surface: Surface, *, limit: Limit = "none", lags: npt.ArrayLike | None = None) -> HurstFit:
    """Return the self-affine law whose band-limited structure function fits a surface best.

    ``S(r) = 2 int C2D (1 - cos q.r) d2q`` over all waves that the grid can hold, at lags along both axes.
    The points of a structure function are far from independent: they are fitted by generalised least squares
    with the covariance of a Gaussian surface of the fitted law, from which the standard error of H follows; a misfit
    beyond chance (one case in a thousand) raises it by the root of the misfit. On free axes pairs close to an end
    count less, see `tapered_structure`. Without a limit, trends of the second and fourth order in the lag, as caused
    by waves longer than the surface, are free parameters; the power of the Nyquist waves is always free. Missing
    points are ignored; with many of them the standard error is too small.

    Parameters
    ----------
    surface : Surface
        On a grid of two axes, isotropic, with Nyquist waves that the instrument resolves; otherwise start at longer
        lags.
    limit : {"none", "rolloff", "long_cutoff"}
        How the law ends toward long waves.
    lags : array of int, optional
        Lags in whole cells, up to half of a free side; by default from 1 to an eighth of the shorter side, or
        to a third with a limit, but at least to 8 and at most to 200.

    Returns
    -------
    HurstFit
        Of kind "C2D".

    Raises
    ------
    ValueError
        If the surface is a line, too small, or flat, an option is unknown, or a lag too long.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((64, 64), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-6, rng=np.random.default_rng(1))
    >>> fit = rc.fit_structure(surface)
    >>> f"H = {fit.hurst:.1f}"
    'H = 0.8'
    """
    grid = surface.grid
    if grid.ndim != 2 or min(grid.shape) < 32:
        raise InputError(f"this fit needs a surface of at least 32 x 32 points, not shape {grid.shape}")
    if limit not in ("none", "rolloff", "long_cutoff"):
        raise about("limit", f"must be 'none', 'rolloff' or 'long_cutoff', not {limit!r}")
    steps = _default(min(grid.shape), limit) if lags is None else np.asarray(lags)
    require(steps.size >= 5, f"a fit needs five lags at least, not {steps.size}")
    (along_x, share_x), (along_y, share_y) = (tapered_structure(surface, axis, steps) for axis in ("x", "y"))
    data = np.concatenate([along_x, along_y])
    require((data > 0).all(), "the structure function is zero at some lag: the surface is flat")
    dy, dx = grid.spacing
    distance = np.concatenate([steps * dx, steps * dy])
    is_y = np.arange(data.size) >= steps.size
    band = _quadrature(grid.spacing, max(grid.lengths), distance, is_y)
    # With a limit inside the surface there are no waves longer than the surface.
    trends = _trends(distance, is_y)[:, : 4 if limit == "none" else 0]
    # The area that two lags share: the weights of the two axes are independent of each other.
    area = np.full((data.size, data.size), float(surface.measured.mean()) * grid.area)
    area[~is_y[:, None] & ~is_y] *= share_x
    area[is_y[:, None] & is_y] *= share_y
    with one_blas_thread():
        parameters, error, misfit, freedom = _fit(band, data, trends, area, limit)
    reference = float(np.log(2 * np.pi / distance.max()))
    low = 2 * math.pi / math.exp(parameters[2]) if limit != "none" else None
    fit = HurstFit(
        hurst=float(parameters[1]),
        standard_error=error,
        density=math.exp(parameters[0] - 2 * (parameters[1] + 1) * reference),
        wavenumber=math.exp(reference),
        kind="C2D",
        rolloff=low if limit == "rolloff" else None,
        long_cutoff=low if limit == "long_cutoff" else None,
        short_cutoff=None,
        misfit=misfit,
        band=(2 * math.pi / float(distance.max()), 2 * math.pi / float(distance.min())),
        freedom=freedom,
    )
    return fit if misfit <= fit.chance else replace(fit, standard_error=error * math.sqrt(misfit))


def _default(size: int, limit: Limit) -> npt.NDArray[np.int64]:
    high = min(LONGEST, max(8, size // (8 if limit == "none" else 3)))
    return np.unique(np.geomspace(1, high, 22).round().astype(np.int64))


def _quadrature(
    spacing: tuple[float, ...], longest: float, distance: Array, is_y: npt.NDArray[np.bool_]
) -> _Band:
    """Return the waves of a grid of cells of that `spacing`, down to half a wave over the length."""
    dy, dx = spacing
    corner = math.atan2(dx, dy)  # the direction of the shortest wave of the grid
    nodes, weights = np.polynomial.legendre.leggauss(ANGLES)
    parts = [(0.0, corner), (corner, math.pi / 2)]
    angle = np.concatenate([low + (high - low) * (nodes + 1) / 2 for low, high in parts])
    turn = np.concatenate([(high - low) / 2 * weights for low, high in parts])
    top = np.log(np.minimum(math.pi / dx / np.cos(angle), math.pi / dy / np.sin(angle)))
    bottom = math.log(math.pi / longest)
    step = (top - bottom) / WAVES
    ln_q = (bottom + step[:, None] * (np.arange(WAVES) + 0.5)).ravel()
    # The plane has four such quarters.
    weight = 4 * np.repeat(turn * step, WAVES) * np.exp(2 * ln_q)
    direction = np.repeat(angle, WAVES)
    q = np.exp(ln_q)
    along = (q * np.cos(direction), q * np.sin(direction))
    jumps = np.empty((distance.size, q.size))
    for row, lag, y in zip(jumps, distance, is_y, strict=True):
        row[:] = 2 * np.sin(along[int(y)] * lag / 2) ** 2
    last = np.zeros((angle.size, WAVES))
    # Half a wave along the longer side, from the middle.
    last[:, -1] = 4 * turn * np.exp(2 * top) * max(spacing) / longest
    return _Band(ln_q, weight, jumps, float(step.mean()), last.ravel())


def _trends(distance: Array, is_y: npt.NDArray[np.bool_]) -> Array:
    """Return the contributions of waves longer than the surface to S, shape (lags, 4): r^2 and r^4 along each axis."""
    scaled = distance / distance.max()
    return np.stack([scaled**order * (is_y == axis) for order in (2, 4) for axis in (False, True)], axis=1)


def _start(structure: Callable[[Array], Array], band: _Band, data: Array, limit: Limit) -> Array:
    """Return the best of a coarse table of parameters."""
    bottom = float(band.ln_q.min())
    lows = (
        bottom + np.linspace(0.8, max(float(band.ln_q.max()) - bottom - 1.5, 1), 12)
        if limit != "none"
        else [bottom]
    )
    best, least = np.zeros(3), math.inf
    for low in lows:
        for hurst in (0.1, 0.4, 0.7, 1.0):
            trial = np.array([0.0, hurst, float(low)])
            ratio = np.log(data / structure(trial))
            if float(np.var(ratio)) < least:
                least, trial[0] = float(np.var(ratio)), float(ratio.mean())
                best = trial
    return best


def _fit(
    band: _Band, data: Array, trends: Array, area: Array, limit: Limit
) -> tuple[Array, float, float, int]:
    """Return ln C2D(q = 1), H and the logarithm of the limit; the error of H; the misfit, and its freedom."""
    free = 3 if limit != "none" else 2

    def structure(p: Array) -> Array:
        return np.asarray(2 * (band.jumps @ (band.weight * band.law(p[0], p[1], p[2], limit))))

    parameters = _start(structure, band, data, limit)
    # The limit stays within the waves of the grid, the law within the range of the generator.
    low = np.array([-np.inf, -0.9, float(band.ln_q.min())])
    high = np.array([np.inf, 3.0, float(band.ln_q.max()) - 1])
    for _ in range(5):  # the covariance depends on the fit
        scale = structure(parameters)
        slack, covariance = _covariance(band, parameters, scale, trends, area, limit)
        root = np.asarray(np.linalg.cholesky(covariance))
        whitened = partial(_whitened, structure, root, data / scale, scale, parameters[free:])
        found = least_squares(
            whitened,
            parameters[:free],
            bounds=(low[:free], high[:free]),
            x_scale=[1.0, 0.1, 0.3][:free],
            xtol=1e-10,
        )
        moved = float(np.abs(found.x - parameters[:free]).max())
        parameters = np.concatenate([found.x, parameters[free:]])
        if moved < 1e-6:
            break
    jacobian = np.asarray(found.jac)
    error = math.sqrt(float(np.linalg.pinv(jacobian.T @ jacobian)[1, 1]))
    freedom = max(data.size - free - slack, 1)
    return parameters, error, 2 * float(found.cost) / freedom, freedom


def _whitened(
    structure: Callable[[Array], Array], root: Array, data: Array, scale: Array, fixed: Array, free: Array
) -> Array:
    """Return the residuals over `scale`, made independent by the Cholesky `root` of their covariance."""
    return np.asarray(np.linalg.solve(root, data - structure(np.concatenate([free, fixed])) / scale))


def _covariance(
    band: _Band, parameters: Array, scale: Array, trends: Array, area: Array, limit: Limit
) -> tuple[int, Array]:
    """Return the number of free trends, and the covariance of S over `scale`."""
    density = band.law(parameters[0], parameters[1], parameters[2], limit)
    covariance = (band.jumps * (density**2 * band.weight)) @ band.jumps.T
    covariance *= 8 * (2 * math.pi) ** 2 / area / np.outer(scale, scale)
    # Free trends are trends of a very large variance.
    slack = np.column_stack([trends, band.jumps @ (band.edge * density)]) / scale[:, None]
    slack /= np.linalg.norm(slack, axis=0)
    covariance += 1e2 * slack @ slack.T + ROUNDING**2 * np.eye(scale.size)
    return slack.shape[1], np.asarray(covariance)
