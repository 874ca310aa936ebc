"""A case: rough lines of one Hurst exponent on independent springs, many at once (the reduced model)."""

from __future__ import annotations

import numpy as np
from pydantic import Field

from roughcontact.grid import Grid
from roughcontact.labels.labelled import described
from roughcontact.mdr.lines.random_lines import rough_lines
from roughcontact.mdr.lines.rough_line import loading_curves
from roughcontact.study.case import Case, Record
from roughcontact.study.cases.shared_parameters import ForceRange
from roughcontact.surface.generation.spectrum import SelfAffineSpectrum

__all__ = ["CASE", "LineParameters", "run"]


class LineParameters(ForceRange):
    """Lines and the forces on them, all dimensionless; therefore there is no length and no modulus.

    Parameters
    ----------
    hurst : float
        Hurst exponent H of the lines, C1D ~ q^(-(2H+1)), from -1 to 3.
    points : int
        Number N of points of a line, and of springs under it.
    lines : int
        Number of lines per sample: a single line would take less time than its row in the store.
    lowest_force, highest_force, loads
        See `ForceRange`; by default twelve per decade including 0.07, from one spring in contact to all.
    """

    hurst: float = Field(ge=-1, le=3)
    points: int = Field(ge=4)
    lines: int = Field(default=50, ge=1)
    lowest_force: float = Field(default=7e-8, gt=0)
    highest_force: float = Field(default=7.0, gt=0)
    loads: int = Field(default=97, ge=2)


def run(parameters: LineParameters, rng: np.random.Generator) -> Record:
    """Return the stiffness of every line at every force (thesis, section 4.5.2).

    The answer is exact: there is no residual. Lines have random phases and exactly the power spectrum of the law,
    therefore also the same rms height.

    Returns
    -------
    xarray.Dataset
        ``dimensionless_force`` (load), F/(E* h L), and ``dimensionless_stiffness`` (line, load), k/(E* L): the share
        of springs that carry load.
    """
    import xarray

    grid = Grid(parameters.points, 1 / parameters.points, periodic=True)
    spectrum = SelfAffineSpectrum(parameters.hurst, dimension=1)
    forces = parameters.forces
    springs = np.concatenate(
        [
            loading_curves(heights, grid.spacing[0], 1.0, forces=forces, energy=False).springs
            for heights in rough_lines(grid, spectrum, rng, parameters.lines, rms=1.0)
        ]
    )
    stiffness = described(("line", "load"), springs / parameters.points, "stiffness / (E* L)")
    return xarray.Dataset(
        {
            "dimensionless_force": described("load", forces, "force / (E* L h)"),
            "dimensionless_stiffness": stiffness,
        }
    )


CASE = Case("lines", 2, LineParameters, run)
