"""A case: the summits of one rough surface as spheres, with and without interaction."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from roughcontact.grid import Grid
from roughcontact.labels.labelled import described
from roughcontact.study.case import Case, Record
from roughcontact.study.cases.shared_parameters import ForceRange
from roughcontact.surface.analysis.summits import find_summits
from roughcontact.surface.generation.fourier import self_affine
from roughcontact.theory.asperity_models.asperities import Asperities, press

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["CASE", "AsperityParameters", "run", "summits_of"]


class AsperityParameters(ForceRange):
    """A self-affine surface and the forces on its summits, all dimensionless.

    Parameters
    ----------
    hurst : float
        Hurst exponent H, from -1 to 3.
    points : int
        Points along a side; the surface is made by the inverse Fourier transform.
    lowest_force, highest_force, loads
        See `ForceRange`.
    """

    hurst: float = Field(ge=-1, le=3)
    points: int = Field(ge=8)
    lowest_force: float = Field(default=1e-4, gt=0)
    highest_force: float = Field(default=0.1, gt=0)
    loads: int = Field(default=25, ge=2)


def run(parameters: AsperityParameters, rng: np.random.Generator) -> Record:
    """Return the stiffness of the discrete asperity model at every force (thesis, figs 31 to 33).

    Returns
    -------
    xarray.Dataset
        Along ``load``: ``dimensionless_force``, F/(E* h L); ``dimensionless_stiffness``, k/(E* L), with interaction;
        ``independent_stiffness``, the same without interaction; ``spots``, the number of summits in contact, and
        ``merged``, the number of spots that overlap another, both with interaction.
    """
    import xarray

    grid = Grid((parameters.points,) * 2, 1 / parameters.points, periodic=True)
    asperities = summits_of(self_affine(grid, parameters.hurst, 1.0, rng))
    forces = parameters.forces
    together = [press(asperities, force=float(force)) for force in forces]
    alone = [press(asperities, force=float(force), interaction=False) for force in forces]

    return xarray.Dataset(
        {
            "dimensionless_force": described("load", forces, "force / (E* L h)"),
            "dimensionless_stiffness": described(
                "load", [each.stiffness for each in together], "stiffness / (E* L)"
            ),
            "independent_stiffness": described(
                "load", [each.stiffness for each in alone], "the same without interaction"
            ),
            "spots": described("load", [each.count for each in together], "summits in contact"),
            "merged": described("load", [each.merged for each in together], "spots that overlap another one"),
        }
    )


def summits_of(surface: Surface) -> Asperities:
    """Return the summits of a surface as spheres on a half-space of unit modulus."""
    found = find_summits(surface)
    dy, dx = surface.grid.spacing
    x, y = (np.asarray(places, dtype=np.float64) for places in (found.columns, found.rows))
    return Asperities(x * dx, y * dy, found.height, found.radius, 1.0)


CASE = Case("asperities", 2, AsperityParameters, run)
