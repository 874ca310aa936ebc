"""A case: one adhesive rough surface, pressed to a depth and retracted until it detaches."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from pydantic import Field

from roughcontact.adhesion.adhesive_loop import adhesive_loop
from roughcontact.adhesion.attraction import Adhesion, Law
from roughcontact.labels.labelled import described, variable
from roughcontact.labels.variables import VARIABLES
from roughcontact.study.case import Case, EnergyPerArea, Length, Positive, Record
from roughcontact.study.cases.shared_parameters import RoughSquare

if TYPE_CHECKING:
    from roughcontact.adhesion.adhesive_curve import AdhesiveCurve
    from roughcontact.validation import Array

__all__ = ["CASE", "AdhesionParameters", "run"]

_ON_BOTH = ("force", "contact_area", "mean_gap", "energy")
_SCALARS = {"pull_off_force": "pull_off_force", "jump_in_force": "jump_in_force", "lost_energy": "lost"}


class AdhesionParameters(RoughSquare):
    """An adhesive rough surface: an approach to a depth, and the retreat.

    Parameters
    ----------
    points, size, hurst, rms, rms_band, rolloff, long_cutoff, short_cutoff, amplitudes, periodic, radius, modulus
        See `RoughSquare`.
    work : float
        Work of adhesion w [J/m^2].
    range : float
        Length over which the attraction decreases [m].
    law : {"exponential", "dugdale"}
        Law of the decrease.
    allow_unresolved : bool
        Whether to compute if the grid does not resolve the attraction; such a case is refused otherwise.
    turn : float
        Depth at which the loop turns, over the rms height.
    loads : int
        Number of depths of the approach, in even steps from a distance of ten ranges of the attraction.
    """

    work: Positive[EnergyPerArea]
    range: Positive[Length]
    law: Law = "exponential"
    allow_unresolved: bool = False
    turn: float = Field(default=1.0, gt=0)
    loads: int = Field(default=20, ge=2)


def run(parameters: AdhesionParameters, rng: np.random.Generator) -> Record:
    """Return the loop of one sample.

    Returns
    -------
    xarray.Dataset
        Along ``load`` the depths of the approach and where it turns, with force, contact area, mean gap and energy of
        the approach; ``retreat_force`` and so on are those of the retreat at the same depths, NaN where the bodies
        have detached. Without a dimension ``pull_off_force``, ``jump_in_force`` (NaN without a jump),
        ``lost_energy``, the number of ``jumps``, ``ambiguous`` and ``unresolved``, ``status``, ``residual``, the
        largest of all states, and ``rms`` of the roughness.
    """
    import xarray

    roughness = parameters.roughness(rng)
    loop = adhesive_loop(
        parameters.on_body(roughness),
        parameters.modulus,
        Adhesion(parameters.work, parameters.range, parameters.law, parameters.allow_unresolved),
        depth=parameters.turn * parameters.rms,
        points=parameters.loads,
        tolerance=parameters.tolerance,
    )
    there = slice(0, parameters.loads + 1)
    data = {name: variable(name, ("load",), getattr(loop, name)[there]) for name in ("depth", *_ON_BOTH)}
    for name in _ON_BOTH:
        dimensions, values, words = variable(name, ("load",), _retreat(loop, getattr(loop, name), parameters))
        about = words | {"long_name": f"{VARIABLES[name].long_name}, on the retreat"}
        data[f"retreat_{name}"] = dimensions, values, about
    data |= {name: variable(name, (), getattr(loop, attribute)) for name, attribute in _SCALARS.items()}
    missed = next((status for status in loop.status if not status.converged), loop.status[-1])
    data |= {
        "jumps": described((), len(loop.jumps), "number of jumps"),
        "ambiguous": described((), loop.ambiguous, "whether two integrations after a jump ended apart", ""),
        "unresolved": variable("unresolved", (), loop.unresolved),
        "status": variable("status", (), missed.value),
        "residual": variable("residual", (), float(loop.residual.max())),
        "rms": variable("rms", (), roughness.rms),
    }
    return xarray.Dataset(data, attrs={"title": "loops of adhesive rough surfaces"})


def _retreat(loop: AdhesiveCurve, values: Array, parameters: AdhesionParameters) -> Array:
    """Return the values of the retreat at the depths of the approach; NaN where it has ended."""
    back = values[parameters.loads : 2 * parameters.loads + 1]
    return np.pad(back, (0, parameters.loads + 1 - back.size), constant_values=np.nan)[::-1].copy()


CASE = Case("adhesion", 2, AdhesionParameters, run)
