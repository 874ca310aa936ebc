"""Figure 17: the stiffness of the stepped indenter against load, schematic and computed."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.figure import Figure

import roughcontact as rc
from roughcontact.theory.spheres_and_punches.power_law_indenter import contact
from roughcontact.validation import Array
from roughcontact_thesis import drawing, fig15_stepped_shape
from roughcontact_thesis.ruling import exactly
from roughcontact_thesis.stepped_body import INDENTER, MODULUS, full_steps, stepped_body
from roughcontact_thesis.verdict import Verdict, Verdicts

__all__ = ["Stiffening", "case", "draw", "verdicts"]

TITLE = "stiffness of the stepped indenter against load, schematic and computed"
COUNT = 7
POINTS = 160
SEED = 0
APART = 1e-3  # of a force at which the stiffness jumps
CHOSEN = (
    f"C = {INDENTER.ratio:g}, H = {INDENTER.hurst:g} as in figure 15, {COUNT + 1} cylinders",
    "both axes logarithmic, with numbers; the thesis has a sketch",
    "staircase: eq. 4.22 with its factor of two, eq. 4.23 with the steps before the last",
    "beside the staircase the contact of rings, and the smooth indenter z = Q r^H through the rims",
)
SIZE = (drawing.COLUMN, 3.4)

_MODEL, _COMPUTED, _SMOOTH = "0.45", "#0072b2", "#d55e00"


@dataclass(frozen=True, slots=True)
class Stiffening:
    """Forces [E* r0 h0] and stiffnesses [E* r0] of the staircase, of the rings and of the smooth indenter.

    Attributes
    ----------
    steps : tuple of array
        Forces and stiffnesses of the model just before the next cylinder touches.
    full : tuple of Solution
        The same states of the rings.
    curve : Curve
        Loading curve of the rings.
    smooth : array
        Stiffness of the smooth indenter at the forces of the curve.
    """

    steps: tuple[Array, Array]
    full: tuple[rc.Solution, ...]
    curve: rc.Curve
    smooth: Array


def case(seed: int = SEED) -> Stiffening:
    """Return the stiffness against load in three ways; nothing is random, the seed is not used."""
    body = stepped_body(INDENTER, COUNT + 1)
    operator = rc.ring(body.grid, MODULUS)
    full = full_steps(body, operator, COUNT)
    # Just below the last state: there the next rim touches, and the stiffness has two values.
    forces = np.geomspace(full[0].force / 4, (1 - APART) * full[-1].force, POINTS)
    curve = rc.loading_curve(body, MODULUS, forces=forces, operator=operator)
    coefficient = fig15_stepped_shape.case().coefficient
    smooth = contact(MODULUS, exponent=INDENTER.hurst, coefficient=coefficient, force=forces)
    return Stiffening(INDENTER.corners(COUNT, MODULUS), full, curve, smooth.stiffness)


def draw(figure: Figure, data: Stiffening) -> None:
    """Draw the staircase with its corners, the computed curve, and the smooth indenter."""
    axes = figure.subplots()
    curve, (corners, _) = data.curve, data.steps
    dense = np.geomspace(curve.force[0], curve.force[-1], 4000)
    dense = dense[dense <= corners[-1]]
    stairs, words = INDENTER.stiffness(dense, COUNT, MODULUS), "schematic (eqs 4.22, 4.23)"
    axes.plot(dense, stairs, color=_MODEL, label=words)
    axes.plot(*data.steps, "o", color=_MODEL, markersize=4.5)
    axes.plot(curve.force, curve.stiffness, color=_COMPUTED, linewidth=1.6, label="computed")
    full = np.array([(state.force, state.stiffness) for state in data.full])
    axes.plot(*full.T, "o", color=_COMPUTED, markersize=4.5)
    label = rf"$z \sim r^H$: slope $1/(1+H) = {1 / (1 + INDENTER.hurst):.3f}$"
    axes.plot(curve.force, data.smooth, "--", color=_SMOOTH, label=label)
    words = r"contact stiffness $k\,/\,(E^* r_0)$"
    drawing.label(axes, r"force $F\,/\,(E^* r_0 h_0)$", words, **drawing.LOG)
    drawing.legend_below(axes, 1)


def verdicts(data: Stiffening) -> Verdicts:
    """Return the exponent between the last steps, and what the last cylinder contributes to the force."""
    force, stiffness = (np.array([getattr(s, name) for s in data.full]) for name in ("force", "stiffness"))
    exponent = float(np.log(stiffness[-1] / stiffness[-2]) / np.log(force[-1] / force[-2]))
    heights = INDENTER.heights(COUNT)
    shares = [float((k * heights / f)[-1]) for f, k in (data.steps, (force, stiffness))]
    expected = 1 / (1 + INDENTER.hurst)
    yield Verdict(
        "the stepped body follows k ~ F^(1/(1 + H))",
        "k_n ∝ F_n^(1/(1+H))",
        "eq. 4.24",
        f"{exponent:.4f} between the last two steps of the rings, {expected:.4f} by the law",
        exactly(bool(abs(exponent - expected) < 0.005 * expected), "0.5%", f"{exponent / expected - 1:+.2%}"),
        "method",
    )
    yield Verdict(
        "the force is mainly the last cylinder's stiffness times its height",
        "The corresponding force at each spot consists mainly of the stiffness of the last cylinder times the height "
        "of this last cylinder",
        "section 4.4.1, eq. 4.23",
        f"k_n h_n is {shares[0]:.0%} of the force of the staircase and {shares[1]:.0%} of that of the rings, after "
        f"{COUNT} steps and ever after",
        exactly(bool(shares[1] > 0.5), "more than half"),
        "method",
    )
