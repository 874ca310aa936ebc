"""A case: one rough surface that flows plastically when it is loaded, unloaded and reloaded."""

from __future__ import annotations

from typing import Literal, Self

import numpy as np
from pydantic import Field, model_validator

from roughcontact.contact.curve import CURVE_POINTS
from roughcontact.contact.loop import loading_loop
from roughcontact.contact.loop_dataset import unloaded
from roughcontact.errors import InputError
from roughcontact.labels.column import names_of
from roughcontact.labels.contact_columns import FLOW
from roughcontact.labels.labelled import variable
from roughcontact.study.case import Case, Record
from roughcontact.study.cases.curve_case import CurveParameters, moments_of

__all__ = ["CASE", "LoopParameters", "run"]

_ARRAYS = (*CURVE_POINTS, "dimensionless_force", "dimensionless_stiffness", "resolved", "status")
_SCALARS = ("residual_depth", "residual_gap", "work", "dissipated_work")


class LoopParameters(CurveParameters):
    """A rough surface under a hardness, loaded by increasing forces, unloaded by the same forces and reloaded.

    Parameters
    ----------
    points, size, hurst, rms, rms_band, rolloff, long_cutoff, short_cutoff, amplitudes, periodic, radius
        See `RoughSquare`.
    modulus, hardness, relative_hardness
        See `PressedSquare`; one hardness is needed.
    lowest_force, highest_force, loads
        See `ForceRange`; by default from the first cells in contact to the end of the power law.
    flow : {"removed", "raised"}
        Where plastically displaced material goes.
    """

    loads: int = Field(default=12, ge=2)
    flow: Literal["removed", "raised"] = "removed"

    @model_validator(mode="after")
    def _some_hardness(self) -> Self:
        if self.hardness is None and self.relative_hardness is None:
            raise InputError(
                "a loop with plastic flow needs a hardness", "give hardness or relative_hardness"
            )
        return self


def run(parameters: LoopParameters, rng: np.random.Generator) -> Record:
    """Return the loop of one sample.

    Returns
    -------
    xarray.Dataset
        Along ``load`` the points of first loading with plastic flow, as in a `roughcontact.Curve`; and for the same
        loads those of unloading, ``unloaded_depth``, ``unloaded_stiffness`` and others. ``residual`` is the largest
        of the three branches. Without a dimension: ``residual_depth``, ``residual_gap``, ``work``,
        ``dissipated_work``, ``hardness``, and ``rms`` of the roughness.
    """
    roughness = parameters.roughness(rng)
    loop = loading_loop(
        parameters.on_body(roughness),
        parameters.modulus,
        hardness=parameters.hardness_on(moments_of(roughness).rms_slope),  # type: ignore[arg-type] # checked to be given
        forces=parameters.forces * (parameters.modulus * parameters.size * parameters.rms),
        flow=parameters.flow,
        tolerance=parameters.tolerance,
    )
    whole = loop.loading.to_dataset()
    record = whole[[*_ARRAYS, *names_of(FLOW), "hardness"]].drop_vars("axis", errors="ignore")
    record.attrs.pop("state_notes", None)  # of one member
    # The rms height of the parameters, without the body under the roughness.
    record["dimensionless_force"] = "load", parameters.forces, whole["dimensionless_force"].attrs
    record = record.assign(unloaded(loop))
    worst = np.array([loop.loading.residual, loop.unloading.residual[::-1], loop.reloading.residual]).max(0)
    record["residual"] = variable("residual", ("load",), worst)
    for name in _SCALARS:
        record[name] = variable(name, (), getattr(loop, name))
    record["rms"] = variable("rms", (), roughness.rms)
    return record.assign_attrs(title="first loading and unloading of rough surfaces with plastic flow")


CASE = Case("loop", 1, LoopParameters, run)
