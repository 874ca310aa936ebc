"""The tangential problem: a pressed contact, two bodies, a friction coefficient."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from roughcontact.arrays import namespace
from roughcontact.contact.solution import Solution
from roughcontact.errors import InputError
from roughcontact.friction.contact_cells import ContactCells
from roughcontact.grid import AnyGrid
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.shear.shear_operator import ShearOperator, shear_half_space
from roughcontact.material import Bodies, pair_of
from roughcontact.materials import reduced_modulus
from roughcontact.solver.control import checked_tolerance
from roughcontact.validation import LARGEST, Array, exactly_one, number, positive_scalar, require

__all__ = [
    "Load",
    "Pull",
    "Shift",
    "SlipProblem",
    "continued",
    "make_problem",
    "shear_body",
]

Load = float | Sequence[float] | Array
"""A force or a displacement: its components (x, y), or one number in the direction of the traction, by default x."""

SAME = 1e-6  # relative difference below which two reduced moduli are equal
SLIDING = 1e-9  # relative distance of a force from mu P within which the bodies slide
PARALLEL = 1e-9  # sine of the angle below which two directions are equal


@dataclass(frozen=True, slots=True)
class Pull:
    """Prescribed tangential force (`x`, `y`) [N]."""

    x: float
    y: float


@dataclass(frozen=True, slots=True)
class Shift:
    """Prescribed displacement (`x`, `y`) [m] of body 2 against body 1, since the start."""

    x: float
    y: float


@dataclass(frozen=True, slots=True, eq=False)
class SlipProblem:
    """Tangential loading of a contact at constant pressure, under Coulomb's law.

    Parameters
    ----------
    pressed : Solution
        The contact under its normal force; its pressure stays as it is.
    bodies : Solid or pair of Solids
    friction : float
        Coefficient of friction mu.
    along : tuple of float, optional
        The only direction (x, y), a unit vector, in which traction may act; by default it may rotate.
    operator : ShearOperator
        Displacement [m] from traction [Pa] on the whole grid.
    interface : ContactCells
        The same operator on the cells in contact.
    tolerance : float
        Largest residual of a solution.
    """

    pressed: Solution
    bodies: Bodies
    friction: float
    along: tuple[float, float] | None
    operator: ShearOperator
    interface: ContactCells
    tolerance: float

    def __post_init__(self) -> None:
        positive_scalar(self.friction, "the friction coefficient")
        checked_tolerance(self.tolerance)

    @property
    def limit(self) -> Array:
        """Largest traction of each cell in contact, mu p [Pa], in flat order."""
        pressure = namespace(self.pressed.pressure).expand_dims(self.pressed.pressure, axis=0)
        return self.friction * self.interface.chosen.restrict(pressure)[0, :]

    @property
    def capacity(self) -> float:
        """Largest tangential force that friction can hold, mu P [N]."""
        return float(namespace(self.pressed.pressure).sum(self.limit)) * self.interface.area

    def slides_under(self, load: Pull | Shift) -> bool:
        """Whether a force is the largest that friction can hold."""
        return isinstance(load, Pull) and math.hypot(load.x, load.y) >= self.capacity * (1 - SLIDING)

    def load(self, *, force: Load | None = None, displacement: Load | None = None) -> Pull | Shift:
        """Return the load given by exactly one of the two, or raise a ValueError if this contact cannot carry it."""
        name, given = exactly_one(force=force, displacement=displacement)
        value = np.asarray(number(given, "a tangential load"))
        if value.ndim == 0:
            value = value * np.asarray(self.along or (1.0, 0.0))
        if value.shape != (2,) or not np.isfinite(value).all():
            raise InputError(f"a tangential load is one finite number, or two (x, y), not {given}")
        load = (Pull if name == "force" else Shift)(*value.tolist())
        size = math.hypot(load.x, load.y)
        if size > LARGEST:
            raise InputError(f"a tangential load must be at most {LARGEST:g} in SI units, not {given}")
        if self.along is not None:
            ex, ey = self.along
            if abs(load.x * ey - load.y * ex) > PARALLEL * size:
                raise InputError(
                    f"traction acts along {self.along} only, and ({load.x:g}, {load.y:g}) does not",
                    "omit `along`",
                )
        if isinstance(load, Pull) and size > self.capacity * (1 + SLIDING):
            raise InputError(
                f"friction holds at most mu P = {self.capacity:.6g} N: under {size:.6g} N the bodies slide away",
                "pull less, or press harder",
            )
        if isinstance(load, Shift) and self.interface.floating:
            raise InputError(
                "all cells of a periodic grid are in contact: no traction displaces their mean",
                "give a force",
            )
        return load


def make_problem(
    pressed: Solution,
    bodies: Bodies,
    friction: float,
    *,
    along: Sequence[float] | None = None,
    operator: ShearOperator | None = None,
    tolerance: float = 1e-8,
) -> SlipProblem:
    """Return the problem, or raise a ValueError that describes what is wrong with it."""
    kind = pressed.problem.geometry
    if kind is not Geometry.SURFACE:
        raise InputError(
            f"partial slip is computed for a surface of two axes, not for a {kind.value}",
            "press a map of heights",
        )
    if not bool(namespace(pressed.contact).any(pressed.contact)):
        raise InputError("the bodies do not touch: there is no contact to load", "press them first")
    modulus, stated = reduced_modulus(*pair_of(bodies)), pressed.problem.modulus
    if math.isfinite(stated) and abs(modulus - stated) > SAME * stated:
        raise InputError(
            f"these bodies have a reduced modulus of {modulus:.6g} Pa, but were pressed with {stated:.6g} Pa",
            "use the same bodies for both",
        )
    body = shear_body(pressed.problem.grid, bodies, operator)
    direction = None if along is None else _unit(along)
    interface = ContactCells.of(body, pressed.contact, direction)
    return SlipProblem(pressed, bodies, float(friction), direction, body, interface, tolerance)


def continued(
    earlier: SlipProblem,
    pressed: Solution,
    bodies: Bodies,
    friction: float,
    *,
    along: Sequence[float] | None = None,
    operator: ShearOperator | None = None,
    tolerance: float = 1e-8,
) -> SlipProblem:
    """Return an earlier problem, with its operator, for another tolerance; everything else must be the same."""
    if earlier.pressed is not pressed:
        raise InputError("the initial state is that of another contact: the pressure must stay as it is")
    given = (bodies, friction, earlier.along if along is None else _unit(along))
    if given != (earlier.bodies, earlier.friction, earlier.along):
        raise InputError(
            f"the initial state has bodies {earlier.bodies}, friction {earlier.friction} and along={earlier.along}",
            "continue with the same",
        )
    if operator is not None and operator is not earlier.operator:
        raise InputError(
            "the initial state was found with another operator", "pass the same operator, or none"
        )
    return replace(earlier, tolerance=tolerance)


def shear_body(grid: AnyGrid, bodies: Bodies, operator: ShearOperator | None = None) -> ShearOperator:
    """Return `operator`, which must have the grid `grid`; by default that of the half-spaces of the bodies.

    Raises
    ------
    ValueError
        If the operator has another grid, or the grid has not two axes.
    """
    if operator is None:
        return shear_half_space(grid, bodies)
    require(operator.grid == grid, f"the operator's grid {operator.grid} is not the contact's {grid}")
    return operator


def _unit(along: Sequence[float]) -> tuple[float, float]:
    direction = np.asarray(number(along, "along"))
    size = float(np.hypot(*direction)) if direction.shape == (2,) else math.nan
    require(math.isfinite(size) and size > 0, f"`along` is a direction (x, y), not {along}")
    x, y = direction / size
    return float(x), float(y)
