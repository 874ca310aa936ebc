"""A case: the stiffness per area of a periodic piece of a joint against nominal pressure, in numbers without units."""

from __future__ import annotations

from typing import Self

import numpy as np
import numpy.typing as npt
from pydantic import Field, model_validator

from roughcontact.contact.loading import loading_curve
from roughcontact.errors import about
from roughcontact.grid import Grid
from roughcontact.labels.labelled import described
from roughcontact.study.case import Case, Parameters, Record
from roughcontact.study.cases.shared_parameters import require_rising
from roughcontact.surface.generation.fourier import self_affine
from roughcontact.surface.surface import Surface

__all__ = ["CASE", "JointParameters", "run"]

CELLS = 6  # at least, of the shortest wave
HEIGHT = 1e-3  # rms height over roll-off wavelength; the equations are linear in it
FLOWING = 0.5  # of the hardness: at larger pressures half of the joint or more flows


class JointParameters(Parameters):
    """A periodic square of a Gaussian surface, pressed by increasing nominal pressures.

    Lengths count in roll-off wavelengths l, heights in rms heights h, pressures in E* h/l and stiffnesses per area in
    E*/l: the elastic contact depends on nothing else.

    Parameters
    ----------
    hurst : float
        Hurst exponent H.
    side : float
        Side of the square, L/l. Waves longer than l have its amplitude.
    band : float
        l/l_c, the roll-off wavelength over the shortest wave.
    points : int
        Cells along a side; the shortest wave takes at least six.
    lowest_pressure, highest_pressure : float
        The first and the last pressure, p l/(E* h).
    loads : int
        Number of pressures, in equal ratios.
    hardness : float, optional
        Hardness over E* h/l. Pressures above half of it are left out.
    draw : int
        Surfaces of one sample and different draws are independent.
    """

    hurst: float = Field(gt=0, le=1.5)
    side: float = Field(ge=1)
    band: float = Field(ge=1)
    points: int = Field(default=512, ge=8)
    lowest_pressure: float = Field(default=2e-3, gt=0)
    highest_pressure: float = Field(default=2.0, gt=0)
    loads: int = Field(default=16, ge=2)
    hardness: float | None = Field(default=None, gt=0)
    draw: int = Field(default=0, ge=0, le=10_000)

    @model_validator(mode="after")
    def _resolved(self) -> Self:
        require_rising(self, "pressure")
        if self.points < CELLS * self.side * self.band:
            least = int(np.ceil(CELLS * self.side * self.band))
            raise about("points", f"must be at least {least}, six cells a shortest wave, not {self.points}")
        return self

    @property
    def pressures(self) -> npt.NDArray[np.float64]:
        """The pressures p l/(E* h), shape (loads,)."""
        return np.geomspace(self.lowest_pressure, self.highest_pressure, self.loads)

    def surface(self, rng: np.random.Generator) -> Surface:
        """Return a surface; its rms height is that of the Gaussian process."""
        grid = Grid((self.points, self.points), self.side / self.points, periodic=True)
        own = rng.spawn(self.draw + 1)[-1]
        cutoff = 1 / self.band
        return self_affine(
            grid, self.hurst, HEIGHT, own, rolloff=1, short_cutoff=cutoff, amplitudes="gaussian"
        )


def run(parameters: JointParameters, rng: np.random.Generator) -> Record:
    """Return stiffness and area of one sample.

    Returns
    -------
    xarray.Dataset
        Along ``load``: ``pressure`` p l/(E* h), ``stiffness_per_area`` K l/(E* A0) and ``fraction`` A/A0, both NaN for
        pressures that are left out; ``converged``.
    """
    pressures, hardness = parameters.pressures, parameters.hardness
    applied = pressures <= FLOWING * (hardness or np.inf)
    curve = loading_curve(
        parameters.surface(rng),
        1.0,
        pressures=pressures[applied] * HEIGHT,
        hardness=hardness and hardness * HEIGHT,
    )
    found = {name: np.full(pressures.size, np.nan) for name in ("stiffness_per_area", "fraction")}
    found["stiffness_per_area"][applied] = curve.interfacial_stiffness_per_area
    found["fraction"][applied] = curve.contact_fraction
    import xarray

    along = ("load",)
    record = {
        "pressure": described(along, pressures, "nominal pressure p l/(E* h)"),
        "stiffness_per_area": described(along, found["stiffness_per_area"], "K l/(E* A0)"),
        "fraction": described(along, found["fraction"], "relative contact area A/A0"),
        "converged": described(
            (), all(each.converged for each in curve.status), "whether every load met its tolerance"
        ),
    }
    return xarray.Dataset(record, attrs={"title": "stiffness per area of periodic joints"})


CASE = Case("joint", 1, JointParameters, run)
