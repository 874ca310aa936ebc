"""The options that overlay theories on a computed curve."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from roughcontact.cli.messages import UsageError
from roughcontact.cli.option_groups import option
from roughcontact.cli.report import quantity
from roughcontact.cli.unit_options import LENGTH, parse, parse_number
from roughcontact.errors import InputError

if TYPE_CHECKING:
    from roughcontact.contact.compare import Comparison
    from roughcontact.contact.curve import Curve
    from roughcontact.surface.surface import Surface
    from roughcontact.theory.law import LoadingLaw

__all__ = ["Theories", "deviations", "exponents", "parameters"]

# In words and units: what a theory takes from the heights where the user does not say it.
_TAKEN = {
    "hurst": ("H (fitted)", ""),
    "rms": ("rms height", "m"),
    "rolloff": ("roll-off (the side)", "m"),
    "rms_slope": ("rms slope", ""),
    **{"m0": ("m0", "m²"), "m2": ("m2", ""), "m4": ("m4", "1/m²")},
}
# What no surface shows, in words, with an example.
_ONLY_GIVEN = {"radius": ("radius of curvature", "5mm"), "hardness": ("hardness", "2GPa or aluminium")}


@dataclass(frozen=True, slots=True)
class Theories:
    """Theories to overlay on a curve, as the user gave them."""

    PANEL: ClassVar = "Theories"
    theory: str | None = option(
        "Theories to overlay on the curve: persson, finite-size, gw, gw-exponential, bgt, cgp, mikic, cmy, ceb, "
        "kogut-etsion, persson-plastic, pullen-williamson, power-law, rough-square, hertz, rough-sphere. They take "
        "spectrum and moments from the surface, and say which.",
        "persson,gw,...",
        needs_whole=True,
    )
    hurst: str | None = option("Hurst exponent, for theories (default: fitted).", "0.8")
    rolloff: str | None = option("Roll-off wavelength, for finite-size.", "20um")
    radius: str | None = option("Radius of curvature, for hertz and rough-sphere.", "5mm")

    def check(self) -> None:
        """Raise a `UsageError` for what makes no sense, before anything is computed."""
        self.checked()
        self.given()

    def checked(self) -> tuple[str, ...]:
        """Return the names of the theories.

        Raises
        ------
        UsageError
            If one does not exist, or is named twice, or something is said about theories and none is named.
        """
        if self.theory is None:
            said = {"--hurst": self.hurst, "--rolloff": self.rolloff, "--radius": self.radius}
            for option, value in said.items():
                if value is not None:
                    raise UsageError(
                        f"{option} is for theories", "name them, such as --theory persson,gw", place=option
                    )
            return ()
        from roughcontact.theory.laws import LAWS

        names = tuple(part.strip() for part in self.theory.split(",") if part.strip())
        for name in names:
            if name not in LAWS:
                raise UsageError(f"there is no {name!r}; there are {', '.join(LAWS)}", place="--theory")
        if not names or len(set(names)) < len(names):
            raise UsageError(
                f"{self.theory!r} names no theory, or one twice",
                "name each theory once, such as persson,gw",
                place="--theory",
            )
        return names

    def given(self) -> dict[str, float]:
        """Return what the user knows better than the surface.

        Raises
        ------
        UsageError
            If it makes no sense of any surface.
        """
        lengths = {"rolloff": self.rolloff, "radius": self.radius}
        known = {name: parse(text, LENGTH, f"--{name}") for name, text in lengths.items() if text is not None}
        if self.hurst is None:
            return known
        hurst = parse_number(self.hurst, "--hurst", "0.8")
        if not -1 <= hurst <= 3:
            raise UsageError(
                f"the Hurst exponent lies between -1 and 3, not at {self.hurst!r}", place="--hurst"
            )
        return known | {"hurst": hurst}

    def laws(
        self, surface: Surface, modulus: float, hardness: float | None
    ) -> tuple[dict[str, LoadingLaw], dict[str, float], dict[str, str]]:
        """Return the theories of a surface, the numbers they took from it, and why others do not apply to it.

        All by the names that they were asked for.

        Raises
        ------
        UsageError
            If a theory needs a number that only the user can give.
        """
        if not (names := self.checked()):
            return {}, {}, {}
        import roughcontact as rc
        from roughcontact.evaluation.theories import inputs_for
        from roughcontact.theory.laws import LAWS

        known = self.given() | ({} if hardness is None else {"hardness": hardness})
        for name in names:
            for need, (what, example) in _ONLY_GIVEN.items():
                if need in LAWS[name].needs and need not in known:
                    raise UsageError(
                        f"--theory {name} lacks a number",
                        f"give the {what} by --{need}, such as --{need} {example}",
                        place=f"--{need}",
                    )
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
        return laws, taken, refused


def parameters(taken: Mapping[str, float]) -> list[tuple[str, str]]:
    """Return the line that states what theories took from the surface; none where they took nothing."""
    words = []
    for name, value in taken.items():
        label, unit = _TAKEN[name]
        shown = quantity("lengths", value) if unit == "m" else f"{value:.4g} {unit}".rstrip()
        words.append(f"{label} {shown}")
    return [("from the surface", ", ".join(words))] if words else []


def deviations(comparisons: Mapping[str, Comparison]) -> list[tuple[str, str]]:
    """Return one line for each theory: by what factor it lies off where the curve is resolved."""
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
