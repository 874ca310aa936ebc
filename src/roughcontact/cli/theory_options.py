"""The options that overlay theories on a computed curve."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from roughcontact.cli.messages import UsageError
from roughcontact.cli.option_groups import option
from roughcontact.cli.report import quantity
from roughcontact.cli.unit_options import LENGTH, parse, parse_number

if TYPE_CHECKING:
    from roughcontact.contact.compare import Comparison
    from roughcontact.surface.surface import Surface
    from roughcontact.theory.law import LoadingLaw

__all__ = ["Theories", "deviations", "parameters"]

# In words and units: what a theory takes from the heights where the user does not say it.
_TAKEN = {
    "hurst": ("H (fitted)", ""),
    "rms": ("rms height", "m"),
    "rolloff": ("roll-off (the side)", "m"),
    "rms_slope": ("rms slope", ""),
    **{"m0": ("m0", "m²"), "m2": ("m2", ""), "m4": ("m4", "1/m²")},
}


@dataclass(frozen=True, slots=True)
class Theories:
    """Theories to overlay on a curve, as the user gave them."""

    PANEL: ClassVar = "Theories"
    theory: str | None = option(
        "Theories to overlay on the curve: persson, finite-size, gw, gw-exponential, bgt, cgp, power-law, hertz, "
        "rough-sphere. They take spectrum and moments from the surface, and say which.",
        "persson,gw,...",
    )
    hurst: str | None = option("Hurst exponent, for theories (default: fitted).", "0.8")
    rolloff: str | None = option("Roll-off wavelength, for finite-size.", "20um")
    radius: str | None = option("Radius of curvature, for hertz and rough-sphere.", "5mm")

    def check(self) -> None:
        """Raise a `UsageError` for what makes no sense, before anything is computed."""
        self.checked()
        self.knowns()

    def checked(self) -> tuple[str, ...]:
        """Return the names of the theories.

        Raises
        ------
        UsageError
            If one does not exist, or is named twice, or something is said about theories and none is named.
        """
        from roughcontact.theory.laws import LAWS

        if self.theory is None:
            said = {"--hurst": self.hurst, "--rolloff": self.rolloff, "--radius": self.radius}
            for option, value in said.items():
                if value is not None:
                    raise UsageError(f"{option} is for theories: name them, such as --theory persson,gw")
            return ()
        names = tuple(part.strip() for part in self.theory.split(",") if part.strip())
        for name in names:
            if name not in LAWS:
                raise UsageError(f"--theory: there is no {name!r}; there are {', '.join(LAWS)}")
        if not names or len(set(names)) < len(names):
            raise UsageError(f"--theory: name each theory once, such as persson,gw, not {self.theory!r}")
        return names

    def knowns(self) -> dict[str, float]:
        """Return what the user knows better than the surface."""
        lengths = {"rolloff": self.rolloff, "radius": self.radius}
        known = {name: parse(text, LENGTH, f"--{name}") for name, text in lengths.items() if text is not None}
        return known if self.hurst is None else known | {"hurst": parse_number(self.hurst, "--hurst", "0.8")}

    def laws(self, surface: Surface, modulus: float) -> tuple[dict[str, LoadingLaw], dict[str, float]]:
        """Return the theories of a surface by the names they were asked for, and the numbers they took from it."""
        import roughcontact as rc
        from roughcontact.contact.theories import facts_for
        from roughcontact.theory.laws import LAWS

        names = self.checked()
        if not names:
            return {}, {}
        for name in names:
            if "radius" in LAWS[name].needs and self.radius is None:
                raise UsageError(
                    f"--theory {name}: give the radius of curvature by --radius, such as --radius 5mm"
                )
        known = self.knowns()
        facts = facts_for(surface, names, **known)
        new = [name for name in _TAKEN if name in facts.keys() - known.keys()]
        taken: dict[str, float] = {name: facts[name] for name in new}
        if "spectrum" in facts:
            taken |= {name: getattr(facts["spectrum"], name) for name in ("rms_slope", "m0", "m2", "m4")}
        return dict(zip(names, rc.loading_laws(surface, modulus, names, **facts), strict=True)), taken


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
