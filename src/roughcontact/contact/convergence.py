"""The error of a solve that missed its tolerance; it carries the best solution."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

from roughcontact.errors import joined

if TYPE_CHECKING:
    from roughcontact.solver.control import Status

__all__ = ["ConvergenceError"]


class Certified(Protocol):
    """A solution with a certificate, of a problem with a tolerance."""

    @property
    def status(self) -> Status: ...

    @property
    def residual(self) -> float: ...

    @property
    def problem(self) -> Any: ...


class ConvergenceError(RuntimeError):
    """A solve that missed its tolerance; `solution` is the best solution that was reached.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> try:
    ...     rc.press(ball, 1e9, force=1e-3, solver=rc.PolonskyKeer(max_steps=3))
    ... except rc.ConvergenceError as error:
    ...     print(error.solution.status.message)
    The solver ran out of steps above the tolerance: allow it more steps.
    """

    def __init__(self, solution: Certified) -> None:
        super().__init__(solution)  # in `args`, so that the error can be pickled
        self.solution: Any = solution  # the caller chose its type

    @property
    def message(self) -> str:
        """What is wrong, as in errors about input."""
        solution, tolerance = self.solution, self.solution.problem.tolerance
        return f"residual {solution.residual:.1e}, tolerance {tolerance:.1e}: {solution.status.outcome}"

    @property
    def remedy(self) -> str | None:
        """What to do about it."""
        remedy: str | None = self.solution.status.remedy
        return remedy

    @property
    def place(self) -> None:
        """None: no argument is wrong."""

    def __str__(self) -> str:
        return joined(self.message, self.remedy)
