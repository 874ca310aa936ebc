"""A sphere pressed on a half-space, beside Hertz: whether an installation computes what it should."""

from __future__ import annotations

__all__ = ["LIMITS", "self_check"]

# Deviations from Hertz at 16 cells to the radius of the contact are 0.12 and 0.28 %: that of the area is the grid's.
LIMITS = {"depth error": 5e-3, "stiffness error": 1e-2, "residual": 1e-8}
"""The largest values of a right answer, by their names."""


def self_check() -> dict[str, float]:
    """Return how far depth and stiffness of a pressed sphere are from Hertz, relatively, and the residual.

    Some 800 of 4096 cells come into contact: sums over many cells and the machine code take part.
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
