"""What a reader of the numbers of surfaces that stick should know: where their models end."""

from __future__ import annotations

from typing import Literal

from roughcontact.adhesion.attraction import Adhesion
from roughcontact.adhesion.highest_summit import SHALLOW, HighestSummit

__all__ = ["notes_on_loads", "notes_on_model", "notes_on_range"]

# Tabor's number, below which the pull-off force of a sphere by Maugis' equations (`theory.maugis`) exceeds that of
# Johnson, Kendall and Roberts by more than a tenth: lambda is 0.725 there, and 1.127 times Tabor's number.
SHORT_RANGE = 0.64


def notes_on_model(summit: HighestSummit, unresolved: bool = False) -> tuple[str, ...]:
    """Return where neither the grid nor linear elasticity describes these bodies."""
    notes = []
    if unresolved:
        notes.append(
            "Unresolved: the attraction varies from cell to cell beside a contact, so that the lattice traps every "
            "state; what jumps and sticks here is the lattice, not the body."
        )
    if not summit.shallow:
        a, r = summit.unloaded_radius, summit.radius
        notes.append(
            "The contact is not small against the body: without load, the contact of Johnson, Kendall and Roberts has "
            f"a radius of {a:.3g} m, {a / r:.2g} times the radius of the highest summit, {r:.3g} m (w/(E* R) is "
            f"{summit.work / (summit.modulus * r):.2g}). Linear elasticity of half-spaces is good up to {SHALLOW:g} "
            "times that radius: take these numbers as orders of magnitude."
        )
    return tuple(notes)


def notes_on_loads(
    *, lowest: float, first: float, last: float, unit: str, control: Literal["depth", "force"], rel: float = 0
) -> tuple[str, ...]:
    """Return whether the lowest force of a retreat is that of its first or its last load: no pull-off force."""
    if lowest >= last - rel * abs(last):
        return (
            f"The retreat ends at its lowest force, {lowest:.3g} {unit}, with the surfaces still together: that is not "
            f"their pull-off force. Continue to lower {control}s until they are apart.",
        )
    if lowest >= first - rel * abs(first):
        return (
            f"The retreat begins at its lowest force, {lowest:.3g} {unit}, so that this force depends on where it "
            "begins: it is not the pull-off force. Bring the surfaces closer before you draw them back.",
        )
    return ()


def notes_on_range(summit: HighestSummit, adhesion: Adhesion) -> tuple[str, ...]:
    """Return whether a pull-off force depends on the range of the attraction."""
    number = adhesion.tabor(summit.radius, summit.modulus)
    if summit.line or number >= SHORT_RANGE:
        return ()
    return (
        f"The pull-off force depends on the range of {adhesion.range:.3g} m: Tabor's number of the highest summit is "
        f"{number:.2g}, and below {SHORT_RANGE:g} a sphere's pull-off force exceeds the limit of a vanishing range by "
        "more than a tenth. State the range with the force.",
    )
