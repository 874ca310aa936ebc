"""A computation in time in a file: the points so far, and all that the rest of the history depends on."""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from roughcontact import methods
from roughcontact.arrays import as_like, on_host
from roughcontact.contact.measures import StateMeasure
from roughcontact.halfspace.operators.operator import exact_of
from roughcontact.labels.note import Note, Rank
from roughcontact.validation import Array
from roughcontact.version import __version__
from roughcontact.viscoelastic.contact_in_time import BodyState
from roughcontact.viscoelastic.time_steps import History, Restart

__all__ = ["Checkpoint", "Stored"]

_NUMBERS = [each.name for each in fields(BodyState) if each.type == "float"]


@dataclass(frozen=True, slots=True)
class Stored:
    """The points of a history so far, the notes on them, and where the rest begins; None at the end of the history."""

    rows: list[dict[str, Any]]
    notes: list[Note]
    restart: Restart | None


@dataclass(frozen=True, slots=True)
class Checkpoint:
    """A file of one computation; that of another one is not read, but replaced.

    Parameters
    ----------
    path : path
    key : str
        Fingerprint of all that the numbers depend on.
    """

    path: str | os.PathLike[str]
    key: str

    @classmethod
    def of(
        cls, path: str | os.PathLike[str], history: History, measures: Sequence[StateMeasure]
    ) -> Checkpoint:
        """Return the file of a history."""
        contact, problem = history.contact, history.contact.problem
        ramp = as_like(
            np.linspace(0.0, 1.0, problem.grid.size).reshape(problem.grid.shape), problem.separation
        )
        # A product shows which body an operator is; its last digits may differ.
        product = problem.measure.total(exact_of(problem.operator).apply(ramp))
        facts = (
            *(
                __version__,
                problem.grid,
                problem.modulus,
                f"{product:.8e}",
                problem.tolerance,
                contact.material,
            ),
            *(contact.forced, contact.solver, history.steps, history.times.tolist(), history.loads.tolist()),
            *map(_identity, measures),
        )
        digest = hashlib.sha256(np.ascontiguousarray(on_host(problem.separation)).tobytes())
        digest.update("\n".join(map(repr, facts)).encode())
        return cls(path, digest.hexdigest())

    def read(self, history: History) -> Stored | None:
        """Return what the file holds; None if there is none, or it is damaged or of another computation."""
        arrays = methods.kept_arrays(self.path)
        try:
            record = json.loads(str(arrays.pop("record")))
        except (KeyError, ValueError):
            return None
        if record["key"] != self.key:
            return None
        notes = [Note(Rank(rank), text) for rank, text in record["notes"]]
        return Stored(
            record["rows"], notes, record["restart"] and _restart(record["restart"], arrays, history)
        )

    def write(self, stored: Stored) -> None:
        """Replace the file."""
        arrays: dict[str, Array] = {}
        record: dict[str, Any] = {
            "key": self.key,
            "rows": stored.rows,
            "notes": stored.notes,
            "restart": None,
        }
        if (restart := stored.restart) is not None:
            body, (tangent, box) = restart.body, restart.search
            record["restart"] = {
                **{name: getattr(restart, name) for name in ("passed", "error", "step")},
                "body": {name: getattr(body, name) for name in _NUMBERS},
                "before": body.before and body.before[1],
                "box": box and [(part.start, part.stop) for part in box],
            }
            found = {
                **{name: getattr(body, name) for name in ("pressure", "products", "totals", "largest")},
                **dict(zip(("pressures", "displacements"), body.fields, strict=True)),
                "before": body.before and body.before[0],
                "tangent": tangent,
            }
            arrays = {name: on_host(array) for name, array in found.items() if array is not None}
        text = json.dumps(record, default=lambda value: value.item())  # a number of NumPy
        methods.keep_arrays(self.path, {"record": np.array(text), **arrays})


def _identity(measure: StateMeasure) -> object:
    """Return what a measure does, in a form whose text differs where its numbers may differ."""
    code = getattr(measure, "__code__", None)
    if code is None:
        return measure
    enclosed = [each.cell_contents for each in getattr(measure, "__closure__", None) or ()]
    return measure.__qualname__, code.co_code, code.co_consts, code.co_names, enclosed  # type: ignore[attr-defined]


def _restart(record: dict[str, Any], arrays: dict[str, Array], history: History) -> Restart:
    numbers: dict[str, Any] = {name: arrays.pop(name) for name in ("products", "totals", "largest")}
    like, depth, box = history.contact.problem.separation, record["before"], record["box"]
    found = {name: as_like(array, like) for name, array in arrays.items()}
    body = BodyState(
        **record["body"],
        pressure=found["pressure"],
        fields=(found["pressures"], found["displacements"]),
        **numbers,
        before=None if depth is None else (found["before"], depth),
    )
    search = found.get("tangent"), box and tuple(slice(*part) for part in box)
    return Restart(record["passed"], body, search, record["error"], record["step"])
