"""The derivatives of a load, for loads that have them."""

from __future__ import annotations

from roughcontact.contact.solution import Solution
from roughcontact.contact.stiffness import elastic_contact
from roughcontact.errors import InputError
from roughcontact.gradients.derivatives import Reference, Sensitivity, require_reference

__all__ = ["sensitivity"]

HISTORY = "depends on the states before it, so it has no derivative with respect to the heights"
OF_EACH = "give each solution of rc.loading_path, or take rc.differentiable_curve"
OTHERS = {
    "AdhesiveState": (
        f"an AdhesiveState {HISTORY}",
        "give the Solution of rc.press, which is without adhesion",
    ),
    "DetachmentState": (f"a DetachmentState {HISTORY}", "give the Solution from which the detachment began"),
    "TangentialSolution": (f"a TangentialSolution {HISTORY}", "give the Solution that rc.slide was given"),
    "Curve": ("a Curve does not hold the pressures, from which derivatives follow", OF_EACH),
    "Loop": ("a Loop does not hold the pressures, from which derivatives follow", OF_EACH),
}
"""Answers without derivatives: the reason, and what to do."""


def sensitivity(solution: Solution, *, reference: Reference = "first touch") -> Sensitivity:
    """Return the derivatives of a load with respect to the height of every cell.

    They follow from the tangent of the stiffness, so they cost what the stiffness costs. The derivatives are exact
    except in states in which a cell touches without pressure; there they are one-sided, and a note reports it. For a
    curve, take them for each solution of `loading_path`, or use `differentiable_curve`.

    Parameters
    ----------
    solution : Solution
        Of `press` or `loading_path`: elastic, or on first loading under a hardness.
    reference : {"first touch", "level"}
        Where the depth counts from. If cells share the greatest height, as on a flat punch, only the depth from a level
        has derivatives. The highest cell moves first touch, but no level.

    Returns
    -------
    Sensitivity

    Raises
    ------
    ValueError
        If the load is neither elastic nor first loading under a hardness (adhesion, slip, a flattened surface, a
        hardness by the size of spots, a surface that rises with flow), or if no cell is in contact elastically.

    Examples
    --------
    >>> import roughcontact as rc
    >>> ball = rc.shapes.paraboloid(rc.Grid((33, 33), 1e-6), radius=1e-4)
    >>> derivatives = rc.sensitivity(rc.press(ball, 1e9, force=1e-3), reference="level")
    >>> f"{derivatives.to_radius(1e-4)['force_at_depth'] * 1e-4 / 1e-3:.2f}"  # Hertz: F is proportional to R^(1/2)
    '0.53'
    """
    if not isinstance(solution, Solution):
        raise _without(solution)
    require_reference(reference)
    problem, xp = solution.problem, solution.problem.measure.xp
    for found, words, remedy in (
        (
            problem.flow is not None,
            "a surface that larger loads have flattened depends on its original heights through the flow",
            "press its present heights without a hardness: rc.press(solution.problem.surface, ...)",
        ),
        (
            problem.size_law is not None,
            "a hardness that depends on the size of spots changes in steps with the heights",
            "give the hardness as a number",
        ),
        (
            problem.rise != 0,
            "a surface that rises with flow depends on the loads before",
            "give loading_path flow='removed'",
        ),
        (
            not solution.contact_area,
            "without contact there is nothing to differentiate",
            "press deeper",
        ),
        (
            not bool(xp.any(elastic_contact(solution.pressure, problem.hardness))),
            "all cells in contact are plastic, so no force grows with the depth",
            "press under a greater hardness",
        ),
    ):
        if found:
            raise InputError(words, remedy, "solution")
    return Sensitivity(solution, reference)


def _without(answer: object) -> InputError:
    """Return the error about an answer without derivatives."""
    name = type(answer).__name__
    unknown = f"a {name} has no derivatives", "give a Solution, as rc.press and rc.loading_path return it"
    return InputError(*OTHERS.get(name, unknown), "solution")
