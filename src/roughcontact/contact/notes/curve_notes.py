"""Notes on a curve: reasons to doubt it as a whole, and notes on its states."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from roughcontact import methods
from roughcontact.errors import InputError
from roughcontact.labels.engineering_units import written
from roughcontact.labels.note import Note, Rank
from roughcontact.labels.variables import unit_of

if TYPE_CHECKING:
    from roughcontact.contact.curve import Curve

__all__ = ["curve_doubts", "curve_notes"]

# The area grows as F^(2/(m + 1)) under a body z ~ r^m: the exponent is 1 for rough surfaces, 2/3 for a sphere and 0 for
# a flat punch. A body of m = 39 is almost a punch.
_FIXED = 0.05
_SPAN = 2.0  # of force: a sphere of twenty cells gains twelve of them over it
_MOST = 0.5  # of the nominal area in contact: beyond, little of the map is left to come into contact
_SCATTER = 0.1  # of ln k about the power law


def curve_notes(curve: Curve) -> Iterator[Note]:
    """Yield the notes on a curve that are no reasons to doubt it as a whole, see `curve_doubts`."""
    if missed := sum(not status.converged for status in curve.status):
        text = f"{missed} of {len(curve)} loads missed the tolerance: see their status"
        yield Note(Rank.WRONG, text)
    units = [unit_of(name, curve.geometry) for name in ("force", "nominal_pressure")]
    for force, note in curve.state_notes:
        load, pressure = map(written, (force, force / curve.nominal_area), units)
        yield (
            note if force >= curve.force.max() else note._replace(text=f"At {load} ({pressure}): {note.text}")
        )
    if curve.measured:
        yield from methods.notes_on_heat_curve(curve)
        yield from methods.notes_on_flow_curve(curve)


def curve_doubts(curve: Curve) -> tuple[str, ...]:
    """Return the reasons to doubt a curve as a whole, the worst first.

    The reasons are: the same spots carry loads that differ by a factor of two or more, as under a spike or a streak;
    the power law scatters by more than a tenth.
    """
    notes = []
    if (ends := _fixed(curve)) is not None:
        unit = unit_of("force", curve.geometry)
        low, high = (written(float(curve.force[k]), unit) for k in ends)
        spots = "1 spot carries" if curve.spots[ends[1]] == 1 else f"{curve.spots[ends[1]]} spots carry"
        notes.append(
            f"The contact does not change from {low} to {high}: the same {spots} all of these loads, as under "
            "a spike, a streak or a flat punch. Remove faulty heights by despiked() or masked()."
        )
    try:
        law = curve.fit()
    except InputError:
        return tuple(notes)
    if law.scatter > _SCATTER:
        notes.append(
            f"The power law scatters by {law.scatter:.2g}: the loads follow no power law, and its exponent does "
            "not describe the surface."
        )
    return tuple(notes)


def _fixed(curve: Curve) -> tuple[int, int] | None:
    """Return the ends of the widest range of resolved loads over which the contact does not grow, or None."""
    known = np.flatnonzero(curve.resolved & (curve.contact_fraction < _MOST) & (curve.force > 0))
    known = known[np.argsort(curve.force[known], kind="stable")]
    force, area = np.log(curve.force[known]), np.log(curve.contact_area[known])
    span, growth = force - force[:, None], area - area[:, None]
    span[(growth > _FIXED * span) | (span < np.log(_SPAN))] = 0.0
    if not span.any():
        return None
    first, last = np.unravel_index(int(np.argmax(span)), span.shape)
    return int(known[first]), int(known[last])
