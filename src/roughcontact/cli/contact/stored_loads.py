"""Loads of a curve that its folder holds already: they are not computed again."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from roughcontact.cli.messages import note
from roughcontact.contact.join_curves import part_of
from roughcontact.files.read_curve import read_curve
from roughcontact.labels.note import Note, Rank
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
    """What a folder holds of the loads that are wanted.

    Parameters
    ----------
    curve : Curve
        With these loads alone.
    values : array, shape (n,)
        The loads.
    notes : tuple of Note
        On the last of them.
    """

    curve: Curve
    values: npt.NDArray[np.float64]
    notes: tuple[Note, ...]


def can_be_continued(job: CurveJob) -> bool:
    """Return whether states do not depend on the loads before them, and none is wanted but for its numbers."""
    return not (job.plastic.hardness or job.plastic.loop or job.plastic.flow or job.errors.errors)


def stored_loads(job: CurveJob, loads: Loads, out: Path | None) -> StoredLoads | None:
    """Return the wanted `loads` that a folder holds of the same contact, by this version; None where it holds none."""
    if out is None or not can_be_continued(job):
        return None
    try:
        record = json.loads((out / "curve.json").read_text(encoding="utf-8"))
        curve = read_curve(out / "curve.nc")
        [(kind, stored)] = record["loads"].items()
        recipe, version = record["recipe"], record["provenance"]["source"]
        notes = tuple(
            Note(Rank[rank.upper()], text)
            for rank, text in zip(record["note_ranks"], record["notes"], strict=True)
            if not text.startswith("stopped")
        )
    except (OSError, ValueError, KeyError, TypeError):  # none, or a damaged one, which is replaced
        return None
    same = contact_in(recipe) == contact_in(carried(job, out)) and kind == f"{loads.kind}s"
    chosen = np.isin(stored, loads.values)
    if not same or version != f"roughcontact {__version__}" or len(stored) != len(curve) or not chosen.any():
        return None
    note(
        f"{int(chosen.sum())} of {loads.values.size} loads are in {out} already, of the same recipe: they are kept"
    )
    return StoredLoads(part_of(curve, chosen), np.asarray(stored)[chosen], notes)
