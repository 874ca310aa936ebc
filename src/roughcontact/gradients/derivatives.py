"""Derivatives of force, depth, mean gap and energy with respect to the height of every cell.

As the contact region changes, force, depth, mean gap and energy stay smooth enough: their derivatives on the fixed
region are exact, except in states in which a cell is about to touch or to open.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, TypeAlias, get_args

from roughcontact import methods
from roughcontact.cached import cached_property
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError, about
from roughcontact.gradients.linearised import LinearisedContact
from roughcontact.guesses import hinted
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.validation import Array

__all__ = ["Reference", "Sensitivity", "require_reference"]

Reference: TypeAlias = Literal["first touch", "level"]
"""Where the depth counts from: first touch, as everywhere, or a level that does not move with the highest cell."""

DIFFERENTIABLE = (
    *("force_at_depth", "depth_at_force", "mean_gap_at_force", "mean_gap_at_depth"),
    *("energy_at_force", "energy_at_depth"),
)


def require_reference(reference: object) -> None:
    """Raise a ValueError for a word that is no `Reference`."""
    if reference not in get_args(Reference):
        raise about("the reference", f"must be 'first touch' or 'level', not {reference!r}")


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class Sensitivity:
    """Derivatives of a contact with respect to heights, as `sensitivity` returns them; computed on first access.

    Every array has the shape of the grid; an entry is the derivative with respect to the height of one cell [m], the
    other heights held, and is zero for a missing cell. A quantity without a derivative is refused by name: contact
    area, spots and stiffness change in steps on a grid.

    Attributes
    ----------
    solution : Solution
        The load.
    reference : {"first touch", "level"}
        Where the depth counts from. A level does not move if heights change, first touch moves with the highest cell.

    Examples
    --------
    >>> import numpy as np
    >>> import roughcontact as rc
    >>> grid = rc.Grid((32, 32), 1e-6, periodic=True)
    >>> surface = rc.self_affine(grid, hurst=0.8, rms=1e-7, rng=1, rolloff=16e-6, short_cutoff=8e-6)
    >>> derivatives = rc.sensitivity(rc.press(surface, 1e9, pressure=1e7))
    >>> derivatives.depth_at_force.shape, bool(abs(derivatives.depth_at_force.sum()) < 1e-7)
    ((32, 32), True)
    >>> derivatives.to_rms_height()["mean_gap_at_force"] > 0
    True
    """

    solution: Solution
    reference: Reference = "first touch"

    @property
    def share(self) -> Array:
        """Part of a further load that each cell takes [1]; the sum over all cells is 1."""
        return self.linearised.share

    @cached_property
    def depth_at_force(self) -> Array:
        """Derivative of the depth at given force [1]."""
        # G3
        return self._highest - self.share

    @cached_property
    def force_at_depth(self) -> Array:
        """Derivative of the force at given depth [N/m]."""
        # G3
        return -self.linearised.finite_stiffness * self.depth_at_force

    @cached_property
    def mean_gap_at_force(self) -> Array:
        """Derivative of the mean gap at given force [1]."""
        # G6
        return self.linearised.mean_gap + (1 - self.linearised.closing) * self.share

    @cached_property
    def mean_gap_at_depth(self) -> Array:
        """Derivative of the mean gap at given depth [1]."""
        self.linearised.require_finite_stiffness()
        # G6
        return self.linearised.mean_gap + (1 - self.linearised.closing) * self._highest

    @cached_property
    def energy_at_force(self) -> Array:
        """Derivative of the elastic energy at given force [N]."""
        self._require_elastic()
        # G4
        return self.linearised.forces - self.solution.force * self.share

    @cached_property
    def energy_at_depth(self) -> Array:
        """Derivative of the elastic energy at given depth [N]."""
        self._require_elastic()
        self.linearised.require_finite_stiffness()
        # G4
        return self.linearised.forces - self.solution.force * self._highest

    def along(self, direction: Array) -> dict[str, float]:
        """Return the derivatives as all heights change along a direction.

        Parameters
        ----------
        direction : array, shape of the grid
            Change of each height, in metres per unit of a parameter; values of missing cells do not count.

        Returns
        -------
        dict of str to float
            For each quantity its derivative with respect to the parameter. Under a hardness without the energies, in
            full contact of a periodic surface without those at given depth.

        Raises
        ------
        ValueError
            If the direction does not fit the grid, or is not finite.

        Examples
        --------
        >>> import roughcontact as rc
        >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
        >>> derivatives = rc.sensitivity(rc.press(ball, 1e9, force=1e-3))
        >>> raised = derivatives.along(1e-9 + 0 * ball.heights)  # all heights, so nothing changes
        >>> abs(raised["depth_at_force"]) < 1e-15
        True
        """
        field, xp = self.linearised.checked(direction, "direction"), self.solution.problem.measure.xp
        plastic, full = self.solution.problem.plastic, self.linearised.full
        names = [
            each
            for each in DIFFERENTIABLE
            if not ((plastic and "energy" in each) or (full and each.endswith("depth")))
        ]
        return {name: float(xp.sum(getattr(self, name) * field)) for name in names}

    def pullback(
        self,
        *,
        pressure: Array | None = None,
        displacement: Array | None = None,
        gap: Array | None = None,
        held: Literal["force", "depth"] = "force",
    ) -> Array:
        """Return the derivatives of a scalar that is a function of pressure, displacement and gap (reverse mode).

        Parameters
        ----------
        pressure : array, shape of the grid, optional
            Derivatives of the scalar with respect to the pressure of each cell, per pascal.
        displacement, gap : array, shape of the grid, optional
            Derivatives with respect to displacement and gap of each cell, per metre; those of missing cells do not
            count.
        held : {"force", "depth"}
            The given load.

        Returns
        -------
        array, shape of the grid
            Derivatives of the scalar with respect to the heights [per m]. They take one linear problem on the contact.

        Raises
        ------
        ValueError
            If an array does not fit the grid, in full contact of a periodic surface, or if `held` is another word.
        RuntimeError
            If the linear problem missed its tolerance.

        Examples
        --------
        >>> import roughcontact as rc
        >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
        >>> solution = rc.press(ball, 1e9, force=1e-3)
        >>> derivatives = rc.sensitivity(solution)
        >>> of_energy = derivatives.pullback(pressure=solution.displacement * 1e-12)  # 2 U is the sum of p u dA
        >>> bool(abs(of_energy - derivatives.energy_at_force).max() < 1e-6 * abs(of_energy).max())
        True
        """
        if held not in ("force", "depth"):
            raise about("held", f"must be 'force' or 'depth', not {held!r}")
        self.linearised.require_finite_stiffness()
        heights, depth = self.linearised.pullback(pressure, displacement, gap)
        # G10
        return heights - depth * (self.share if held == "force" else self._highest)

    def secant_stiffness(self, other: Sensitivity) -> tuple[float, Array]:
        """Return the secant stiffness to another load of the same bodies, and its derivatives.

        Between loads 10 to 20 % apart it is within 1 to 2 % of the stiffness, which has no derivative on a grid.

        Parameters
        ----------
        other : Sensitivity
            Of the other load, given by its force like this one.

        Returns
        -------
        tuple of float and array
            Difference of the forces over that of the depths [N/m], and its derivative with respect to the height of
            each cell at given forces [N/m^2].

        Raises
        ------
        ValueError
            If both loads have the same depth, or different grids.

        Examples
        --------
        >>> import roughcontact as rc
        >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
        >>> first, second = (rc.sensitivity(s) for s in rc.loading_path(ball, 1e9, forces=[1e-3, 1.2e-3]))
        >>> secant, derivative = first.secant_stiffness(second)
        >>> f"{secant / first.solution.stiffness:.2f}", derivative.shape
        ('1.02', (33, 33))
        """
        if not isinstance(other, Sensitivity):
            raise about(
                "other", f"is a {type(other).__name__}", "give sensitivity(solution) of the other load"
            )
        a, b = self.solution, other.solution
        if a.problem.grid != b.problem.grid:
            raise about("other", "is a load on another grid", "give a load of the same surface")
        if a.depth == b.depth:
            raise about("other", "has the same depth as this load", "give another load")
        secant = (b.force - a.force) / (b.depth - a.depth)
        return secant, secant / (b.depth - a.depth) * (other.share - self.share)

    to_rms_height = methods.to_rms_height
    to_radius = methods.to_radius
    to_tilt = methods.to_tilt
    to_load = methods.to_load
    to_modulus = methods.to_modulus
    to_hardness = methods.to_hardness

    @property
    def residual(self) -> float:
        """Largest error of the unit displacement that the derivatives follow from: their certificate."""
        return self.linearised.frozen.residual

    @property
    def notes(self) -> tuple[str, ...]:
        """Limits of these derivatives, in sentences."""
        return in_order(self._notes())

    def __repr__(self) -> str:
        """Return the load and the reference."""
        return f"Sensitivity(reference={self.reference!r}, {self.solution!r})"

    def _notes(self) -> Iterator[Note]:
        solution = self.solution
        if not solution.status.converged:
            yield Note(
                Rank.WRONG, "The load missed its tolerance: these are not the derivatives of its limit."
            )
        if self.residual > self.linearised.tolerance:
            yield Note(
                Rank.WRONG,
                f"The derivatives follow from a unit displacement whose error is {self.residual:.1e}, more than the "
                f"{self.linearised.tolerance:.1e} that the tolerance of the load allows.",
            )
        touching = int(solution.problem.measure.xp.count_nonzero(solution.touching))
        if touching:
            cells, them = ("1 cell touches", "it") if touching == 1 else (f"{touching} cells touch", "them")
            yield Note(
                Rank.LIMITED,
                f"{cells} without pressure: the derivatives hold for changes that open {them}. For changes that close "
                f"{them} they differ.",
            )

    @cached_property
    def linearised(self) -> LinearisedContact:
        """The load linearised on its fixed region."""
        return LinearisedContact(self.solution)

    @cached_property
    def _highest(self) -> Array:
        """One at the highest cell, with which first touch moves; zero at a fixed level."""
        problem, xp = self.solution.problem, self.solution.problem.measure.xp
        if self.reference == "level":
            return xp.zeros_like(problem.separation)  # type: ignore[no-any-return]
        highest = problem.separation == xp.min(problem.separation)
        count = int(xp.count_nonzero(highest))
        if count > 1:
            raise InputError(
                f"{count} cells share the greatest height, so the depth since first touch has no derivative",
                "take it from a level: sensitivity(solution, reference='level')",
                "reference",
            )
        return xp.astype(highest, problem.separation.dtype)  # type: ignore[no-any-return]

    def _require_elastic(self) -> None:
        if self.solution.problem.plastic:
            raise InputError(
                "under a hardness the elastic energy has no derivative: it depends on how the surface has flowed",
                "take the derivative of force or depth",
            )
