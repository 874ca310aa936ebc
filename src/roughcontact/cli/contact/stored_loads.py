"""Loads of a curve that are stored in its folder: they are not computed again."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.cli.messages import remark
from roughcontact.contact.join_curves import part_of
from roughcontact.files.read_curve import read_curve
from roughcontact.recipe.written import carried, contact_in
from roughcontact.version import __version__

if TYPE_CHECKING:
    import numpy.typing as npt

    from roughcontact.contact.curve import Curve
    from roughcontact.recipe.elastic_jobs import CurveJob
    from roughcontact.solver.loads import Loads

__all__ = ["StoredLoads", "can_be_continued", "stored_loads"]


@dataclass(frozen=True, slots=True)
class StoredLoads:
    """The requested loads that a folder holds.

    Parameters
    ----------
    curve : Curve
        With these loads only.
    values : array, shape (n,)
        The loads.
    """

    curve: Curve
    values: npt.NDArray[np.float64]


def can_be_continued(job: CurveJob) -> bool:
    """Return whether states do not depend on earlier loads, and only their numbers are needed."""
    return not (job.plastic.hardness or job.plastic.loop or job.plastic.flow or job.errors.errors)


def stored_loads(job: CurveJob, loads: Loads, out: Path | None) -> StoredLoads | None:
    """Return those of `loads` that a folder holds, of the same contact and version; None if it holds none."""
    if out is None or not can_be_continued(job):
        return None
    try:
        record = json.loads((out / "curve.json").read_text(encoding="utf-8"))
        curve = read_curve(out / "curve.nc")
        [(kind, stored)] = record["loads"].items()
        recipe, version = record["recipe"], record["provenance"]["source"]
    except (OSError, ValueError, KeyError, TypeError):  # no file, or a damaged one, which is replaced
        return None
    same = contact_in(recipe) == contact_in(carried(job, out)) and kind == f"{loads.kind}s"
    chosen = np.isin(stored, loads.values)
    if not same or version != f"roughcontact {__version__}" or len(stored) != len(curve) or not chosen.any():
        return None
    remark(
        f"{int(chosen.sum())} of {loads.values.size} loads of the same recipe are in {out} already: they are kept"
    )
    return StoredLoads(part_of(curve, chosen), np.asarray(stored)[chosen])
