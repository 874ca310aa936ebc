"""The solution of a step of tangential loading, and the quantities computed from it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from roughcontact import methods
from roughcontact.arrays import as_like, inner, is_numpy, namespace, on_host
from roughcontact.cached import cached_property
from roughcontact.friction.contact_cells import ContactCells
from roughcontact.friction.coulomb import at_limit
from roughcontact.friction.slip_problem import Pull, Shift, SlipProblem
from roughcontact.friction.tangential_stiffness import TangentialStiffness, frozen_shear
from roughcontact.guesses import hinted
from roughcontact.halfspace.shear.shear_operator import dundurs_parameter
from roughcontact.labels.note import Note, Rank, in_order
from roughcontact.material import Solid
from roughcontact.solver.control import Status
from roughcontact.threads import one_blas_thread
from roughcontact.validation import Array, Mask

__all__ = ["TangentialSolution"]


UNLIKE = 1e-3  # of Dundurs's parameter: below it, the bodies count as alike


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class TangentialSolution:
    """A traction, the displacement of the bodies, and a certificate; other quantities are computed on access.

    Fields have shape ``(2, ny, nx)``: x component, then y component; they are arrays of the library of the pressure.
    Vectors that belong to no cell are NumPy arrays. Traction, force and displacement are those that body 2 imposes on
    body 1.

    Attributes
    ----------
    problem : SlipProblem
    load : Pull or Shift
        The prescribed load.
    traction : array, shape (2, ny, nx)
        Tangential traction [Pa], zero outside the contact.
    displacement : array, shape (2,)
        Displacement of body 2 against body 1, far from the contact, since the start [m]. If the bodies slide under a
        given force, it is the smallest displacement at which every cell has slipped forward.
    slip : array, shape (2, ny, nx)
        Slip of surface 1 over surface 2 since the start [m]; zero, within the residual, in cells that have always
        stuck, and outside the contact, where it has no meaning.
    dissipated : float
        Energy dissipated by friction in this step [J].
    status : Status
        How the solve ended.
    residual : float
        Largest violation of Coulomb's law in this step, relative to the largest displacement of a cell, from a product
        of the exact operator with this traction. If the bodies slide under a given force, the law is that of the slip
        rate of the steady slide, and only the component along the force of the slip of the step counts: none is
        backward.
    steps : int
        Number of products with the operator.
    step_residual : float
        The same violation with the whole slip of this step. It differs from `residual` only if the bodies slide under
        a given force: it then includes the slip across the force before the slide was steady, which no finite
        displacement opposes to the traction.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.Solid(1e7, 0.5)
    >>> pressed = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-5), radius=1e-3), rubber, force=1e-3)
    >>> state = rc.slide(pressed, rubber, friction=0.5, force=0.25e-3)
    >>> f"{state.sticking.sum()} cells stick, {state.slipping.sum()} slip: {state.displacement[0] * 1e9:.0f} nm"
    '32 cells stick, 20 slip: 408 nm'
    >>> state.on_host() is state, state.to_dataset()["slip"].attrs["units"]
    (True, 'm')
    >>> f"{state.to_record()['dissipated']:.2g} {state.to_record()['units']['dissipated']}"
    '5.5e-12 J'
    """

    problem: SlipProblem
    load: Pull | Shift
    traction: Array
    displacement: Array
    slip: Array
    dissipated: float
    status: Status
    residual: float
    steps: int
    step_residual: float

    @property
    def force(self) -> Array:
        """Tangential force [N], shape (2,)."""
        traction = self._on_cells(self.traction)
        return on_host(namespace(traction).sum(traction, axis=1)) * self.problem.interface.area

    @cached_property
    def slipping(self) -> Mask:
        """Mask of the cells in contact whose traction is at the limit of friction."""
        interface = self.problem.interface
        held = at_limit(interface.restrict(self.traction), self.problem.limit)
        return interface.chosen.prolong(held[None, :])[0, ...]

    @property
    def sticking(self) -> Mask:
        """Mask of the cells in contact that stick."""
        return self.problem.interface.contact & ~self.slipping

    @property
    def stick_area(self) -> float:
        """Area of the cells that stick [m^2]."""
        return _count(self.sticking) * self.problem.interface.area

    @property
    def slip_area(self) -> float:
        """Area of the cells that slip [m^2]."""
        return _count(self.slipping) * self.problem.interface.area

    @property
    def sliding(self) -> bool:
        """Whether every cell slips."""
        return _count(self.sticking) == 0

    @cached_property
    @one_blas_thread()
    def elastic_energy(self) -> float:
        """Elastic energy of the tangential displacement [J]: half the traction times it."""
        traction = self._on_cells(self.traction)
        displaced = self._on_cells(self.slip) + as_like(self.displacement[:, None], traction)
        return 0.5 * inner(traction, displaced) * self.problem.interface.area

    @cached_property
    def frozen(self) -> TangentialStiffness:
        """The response of the cells that stick to a common displacement, at constant traction of the other cells."""
        return frozen_shear(self.problem.operator, self.sticking)

    @property
    def stiffness(self) -> Array:
        """Tangential stiffness dQ/d(displacement) of the cells that stick [N/m], shape (2, 2)."""
        return self.frozen.matrix

    def on_host(self) -> TangentialSolution:
        """Return the same solution in NumPy's memory.

        Returns
        -------
        TangentialSolution
            The same object if it is already in NumPy's memory.
        """
        if is_numpy(self.traction):
            return self
        problem, pressed = self.problem, self.problem.pressed.on_host()
        interface = ContactCells.of(problem.operator, pressed.contact, problem.along)
        there = replace(problem, pressed=pressed, interface=interface)
        return replace(self, problem=there, traction=on_host(self.traction), slip=on_host(self.slip))

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes on these numbers, in sentences, the most important first."""
        return in_order(self._notes())

    def _notes(self) -> Iterator[Note]:
        if not self.status.converged:
            yield Note(Rank.WRONG, f"Residual {self.residual:.1e}: {self.status.message}")
        if not self.problem.pressed.status.converged:
            yield Note(Rank.WRONG, "The pressure missed its tolerance.")
        bodies = self.problem.bodies
        beta = dundurs_parameter(*((bodies,) if isinstance(bodies, Solid) else bodies))
        if abs(beta) > UNLIKE:
            yield Note(
                Rank.DOUBTFUL,
                f"The bodies are unlike (Dundurs's parameter {beta:.2g}): the coupling of traction and "
                "pressure is neglected.",
            )
        if self.sliding:
            text = "Every cell slips: the bodies slide."
            if self.status.converged and self.step_residual > self.problem.tolerance:
                text += (
                    " This is the steady slide, whose slip rate is opposed to the traction; the slip until "
                    f"then deviates by up to {self.step_residual:.1e} of the largest displacement."
                )
            yield Note(Rank.LIMITED, text)

    def __repr__(self) -> str:
        """Return a summary without the fields."""
        (qx, qy), (x, y) = self.force, self.displacement
        slips, cells = _count(self.slipping), self.problem.interface.chosen.count
        return (
            f"TangentialSolution({self.status.value}, force ({qx:.4g}, {qy:.4g}) N, displacement ({x:.4g}, {y:.4g}) m, "
            f"{slips} of {cells} cells slip, residual {self.residual:.1e})"
        )

    to_dataset = methods.tangential_dataset
    to_record = methods.tangential_record

    def _on_cells(self, field: Array) -> Array:
        return self.problem.interface.chosen.restrict(field)


def _count(mask: Mask) -> int:
    return int(namespace(mask).count_nonzero(mask))
