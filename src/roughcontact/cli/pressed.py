"""The kind of a map, and whether its asperities stay elastic."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from roughcontact.cli.messages import note
from roughcontact.cli.report import quantity
from roughcontact.errors import InputError

if TYPE_CHECKING:
    from roughcontact.contact.loads.load_search import SurfaceKind
    from roughcontact.materials import Modulus
    from roughcontact.surface.surface import Surface
    from roughcontact.theory.plastic_asperities.plasticity import PlasticityIndex

__all__ = ["Pressed"]

_SUMMITS = 2  # fewer are those of a body, which has no plasticity index


@dataclass(frozen=True, slots=True)
class Pressed:
    """The properties of a surface that a contact depends on.

    Parameters
    ----------
    kind : SurfaceKind
        Periodic, nominally flat, with form, or a profile.
    words : str
        The kind in words.
    index : PlasticityIndex or None
        The index of Greenwood and Williamson, if a hardness is known.
    softer : (float, str) or None
        The hardness [Pa] and its origin.
    """

    kind: SurfaceKind
    words: str
    index: PlasticityIndex | None
    softer: tuple[float, str] | None

    @classmethod
    def of(cls, surface: Surface, modulus: Modulus, softer: tuple[float, str] | None) -> Pressed:
        """Return the kind of a surface; print a note if a known hardness gives no index."""
        from roughcontact.arrays import is_numpy
        from roughcontact.contact.loads.load_search import SurfaceKind

        kind = SurfaceKind.of(surface)
        if not is_numpy(surface.heights):  # summits are only searched for in NumPy arrays
            softer = None
        if surface.grid.ndim == 1:  # a profile has no summits
            return cls(kind, "a periodic profile" if all(surface.grid.periodic) else "a profile", None, None)
        return cls(kind, kind.value, None if softer is None else _index(surface, modulus, softer[0]), softer)

    def facts(self) -> list[tuple[str, str]]:
        """Return the facts, line by line."""
        lines = [("kind of surface", self.words)]
        if self.index is not None and self.softer is not None:
            index, of = self.index, f"{quantity('hardness', self.softer[0])} {self.softer[1]}"
            flow = "; --hardness computes the flow" if index.value > index.plastic_above else ""
            lines.append(
                (
                    "plasticity index",
                    f"{index.value:.3g}, {index.regime} (elastic below {index.elastic_below:g}, plastic above "
                    f"{index.plastic_above:g}; Greenwood and Williamson, hardness {of}; "
                    f"a measure of the summits, not of this load){flow}",
                )
            )
        return lines

    def record(self) -> dict[str, Any]:
        """Return the facts as plain values."""
        if self.index is None or self.softer is None:
            return {"kind": self.kind.value, "plasticity_index": None}
        return {
            "kind": self.kind.value,
            "plasticity_index": {
                "value": self.index.value,
                "regime": self.index.regime,
                "elastic_below": self.index.elastic_below,
                "plastic_above": self.index.plastic_above,
                "hardness": self.softer[0],
            },
        }


def _index(surface: Surface, modulus: Modulus, hardness: float) -> PlasticityIndex | None:
    """Return the index of the summits of a map; None, and why, where there is none."""
    import roughcontact as rc
    from roughcontact.materials import as_modulus

    try:
        flat = surface if all(surface.grid.periodic) else surface.levelled("plane")
        summits = rc.find_summits(flat)
        if len(summits.height) < _SUMMITS:
            return None  # a body, not a rough surface
        curvature, reduced = summits.mean_curvature, as_modulus(modulus)
        return rc.theory.plasticity.summit_index(summits.height, curvature, reduced, hardness)
    except InputError as error:
        note(f"no plasticity index: {error}")
        return None
