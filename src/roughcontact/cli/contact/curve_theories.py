"""Theories beside a computed curve."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from roughcontact.cli.report import quantity
from roughcontact.errors import InputError

if TYPE_CHECKING:
    from roughcontact.contact.compare import Comparison
    from roughcontact.contact.curve import Curve
    from roughcontact.materials import Modulus
    from roughcontact.recipe.outputs import Theories
    from roughcontact.surface.surface import Surface
    from roughcontact.theory.law import LoadingLaw

__all__ = ["TheoriesOf", "deviations", "exponents", "parameters", "theories_of"]

# Name and unit of each number that a theory takes from the heights where the user gives none.
_TAKEN = {
    "hurst": ("H (fitted)", ""),
    "rms": ("rms height", "m"),
    "rolloff": ("roll-off (the side)", "m"),
    "rms_slope": ("rms slope", ""),
    **{"m0": ("m0", "m²"), "m2": ("m2", ""), "m4": ("m4", "1/m²")},
}


@dataclass(frozen=True, slots=True)
class TheoriesOf:
    """Theories of a surface.

    Parameters
    ----------
    laws : mapping of str to LoadingLaw
        By the names in the job.
    taken : mapping of str to float
        The numbers that they take from the surface, in SI units.
    refused : mapping of str to str
        Why other theories do not apply to it.
    """

    laws: Mapping[str, LoadingLaw]
    taken: Mapping[str, float]
    refused: Mapping[str, str]


def theories_of(asked: Theories, surface: Surface, modulus: Modulus, hardness: float | None) -> TheoriesOf:
    """Return the theories of the job, as far as they apply to a surface.

    Raises
    ------
    InputError
        If a theory needs a number that only the user can give.
    """
    if not (names := asked.names()):
        return TheoriesOf({}, {}, {})
    import roughcontact as rc
    from roughcontact.evaluation.theories import inputs_for
    from roughcontact.theory.laws import LAWS

    known = asked.known() | ({} if hardness is None else {"hardness": hardness})
    inputs: dict[str, Any] = known
    laws: dict[str, LoadingLaw] = {}
    refused: dict[str, str] = {}
    for name in names:
        try:
            inputs = inputs_for(surface, [name], **inputs)
            [laws[name]] = rc.loading_laws(surface, modulus, name, **inputs)
        except InputError as error:
            refused[name] = str(error)
    needed = {need for name in laws for need in LAWS[name].needs}
    new = [name for name in _TAKEN if name in (inputs.keys() - known.keys()) & needed]
    taken: dict[str, float] = {name: inputs[name] for name in new}
    if needed & {"spectrum", "moments"}:
        taken |= {name: getattr(inputs["spectrum"], name) for name in ("rms_slope", "m0", "m2", "m4")}
    return TheoriesOf(laws, taken, refused)


def parameters(taken: Mapping[str, float]) -> list[tuple[str, str]]:
    """Return a line with the numbers that theories take from the surface; no line if they take none."""
    words = []
    for name, value in taken.items():
        label, unit = _TAKEN[name]
        shown = quantity("lengths", value) if unit == "m" else f"{value:.4g} {unit}".rstrip()
        words.append(f"{label} {shown}")
    return [("from the surface", ", ".join(words))] if words else []


def deviations(comparisons: Mapping[str, Comparison]) -> list[tuple[str, str]]:
    """Return one line for each theory: its error factor over the resolved loads."""
    lines = [(comparison.name, comparison.words()) for comparison in comparisons.values()]
    return [("theories", "root mean square of ln(predicted/computed) over the resolved loads"), *lines]


def exponents(curve: Curve, comparisons: Mapping[str, Comparison]) -> list[tuple[str, str]]:
    """Return one line for each window of forces: the local exponent of the stiffness, and those of theories."""
    theirs = {
        comparison.name: {each.window: law for each, law in comparison.local_exponents("stiffness")}
        for comparison in comparisons.values()
        if "stiffness" in comparison.predicted
    }
    lines: list[tuple[str, str]] = []
    for each in curve.local_exponents():
        low, high = (quantity("force", end, curve.geometry) for end in each.window)
        words = [f"{each.exponent:.3f} +- {each.error:.3f} from {low} to {high} ({each.count} loads)"]
        for name, laws in theirs.items():
            if (law := laws[each.window]) is not None:
                words.append(f"{name} {law.exponent:.3f}")
        lines.append(("" if lines else "exponent of k", "; ".join(words)))
    return lines
