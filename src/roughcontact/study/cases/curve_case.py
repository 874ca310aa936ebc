"""A case: the loading curve of one rough surface by boundary elements."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from roughcontact.contact.curve import CURVE_POINTS, collect
from roughcontact.contact.loading import loading_path
from roughcontact.contact.measures import StateMeasure
from roughcontact.contact.solution import Solution
from roughcontact.contact.stiffness import contact_stiffness
from roughcontact.grid import Grid
from roughcontact.labels.labelled import described
from roughcontact.study.case import Case, Record
from roughcontact.study.cases.shared_parameters import ForceRange, PressedSquare
from roughcontact.surface.moments import Moments, surface_moments

if TYPE_CHECKING:
    from roughcontact.surface.surface import Surface

__all__ = ["CASE", "CurveParameters", "curve_of", "moments_of", "run"]

_ARRAYS = (
    *(*CURVE_POINTS, "spots", "dimensionless_stiffness"),
    *("residual", "stiffness_residual", "resolved", "status"),
)
_SCALES = ("cell_stiffness", "full_contact_stiffness")
_LIMIT = 1e-3  # of the displacement: enough for a full-contact stiffness, which only bounds the resolved range at 0.9


class CurveParameters(PressedSquare, ForceRange):
    """A rough surface pressed on an elastic half-space by increasing forces.

    Parameters
    ----------
    points, size, hurst, rms, rms_band, rolloff, long_cutoff, short_cutoff, amplitudes, periodic, radius
        See `RoughSquare`.
    modulus, hardness, relative_hardness
        See `PressedSquare`.
    lowest_force, highest_force, loads
        See `ForceRange`; by default from the first cells in contact to the end of the power law.
    """

    lowest_force: float = Field(default=1e-4, gt=0)
    highest_force: float = Field(default=0.07, gt=0)
    loads: int = Field(default=30, ge=2)


def run(parameters: CurveParameters, rng: np.random.Generator) -> Record:
    """Return the loading curve of one sample.

    Returns
    -------
    xarray.Dataset
        Along ``load`` the points of a `roughcontact.Curve`, with ``dimensionless_force``, F/(E* h L), where h is the
        rms height of the parameters. ``status`` marks loads that missed their tolerance. Without a dimension:
        ``cell_stiffness`` and ``full_contact_stiffness``, between which a curve is resolved; ``rms``, ``rms_slope``
        and ``rms_curvature`` of the roughness, without the body under it; ``hardness`` if one is given.
    """
    roughness = parameters.roughness(rng)
    return curve_of(roughness, moments_of(roughness), parameters)


def moments_of(roughness: Surface) -> Moments:
    """Return the exact moments of a surface that is made of waves."""
    return surface_moments(roughness, derivative="spectral")


def curve_of(
    roughness: Surface, moments: Moments, parameters: CurveParameters, measures: Sequence[StateMeasure] = ()
) -> Record:
    """Return the record of a roughness on the body of the parameters, with the columns of the measures; see `run`."""
    forces = parameters.forces
    path = loading_path(
        parameters.on_body(roughness),
        parameters.modulus,
        forces=forces * (parameters.modulus * parameters.size * parameters.rms),
        tolerance=parameters.tolerance,
        hardness=parameters.hardness_on(moments.rms_slope),
    )
    curve = collect(_with_limit(path, parameters), measures)
    whole = curve.to_dataset()
    names = [*_ARRAYS, *_SCALES, *curve.measured, *(("hardness",) if math.isfinite(curve.hardness) else ())]
    record = whole[names].drop_vars("axis", errors="ignore")
    for name in ("state_notes", "measured"):  # of one member; a list
        record.attrs.pop(name, None)
    record["dimensionless_force"] = "load", forces, whole["dimensionless_force"].attrs
    record["rms"] = described((), roughness.rms, "root mean square height of the roughness", "m")
    record["rms_slope"] = described((), moments.rms_slope, "root mean square slope of the roughness")
    words = "root mean square curvature of the roughness, half the Laplacian"
    record["rms_curvature"] = described((), moments.rms_curvature, words, "m-1")
    return record.assign_attrs(title="loading curves of rough surfaces by boundary elements")


def _with_limit(path: Iterator[Solution], parameters: CurveParameters) -> Iterator[Solution]:
    """Yield a path with a known full-contact stiffness; computing it can take half of the time."""
    unit = parameters.modulus * parameters.size
    for solution in path:
        solution.problem.once(
            "full_contact_stiffness",
            lambda: unit * _full_contact_stiffness(parameters.points, parameters.periodic),
        )
        yield solution


@lru_cache(maxsize=16)
def _full_contact_stiffness(points: int, periodic: bool) -> float:
    """Return k/(E* L) of a square in full contact; it only depends on the number of cells."""
    grid = Grid((points, points), 1 / points, periodic)
    return contact_stiffness(np.ones(grid.shape, dtype=bool), grid, 1.0, tolerance=_LIMIT)


CASE = Case("curve", 2, CurveParameters, run)
