"""A case: the loading curve of a rough surface that yields at a largest pressure."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Self

import numpy as np
from pydantic import Field, model_validator

from roughcontact.contact.curve import collect
from roughcontact.contact.loading import loading_path
from roughcontact.contact.stiffness import contact_stiffness
from roughcontact.labels.labelled import described, variable
from roughcontact.study.case import Case, Record
from roughcontact.study.cases.shared_parameters import PressedSquare, require_rising
from roughcontact.surface.moments import surface_moments

if TYPE_CHECKING:
    from roughcontact.contact.solution import Solution

__all__ = ["CASE", "YieldingParameters", "run"]

_LIMIT = 1e-4  # of the unit displacement; the error of the stiffness is about its square


class YieldingParameters(PressedSquare):
    """A rough surface pressed to increasing depths, at which the force is computed.

    Depths are prescribed rather than forces: if nearly every cell yields, the force almost does not depend on the rest.

    Parameters
    ----------
    points, size, hurst, rms, rms_band, rolloff, long_cutoff, short_cutoff, amplitudes, periodic, radius
        See `RoughSquare`.
    modulus, hardness, relative_hardness
        See `PressedSquare`.
    lowest_depth, highest_depth : float
        Depths over the rms height.
    loads : int
        Number of depths, in equal ratios.
    tolerance : float
        Tolerance of the certificate of every depth.
    """

    lowest_depth: float = Field(default=0.3, gt=0)
    highest_depth: float = Field(default=3.0, gt=0)
    loads: int = Field(default=15, ge=2)
    tolerance: float = Field(default=1e-6, gt=0, le=1e-2)

    @model_validator(mode="after")
    def _rising(self) -> Self:
        require_rising(self, "depth")
        return self


def run(parameters: YieldingParameters, rng: np.random.Generator) -> Record:
    """Return the loads of one sample at increasing depths.

    Returns
    -------
    xarray.Dataset
        Along ``load`` the force, ``stiffness`` and ``contact_area`` of a `roughcontact.Curve`;
        ``dimensionless_force`` F/(E* h L) and ``dimensionless_stiffness`` k/(E* L), where h is the rms height of the
        parameters. ``stiffness`` is that of further loading: yielded cells do not contribute. ``region_stiffness`` is
        that of all cells in contact: it holds for the first step of unloading and for conduction. ``yielded`` is the
        share of the contact area at the largest pressure. Without a dimension: ``cell_stiffness``, ``rms_slope`` and,
        if given, ``hardness``.
    """
    roughness = parameters.roughness(rng)
    slope = surface_moments(roughness, derivative="spectral").rms_slope
    hardness = parameters.hardness_on(slope)
    depths = np.geomspace(parameters.lowest_depth, parameters.highest_depth, parameters.loads)
    solutions = list(
        loading_path(
            parameters.on_body(roughness),
            parameters.modulus,
            depths=depths * parameters.rms,
            tolerance=parameters.tolerance,
            hardness=hardness,
        )
    )
    whole = collect(solutions).to_dataset()
    names = ("force", "depth", "stiffness", "contact_area", "dimensionless_stiffness")
    certificates = ("residual", "stiffness_residual", "status", "cell_stiffness")
    record = whole[[*names, *certificates]].drop_vars("axis", errors="ignore")
    record.attrs.pop("state_notes", None)  # of one member
    scale = parameters.modulus * parameters.size * parameters.rms
    record["dimensionless_force"] = "load", whole["force"].values / scale, whole["dimensionless_force"].attrs
    regions = [
        contact_stiffness(each.contact, parameters.grid, parameters.modulus, tolerance=_LIMIT)
        for each in solutions
    ]
    words = "normal stiffness of all cells in contact, including yielded ones"
    record["region_stiffness"] = described("load", regions, words, "N m-1")
    words = "share of the contact area at the largest pressure"
    record["yielded"] = described("load", [_yielded(each) for each in solutions], words)
    record["rms_slope"] = described((), slope, "root mean square slope of the roughness")
    if hardness is not None:
        record["hardness"] = variable("hardness", (), hardness)
    return record.assign_attrs(title="loading curves of rough surfaces that yield at a largest pressure")


def _yielded(solution: Solution) -> float:
    cells = int(solution.contact.sum())
    ceiling = solution.problem.hardness
    return 0.0 if math.isinf(ceiling) or not cells else float((solution.pressure >= ceiling).sum() / cells)


CASE = Case("yielding", 2, YieldingParameters, run)
