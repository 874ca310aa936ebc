"""The state of a viscoelastic contact at one time."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from roughcontact.contact.solution import Solution
from roughcontact.guesses import hinted
from roughcontact.labels.variables import unit_of
from roughcontact.solver.control import Status
from roughcontact.validation import Array, numeric
from roughcontact.viscoelastic.prony_series import Viscoelastic

__all__ = ["ViscoelasticState"]


@hinted
@dataclass(frozen=True, eq=False, repr=False)
class ViscoelasticState:
    """Pressure, gap and energies of a viscoelastic contact at one time.

    Attributes
    ----------
    time : float
        [s].
    solution : Solution
        The same pressure, contact and gap as an elastic contact with the instantaneous modulus. Its surface is the
        deformed one as it would be immediately after a sudden unloading.
    displacement : array, shape of the grid
        Displacement of the surface [m].
    material : Viscoelastic
    work : float
        Work of the load since the start [J].
    stored_energy, dissipated_energy : float
        Energy of the springs of the material now, and energy dissipated by its dashpots since the start [J].
    time_residual : float
        Largest pressure of an open cell in the middle of the last step, over the largest pressure so far. Open cells
        are those without contact at both ends.
    time_error : float
        Estimate of the error of time, summed over all steps so far: of the force or the depth and of the total strain
        by step doubling, and of the balance of energy; each over its largest value so far (docs/concepts/time.md). NaN
        for fixed steps.
    products : int
        Products with the operator on the way from the state before; those of an estimate included.
    prescribed : bool
        Whether the time is one of those that were given.

    Examples
    --------
    >>> import roughcontact as rc
    >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e7, 1.0)
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> *_, last = rc.viscoelastic_path(ball, rubber, times=[0, 1, 100], depths=[0, 1e-7, 1e-7])
    >>> f"{last.stiffness / last.relaxed_stiffness:.1f}", f"{abs(last.dynamic_stiffness(1.0)) / last.stiffness:.3f}"
    ('10.0', '0.711')
    >>> abs(last.work - last.stored_energy - last.dissipated_energy) < 1e-2 * last.work
    True
    """

    time: float
    solution: Solution
    displacement: Array
    material: Viscoelastic
    work: float
    stored_energy: float
    dissipated_energy: float
    time_residual: float
    time_error: float
    products: int
    prescribed: bool

    @property
    def pressure(self) -> Array:
        """Contact pressure [Pa]."""
        return self.solution.pressure

    @property
    def contact(self) -> npt.NDArray[np.bool_]:
        """Mask of the cells in contact."""
        return self.solution.contact

    @property
    def gap(self) -> Array:
        """Deformed gap [m]; NaN where nothing was measured."""
        return self.solution.gap

    @property
    def depth(self) -> float:
        """Approach of the bodies since first touch of the undeformed surface [m]."""
        return self.solution.depth

    @property
    def force(self) -> float:
        """Normal force [N]; [N/m] on a line."""
        return self.solution.force

    @property
    def nominal_pressure(self) -> float:
        """Force over the nominal area [Pa]."""
        return self.solution.nominal_pressure

    @property
    def max_pressure(self) -> float:
        """Largest pressure of a cell [Pa]."""
        return self.solution.max_pressure

    @property
    def mean_gap(self) -> float:
        """Mean of the deformed gap over the measured cells [m]."""
        return self.solution.mean_gap

    @property
    def contact_area(self) -> float:
        """Real contact area [m^2]; [m] on a line."""
        return self.solution.contact_area

    @property
    def contact_fraction(self) -> float:
        """Relative real contact area A/A0."""
        return self.solution.contact_fraction

    @property
    def stiffness(self) -> float:
        """Stiffness against a sudden change of the depth [N/m], contact region held fixed; infinite with a dashpot."""
        material = self.material
        return self._stiffness(math.inf if material.dashpot else material.instantaneous)

    @property
    def relaxed_stiffness(self) -> float:
        """Stiffness against a change of the depth after a long time [N/m], contact region held fixed."""
        return self._stiffness(self.material.equilibrium)

    @numeric(frequency="rad/s")
    def dynamic_stiffness(self, frequency: float) -> complex:
        """Return the complex stiffness of a small oscillation about this state, contact region held fixed.

        Parameters
        ----------
        frequency : float
            Angular frequency omega [rad/s].

        Returns
        -------
        complex
            Amplitude of the force over that of the depth [N/m]: real part in phase, imaginary part ahead by a quarter
            of a period.

        Raises
        ------
        ValueError
            If the frequency is negative, or outside the band of the data of the material.

        Examples
        --------
        >>> import roughcontact as rc
        >>> rubber = rc.viscoelastic.standard_solid(1e6, 1e7, 1.0)
        >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
        >>> *_, last = rc.viscoelastic_path(ball, rubber, times=[0, 1], depths=[0, 1e-7])
        >>> stiffness = last.dynamic_stiffness(1.0)
        >>> f"{stiffness.imag / stiffness.real:.3f}"  # the loss factor of the material
        '0.818'
        """
        return self._unit_stiffness * complex(self.material.complex_modulus(frequency))

    @property
    def energy_leak(self) -> float:
        """Work less stored and dissipated energy [J]: an estimate of the error of time of the energies."""
        return self.work - self.stored_energy - self.dissipated_energy

    @property
    def residual(self) -> float:
        """Largest violation of the conditions of contact, see `Solution`."""
        return self.solution.residual

    @property
    def status(self) -> Status:
        """How the solve ended."""
        return self.solution.status

    def __repr__(self) -> str:
        """Return the main numbers, without the fields."""
        unit = unit_of("force", self.solution.problem.geometry)
        return (
            f"ViscoelasticState({self.status.value}, time {self.time:.4g} s, force {self.force:.4g} {unit}, "
            f"depth {self.depth:.4g} m, residual {self.residual:.1e})"
        )

    @property
    def _unit_stiffness(self) -> float:
        return self.solution.stiffness / self.solution.problem.modulus

    def _stiffness(self, modulus: float) -> float:
        unit = self._unit_stiffness
        return unit * modulus if unit and modulus else 0.0
