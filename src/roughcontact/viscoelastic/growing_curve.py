"""The curve of a viscoelastic contact while it is computed, and its continuation from a file."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from roughcontact import methods
from roughcontact.contact.measures import StateMeasure, measured_at, measured_columns
from roughcontact.labels.column import names_of
from roughcontact.labels.note import Note
from roughcontact.labels.viscoelastic_columns import VISCOELASTIC_CURVE
from roughcontact.progress.events import tracked
from roughcontact.solver.control import Status
from roughcontact.viscoelastic.checkpoint import Checkpoint, Stored
from roughcontact.viscoelastic.time_steps import History, Restart
from roughcontact.viscoelastic.viscoelastic_curve import ViscoelasticCurve
from roughcontact.viscoelastic.viscoelastic_state import ViscoelasticState

__all__ = ["GrowingCurve"]

_POINTS = names_of(
    column for column in VISCOELASTIC_CURVE[("time",)] if column.name not in ("status", "energy_leak")
)
_EVERY = 60.0  # [s] between two writes of a checkpoint


@dataclass(slots=True)
class GrowingCurve:
    """The points of a history so far; fields of the states are not kept.

    Attributes
    ----------
    history : History
    measures : sequence of functions
        Of a `Solution`, see `viscoelastic_curve`.
    checkpoint : Checkpoint, optional
        The file from which the curve goes on, and to which it is written once a minute and at the end.
    rows : list of dict
        The points, each with ``status`` and ``measured``.
    whole : bool
        Whether the history is computed to its end.
    """

    history: History
    measures: Sequence[StateMeasure] = ()
    checkpoint: Checkpoint | None = None
    rows: list[dict[str, Any]] = field(default_factory=list, init=False)
    whole: bool = field(default=False, init=False)
    _notes: list[Note] = field(default_factory=list, init=False)
    _restart: Restart | None = field(default=None, init=False)
    _count: int = field(default=0, init=False)  # rows at the restart

    def __post_init__(self) -> None:
        if self.checkpoint is not None and (stored := self.checkpoint.read(self.history)) is not None:
            self.rows, self._notes, self._restart = stored.rows, stored.notes, stored.restart
            self._count, self.whole = len(stored.rows), stored.restart is None

    def grow(self) -> None:
        """Compute the rest of the history; what is done is kept if this is interrupted."""
        if self.whole:
            return
        largest = max((row["contact_area"] for row in self.rows), default=-1.0)
        due = time.monotonic() + _EVERY
        try:
            for state, restart in tracked(self.history.states(self._restart), "Pressing", "steps"):
                row = self._row(state)
                if state.contact_area > largest:
                    largest = state.contact_area
                    self._notes = list(methods.notes_on(state.solution))
                self.rows.append(row)
                if restart is not None:
                    self._restart, self._count = restart, len(self.rows)
                    if time.monotonic() > due:
                        self._write()
                        due = time.monotonic() + _EVERY
                del state, restart
            self.whole, self._restart, self._count = True, None, len(self.rows)
        finally:
            self._write()

    def curve(self) -> ViscoelasticCurve:
        """Return the curve so far."""
        columns = {name: np.array([row[name] for row in self.rows]) for name in _POINTS}
        return ViscoelasticCurve(
            **columns,
            status=tuple(Status(row["status"]) for row in self.rows),
            geometry=self.history.contact.problem.geometry,
            measured=measured_columns([row["measured"] for row in self.rows]),
            state_notes=tuple(self._notes),
        )

    def _row(self, state: ViscoelasticState) -> dict[str, Any]:
        row = {name: getattr(state, name) for name in _POINTS}
        measured = measured_at(state.solution, self.measures, ("time", *_POINTS))
        return row | {"status": state.status.value, "measured": measured}

    def _write(self) -> None:
        if self.checkpoint is not None and (self.whole or self._restart is not None):
            self.checkpoint.write(Stored(self.rows[: self._count], self._notes, self._restart))
