"""A solve that missed its tolerance, as an error that carries the best answer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from roughcontact.adhesion.adhesive_state import AdhesiveState
    from roughcontact.contact.solution import Solution

__all__ = ["ConvergenceError"]


class ConvergenceError(RuntimeError):
    """A solve that missed its tolerance; `solution` is the best that was reached, with adhesion an `AdhesiveState`.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4)
    >>> try:
    ...     rc.press(ball, 1e9, force=1e-3, solver=rc.PolonskyKeer(max_steps=3))
    ... except rc.ConvergenceError as error:
    ...     print(error.solution.status.message)
    The solver ran out of steps above the tolerance; allow it more steps.
    """

    def __init__(self, solution: Solution | AdhesiveState) -> None:
        super().__init__(solution)  # in `args`, so that the error can be pickled
        self.solution: Any = solution  # which of the two, whoever pressed knows

    def __str__(self) -> str:
        from roughcontact.adhesion.adhesive_state import AdhesiveState

        solution = self.solution
        if isinstance(solution, AdhesiveState):
            tolerance, words = solution.blank.tolerance, "the path"
        else:
            tolerance, words = solution.problem.tolerance, f"{solution.steps} steps"
        return f"residual {solution.residual:.1e} after {words}, tolerance {tolerance:.1e}: {solution.status.message}"
