"""Displacement and stress below the surface, under any pressure on a free or periodic half-space."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
import scipy.fft

from roughcontact.cached import cached_property
from roughcontact.errors import InputError, about
from roughcontact.grid import AnyGrid, Grid
from roughcontact.halfspace.subsurface.love_field import (
    DISPLACEMENT_PARITY,
    STRESS_PARITY,
    displacement_table,
    stress_table,
)
from roughcontact.halfspace.subsurface.row_field import row_stress_table
from roughcontact.halfspace.subsurface.wave_field import displacement_waves, stress_waves
from roughcontact.halfspace.sums.fourier_sum import Parity, padded_lengths, transfer_function
from roughcontact.material import Solid
from roughcontact.transforms import SLAB
from roughcontact.validation import Array

__all__ = ["Displacement", "Stress", "displacement", "stress"]


@dataclass(frozen=True, eq=False)
class Stress:
    """Stresses below the cells of a grid [Pa], positive in tension.

    Attributes
    ----------
    grid : Grid
    depth : float or array, shape (nz,)
        Depth below the surface [m].
    xx, yy, zz : arrays, shape ``(ny, nx)``, or ``(nz, ny, nx)`` for several depths
        Normal stresses; z points into the body.
    xy, xz, yz : arrays of that shape
        Shear stresses.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> stress = rc.below(solution, 5e-6, 0.3)
    >>> [f"{field.max() / 1e6:.1f} MPa" for field in (stress.von_mises, stress.largest_shear, -stress.zz)]
    ['10.7 MPa', '5.3 MPa', '10.9 MPa']
    """

    grid: Grid
    depth: float | Array
    xx: Array
    yy: Array
    zz: Array
    xy: Array
    xz: Array
    yz: Array

    @cached_property
    def von_mises(self) -> Array:
        """Equivalent stress of von Mises [Pa]: at its yield stress, a metal begins to flow."""
        direct = (self.xx - self.yy) ** 2 + (self.yy - self.zz) ** 2 + (self.zz - self.xx) ** 2
        return np.asarray(np.sqrt(direct / 2 + 3 * (self.xy**2 + self.xz**2 + self.yz**2)))

    @cached_property
    def principal(self) -> Array:
        """Principal stresses [Pa], the largest first, in a last axis of three."""
        rows = ((self.xx, self.xy, self.xz), (self.xy, self.yy, self.yz), (self.xz, self.yz, self.zz))
        tensor = np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)
        return np.asarray(np.linalg.eigvalsh(tensor)[..., ::-1])

    @property
    def largest_shear(self) -> Array:
        """Largest shear stress on any plane [Pa], half of Tresca's equivalent stress."""
        return np.asarray((self.principal[..., 0] - self.principal[..., 2]) / 2)

    @property
    def mean(self) -> Array:
        """Mean of the normal stresses [Pa], the negative of the hydrostatic pressure."""
        return (self.xx + self.yy + self.zz) / 3


@dataclass(frozen=True, eq=False)
class Displacement:
    """Displacements below the cells of a grid [m].

    Attributes
    ----------
    grid : Grid
    depth : float or array, shape (nz,)
        Depth below the surface [m].
    x, y, z : arrays, shape ``(ny, nx)``, or ``(nz, ny, nx)`` for several depths
        Along the axes; z points into the body. On a free grid they vanish far away, on a periodic one their means
        vanish on the surface.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> moved = rc.displacement_below(solution, [0.0, 5e-6, 20e-6], rc.Solid(1e9, 0.3))
    >>> (moved.z.max(axis=(1, 2)) * 1e9).round().tolist()  # nm, of the surface and below it
    [159.0, 80.0, 24.0]
    """

    grid: Grid
    depth: float | Array
    x: Array
    y: Array
    z: Array


def stress(pressure: Array, grid: AnyGrid, depth: float | Array, poisson_ratio: float) -> Stress:
    """Return the stresses at a depth, or at several, below the middles of the cells.

    Parameters
    ----------
    pressure : array, shape ``grid.shape``
        On the surface [Pa]; without friction.
    grid : Grid
        Of two axes, free or periodic.
    depth : float or array, shape (nz,)
        Depth below the surface [m], 0 or more.
    poisson_ratio : float
        Of the body. Its modulus plays no part.

    Raises
    ------
    ValueError
        If the pressure does not fit the grid, the grid is no such, or depth or Poisson's ratio make no sense.

    Notes
    -----
    A convolution for each component and depth: on a free grid with the closed forms of uniformly loaded cells
    (`roughcontact.halfspace.subsurface.love_field`), on a periodic one wave by wave
    (`roughcontact.halfspace.subsurface.wave_field`), on one that is periodic along one axis with the images
    of each cell, to 1e-8 of the mean pressure. Less than a cell below the surface the stresses are those of
    the cells, not of the contact: they jump from cell to cell, and above their edges grow without bound. Two
    bodies in contact carry the same pressure, each with its own Poisson's ratio.
    """
    p, plane = _checked(pressure, grid)
    at, nu = _depths(depth), _ratio(poisson_ratio)
    transfers = partial(_stress_transfers, plane, poisson_ratio=nu)
    return Stress(plane, at, *_fields(p, plane, at, transfers, STRESS_PARITY))


def displacement(pressure: Array, grid: AnyGrid, depth: float | Array, solid: Solid) -> Displacement:
    """Return the displacements of a `solid` at a depth, or at several, below the middles of the cells.

    Parameters
    ----------
    pressure, grid, depth
        As of `stress`.
    solid : Solid
        The body.

    Raises
    ------
    ValueError
        As `stress`, or if the solid is rigid.
    """
    if not (isinstance(solid, Solid) and np.isfinite(solid.young_modulus)):
        raise InputError(
            f"displacements need an elastic Solid(young_modulus, poisson_ratio), not {solid!r}", place="solid"
        )
    p, plane = _checked(pressure, grid)
    if any(grid.periodic) != all(grid.periodic):
        raise InputError("below a row of loads displacements have no bound; stresses have")
    at = _depths(depth)
    transfers = partial(_displacement_transfers, plane, poisson_ratio=solid.poisson_ratio)
    return Displacement(
        plane, at, *_fields(p / solid.shear_modulus, plane, at, transfers, DISPLACEMENT_PARITY)
    )


def _fields(
    pressure: Array,
    grid: Grid,
    depth: float | Array,
    transfers: Callable[[float], Sequence[Array]],
    parities: Sequence[Parity],
) -> Array:
    """Return the components at every depth, shape ``(components, *depths, ny, nx)``."""
    depths = np.atleast_1d(depth)
    fields = np.empty((len(parities), len(depths), *grid.shape))
    for i, z in enumerate(depths.tolist()):
        found = _convolve_each(pressure, transfers(z), parities, padded_lengths(grid))
        for field, component in zip(fields, found, strict=True):
            field[i] = component
    return fields if np.ndim(depth) else fields[:, 0]


def _convolve_each(
    field: Array, transfers: Sequence[Array], parities: Sequence[Parity], padded: tuple[int, int]
) -> Iterator[Array]:
    """Yield the convolution of `field`, padded by zeros to `padded`, with each kernel, cut back to its own shape.

    Parameters
    ----------
    field : array, shape (ny, nx)
    transfers : arrays, shape (My//2 + 1, Mx//2 + 1)
        As `transfer_function` returns them.
    parities : pairs of bool
        Of each kernel.
    padded : tuple of int
        Lengths ``(My, Mx)`` of the transforms, at least those of the field.

    Notes
    -----
    As in `roughcontact.transforms.convolve`, only rows that hold data are transformed along x, and the padded columns
    exist for one slab at a time. The field is transformed once.
    """
    ny, nx = field.shape
    my, mx = padded
    rows = scipy.fft.rfft(field, n=mx, axis=1)
    spectra = np.empty((len(transfers), *rows.shape), rows.dtype)
    upper = my // 2 + 1
    for start in range(0, rows.shape[1], SLAB):
        part = slice(start, start + SLAB)
        column = scipy.fft.fft(rows[:, part], n=my, axis=0)
        for spectrum, transfer, (odd_y, odd_x) in zip(spectra, transfers, parities, strict=True):
            factor = transfer[:, part] * (-1j) ** (odd_y + odd_x)
            product = np.empty_like(column)
            np.multiply(column[:upper], factor, out=product[:upper])
            np.multiply(column[upper:], factor[my - upper : 0 : -1], out=product[upper:])
            if odd_y:
                product[upper:] *= -1
            spectrum[:, part] = scipy.fft.ifft(product, axis=0, overwrite_x=True)[:ny]
    for spectrum in spectra:
        yield np.asarray(scipy.fft.irfft(spectrum, n=mx, axis=1)[:, :nx])


def _stress_transfers(grid: Grid, depth: float, poisson_ratio: float) -> Sequence[Array]:
    if all(grid.periodic):
        return list(stress_waves(grid, depth, poisson_ratio))
    if not any(grid.periodic):
        kernels = stress_table(grid.shape, grid.spacing, depth, poisson_ratio)
    elif grid.periodic[0]:
        kernels = row_stress_table(grid.shape, grid.spacing, depth, poisson_ratio)
    else:  # x and y change places
        kernels = row_stress_table(grid.shape[::-1], grid.spacing[::-1], depth, poisson_ratio)
        kernels = kernels.transpose(0, 2, 1)[[1, 0, 2, 3, 5, 4]]
    return _transformed(grid, kernels, STRESS_PARITY)


def _displacement_transfers(grid: Grid, depth: float, poisson_ratio: float) -> Sequence[Array]:
    if all(grid.periodic):
        return list(displacement_waves(grid, depth, poisson_ratio))
    kernels = displacement_table(grid.shape, grid.spacing, depth, poisson_ratio)
    return _transformed(grid, kernels, DISPLACEMENT_PARITY)


def _transformed(grid: Grid, kernels: Array, parities: Sequence[Parity]) -> Sequence[Array]:
    return [
        transfer_function(kernel, parity, padded_lengths(grid), grid.periodic)
        for kernel, parity in zip(kernels, parities, strict=True)
    ]


def _checked(pressure: Array, grid: AnyGrid) -> tuple[Array, Grid]:
    if not isinstance(grid, Grid) or grid.ndim != 2:
        raise InputError(
            "fields below the surface need a grid of two axes; a line is a strip of it, "
            "Grid((ny, nx), spacing, periodic=True) with one pressure on each column"
        )
    p = np.asarray(pressure, dtype=np.float64)
    if p.shape != grid.shape:
        raise InputError(
            f"a pressure of shape {p.shape} does not fit the grid of shape {grid.shape}", place="pressure"
        )
    if not np.isfinite(p).all():
        raise about("the pressure", "must be finite [Pa]: zero where nothing touches")
    return p, grid


def _depths(depth: float | Array) -> float | Array:
    z = np.asarray(depth, dtype=np.float64)
    if z.ndim > 1 or not z.size:
        raise about("depth", f"must be a number or a list of numbers [m], not of shape {z.shape}")
    if not (np.isfinite(z).all() and (z >= 0).all()):
        raise about(
            "the depth", f"counts from the surface into the body: at least 0 and finite [m], not {depth}"
        )
    return z if z.ndim else float(z)


def _ratio(poisson_ratio: float) -> float:
    if not -1 < poisson_ratio <= 0.5:
        raise about("poisson_ratio", f"must lie above -1 and at most at 0.5, not {poisson_ratio}")
    return float(poisson_ratio)
