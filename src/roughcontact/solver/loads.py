"""Loads that are prescribed one after the other, as one value."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np

from roughcontact.errors import InputError, about
from roughcontact.grid import AnyGrid
from roughcontact.solver.control import Control, Depth, Force
from roughcontact.validation import Array, exactly_one, number, require, scalar

__all__ = ["LoadKind", "Loads", "control_of"]

LoadKind = Literal["force", "depth", "pressure", "mean gap"]


@dataclass(frozen=True, slots=True, eq=False)
class Loads:
    """Loads of one kind, in the order in which they are applied.

    Parameters
    ----------
    kind : {"force", "depth", "pressure", "mean gap"}
        What is prescribed.
    values : array, shape (n,)
        Forces [N] (on a line [N/m]), depths or mean gaps [m], or nominal pressures [Pa].

    Raises
    ------
    ValueError
        If the values are not finite numbers in one row.

    Examples
    --------
    >>> import roughcontact as rc
    >>> from roughcontact.solver.loads import Loads
    >>> loads = Loads.of(forces=None, depths=[1e-9, 2e-9])
    >>> loads.kind, loads.controls(rc.Grid((4, 4), 1e-6))
    ('depth', [Depth(value=1e-09), Depth(value=2e-09)])
    """

    kind: LoadKind
    values: Array

    def __post_init__(self) -> None:
        values = np.atleast_1d(number(self.values, f"the list of {self.kind}s"))
        if values.ndim != 1 or not len(values):
            raise InputError(
                f"the list of {self.kind}s must hold at least one number in one row, not shape {values.shape}",
                place=f"{self.kind}s",
            )
        require(np.isfinite(values), f"the {self.kind}s must be finite", value=values)
        object.__setattr__(self, "values", values)

    def __eq__(self, other: object) -> bool:
        """Whether both are the same loads in the same order."""
        return (
            isinstance(other, Loads) and self.kind == other.kind and np.array_equal(self.values, other.values)
        )

    def __hash__(self) -> int:
        return hash((self.kind, *self.values.tolist()))

    @classmethod
    def of(cls, **given: Any) -> Loads:
        """Return the loads of the one argument that is given: forces, depths, pressures or mean_gaps, or one of them.

        Raises
        ------
        ValueError
            If none is given or more than one, or the values are not finite numbers in one row.
        """
        name, values = exactly_one(**given)
        [kind] = (kind for kind in get_args(LoadKind) if name.replace("_", " ") in (kind, f"{kind}s"))
        return cls(kind, values)

    @classmethod
    def given(cls, **given: Any) -> Loads | None:
        """Return the loads as `of` does; None if none are given."""
        return None if all(values is None for values in given.values()) else cls.of(**given)

    def rising(self, remedy: str) -> Loads:
        """Return the loads, which must increase strictly.

        Raises
        ------
        ValueError
            If one does not, with the `remedy`.
        """
        steps = np.diff(self.values) > 0
        if not steps.all():
            at = int(np.argmin(steps))
            raise InputError(
                f"the {self.kind}s must increase strictly, but {self.values[at + 1]:g} follows {self.values[at]:g} at "
                f"place {at + 1}",
                remedy,
            )
        return self

    def controls(self, grid: AnyGrid) -> list[Control]:
        """Return the force or the depth of each load on the cells of a grid.

        Raises
        ------
        ValueError
            If a load is not one that a contact without adhesion can carry.
        """
        return [control_of(self.kind, value, grid) for value in self.values.tolist()]

    def as_forces(self, grid: AnyGrid) -> Loads:
        """Return nominal pressures as forces on all cells of a grid; other loads as they are."""
        return Loads("force", self.values * grid.area) if self.kind == "pressure" else self

    @property
    def approach(self) -> Array:
        """What grows as the bodies approach, shape (n,)."""
        return -self.values if self.kind == "mean gap" else self.values


def control_of(kind: str, value: float, grid: AnyGrid) -> Control:
    """Return the control that a force [N], a depth [m] or a nominal pressure [Pa] over all cells of a grid states.

    Raises
    ------
    ValueError
        If a contact without adhesion cannot carry it.
    """
    value = scalar(value, kind)
    if kind == "force":
        return Force(value)
    if kind == "depth":
        return Depth(value)
    if not 0 < value < math.inf:
        raise about("the pressure", f"must be positive and finite [Pa], not {value}")
    return Force(value * grid.area)
