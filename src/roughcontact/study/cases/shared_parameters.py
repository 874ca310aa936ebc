"""Parameters shared by several cases: forces in equal ratios, and rough squares on a flat or a rounded body."""

from __future__ import annotations

from typing import Any, Literal, Self

import numpy as np
import numpy.typing as npt
from pydantic import Field, model_validator

from roughcontact.errors import InputError, about
from roughcontact.grid import Grid
from roughcontact.study.case import Length, Modulus, Parameters, Positive, Pressure
from roughcontact.surface.generation.fourier import self_affine
from roughcontact.surface.generation.shapes import paraboloid
from roughcontact.surface.surface import Surface
from roughcontact.validation import require

__all__ = ["ForceRange", "PressedSquare", "RoughSquare", "require_rising"]


_LIMITS = ("rolloff", "long_cutoff", "short_cutoff")


def require_rising(parameters: Any, what: str) -> None:
    """Raise an error unless the lowest load is below the highest."""
    low, high = (getattr(parameters, f"{end}_{what}") for end in ("lowest", "highest"))
    require(low < high, f"lowest_{what} must be below highest_{what}, not {low:g} and {high:g}")


class ForceRange(Parameters):
    """Parameters of a case that is pressed by forces ``F/(E* h L)``, h the rms height and L the side.

    Parameters
    ----------
    lowest_force, highest_force : float
        The first and the last force.
    loads : int
        Number of forces.
    """

    lowest_force: float = Field(gt=0)
    highest_force: float = Field(gt=0)
    loads: int = Field(ge=2)

    @model_validator(mode="after")
    def _rising(self) -> Self:
        require_rising(self, "force")
        return self

    @property
    def forces(self) -> npt.NDArray[np.float64]:
        """The forces, shape (loads,)."""
        return np.geomspace(self.lowest_force, self.highest_force, self.loads)


class RoughSquare(Parameters):
    """Parameters of a case on a square with self-affine roughness.

    The generator of the sample draws the phases of the waves: surfaces of one sample have the same phases for all
    other parameters. A larger number of points only adds finer waves.

    Parameters
    ----------
    points : int
        Cells along a side.
    size : float
        Side of the square L [m].
    hurst : float
        Hurst exponent H, from -1 to 3.
    rms : float
        Root mean square height h of the roughness [m].
    rms_band : tuple of float, optional
        The longest and the shortest of the waves whose rms height is `rms`, over the side. By default all waves of
        the grid. With a band, a larger number of points adds finer waves to the same surface.
    rolloff, long_cutoff, short_cutoff : float, optional
        Limits of the power law, as wavelengths over the side: waves longer than the roll-off have its amplitude, and
        those beyond the long or the short cut-off are absent. By default all waves of the grid.
    amplitudes : {"exact", "gaussian"}
        Whether the spectrum is exact in every sample, or only in the mean over a Gaussian process.
    periodic : bool
        Whether the surface repeats itself.
    radius : float, optional
        Radius of curvature of a paraboloid under the roughness, its apex in the middle [m].
    modulus : float
        Reduced modulus E* [Pa].
    tolerance : float
        Tolerance of the certificate of every state.
    """

    points: int = Field(ge=4)
    size: Positive[Length]
    modulus: Positive[Modulus]
    hurst: float = Field(ge=-1, le=3)
    rms: Positive[Length]
    rms_band: tuple[Positive[float], Positive[float]] | None = None
    rolloff: float | None = Field(default=None, gt=0)
    long_cutoff: float | None = Field(default=None, gt=0)
    short_cutoff: float | None = Field(default=None, gt=0)
    amplitudes: Literal["exact", "gaussian"] = "exact"
    periodic: bool = False
    radius: Positive[Length] | None = None
    tolerance: float = Field(default=1e-8, gt=1e-14, lt=1e-2)

    @model_validator(mode="after")
    def _band_on_grid(self) -> Self:
        if self.rms_band is not None:
            longest, shortest = self.rms_band
            if not longest >= shortest > 2 / self.points:
                raise about(
                    "rms_band",
                    f"must go from its longest wave down to one above two cells, {2 / self.points:g} on "
                    f"{self.points} points, not from {longest:g} to {shortest:g}",
                )
        return self

    @property
    def grid(self) -> Grid:
        """The grid of the square."""
        return Grid((self.points, self.points), self.size / self.points, self.periodic)

    def roughness(self, rng: np.random.Generator) -> Surface:
        """Return only the roughness, as on a flat body."""
        return self.roughness_on(self.grid, rng)

    def roughness_on(self, grid: Grid, rng: np.random.Generator) -> Surface:
        """Return the roughness on a grid with other sides; its limits keep their lengths."""
        limits = {name: (part := getattr(self, name)) and part * self.size for name in _LIMITS}
        band = self.rms_band and (self.rms_band[0] * self.size, self.rms_band[1] * self.size)
        spectrum = {"amplitudes": self.amplitudes, "rms_band": band, **limits}
        return self_affine(grid, self.hurst, self.rms, rng, **spectrum)

    def on_body(self, roughness: Surface) -> Surface:
        """Return a roughness on its body."""
        return roughness if self.radius is None else paraboloid(self.grid, self.radius) + roughness


class PressedSquare(RoughSquare):
    """Parameters of a case that presses such a square, elastic or with a hardness.

    Parameters
    ----------
    hardness : float, optional
        Largest pressure of a cell [Pa].
    relative_hardness : float, optional
        The same over E* times the rms slope of the roughness. At most one of the two may be given; without them the
        contact is elastic.
    """

    hardness: Positive[Pressure] | None = None
    relative_hardness: float | None = Field(default=None, gt=0)

    @model_validator(mode="after")
    def _one_hardness(self) -> Self:
        if self.hardness is not None and self.relative_hardness is not None:
            raise InputError("two hardnesses are given", "give hardness or relative_hardness, not both")
        return self

    def hardness_on(self, rms_slope: float) -> float | None:
        """Return the hardness of a roughness of this rms slope [Pa]; None for an elastic body."""
        if self.relative_hardness is None:
            return self.hardness
        return self.relative_hardness * self.modulus * rms_slope
