"""A sphere pressed on a half-space, compared with Hertz: a check of an installation."""

from __future__ import annotations

__all__ = ["LIMITS", "self_check"]

# With 16 cells per contact radius the deviations from Hertz are 0.12 and 0.28 %; the area is off because of the grid.
LIMITS = {"depth error": 5e-3, "stiffness error": 1e-2, "residual": 1e-8}
"""The largest values of a correct result, by their names."""


def self_check() -> dict[str, float]:
    """Return the relative deviations of depth and stiffness of a pressed sphere from Hertz, and the residual.

    About 800 of 4096 cells come into contact, so that sums over many cells and the machine code are used.
    """
    import roughcontact as rc

    given = {"radius": 1e-3, "modulus": 1e11, "force": 0.546}  # [m, Pa, N]: a contact of 16 um radius
    solution = rc.press(
        rc.shapes.paraboloid(rc.Grid((64, 64), 1e-6), radius=given["radius"]),
        given["modulus"],
        force=given["force"],
    )
    hertz = rc.theory.hertz.point(**given)
    return {
        "depth error": float(abs(solution.depth / hertz.depth - 1)),
        "stiffness error": float(abs(solution.stiffness / hertz.stiffness - 1)),
        "residual": solution.residual,
    }
