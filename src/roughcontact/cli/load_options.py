"""The loads that commands take, as options and in SI units."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, ClassVar

from roughcontact.cli import options
from roughcontact.cli.contact.profile_options import ProfileBody, kinds_of
from roughcontact.cli.messages import UsageError
from roughcontact.cli.option_groups import flag, option
from roughcontact.cli.unit_options import Kind, parse, parse_load, parse_loads, parse_path

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from roughcontact.solver.loads import Loads

__all__ = ["AdhesiveLoad", "AdhesiveLoads", "FallingLoads", "OneLoad", "RisingLoads", "unit_of_loads"]

_PULLS = ("force", "pressure")  # of which a negative value is a tension


@dataclass(frozen=True, slots=True)
class OneLoad:
    """One load, as the user gave it."""

    PANEL: ClassVar = "Load (one of them)"
    force: str | None = option("Normal force.", "10N")
    pressure: str | None = option("Nominal pressure: force over area.", "1MPa")
    depth: str | None = option("Indentation depth: approach since first touch.", "1um")

    def value(self, body: ProfileBody | None) -> dict[str, float]:
        """Return the load in SI units, by its name."""
        given = asdict(self)
        name = options.only_one(given, "one load")
        return {name: parse_load(given[name], kinds_of(body)[name], f"--{name}")}


@dataclass(frozen=True, slots=True)
class RisingLoads:
    """Rising loads, as the user gave them."""

    PANEL: ClassVar = "Loads (at most one of them)"
    forces: str | None = option(
        "Normal forces: from:to:count, evenly spaced in the logarithm, or a comma list "
        "(default, if no loads are named: 24 forces that suit the surface, found by a search).",
        "1N:100N:30",
    )
    pressures: str | None = option("Nominal pressures, likewise.", "1kPa:1MPa:100")
    depths: str | None = option("Indentation depths since first touch, likewise.", "1nm:1um:100")

    def values(self, body: ProfileBody | None) -> Loads | None:
        """Return the loads; None where they were left out.

        Raises
        ------
        UsageError
            If several are named, or their text is none.
        """
        return None if _left_out(self) else _loads(self, parse_loads, body)


@dataclass(frozen=True, slots=True)
class AdhesiveLoad:
    """One load of surfaces that attract each other, as the user gave it."""

    PANEL: ClassVar = OneLoad.PANEL
    force: str | None = option("Normal force, 0 or more.", "10mN")
    pressure: str | None = option("Nominal pressure, 0 or more: force over area.", "1kPa")
    depth: str | None = option(
        "Indentation depth: approach since first touch; negative where the undeformed surfaces are apart.",
        "-2nm",
    )
    mean_gap: str | None = option("Mean gap, on a periodic map without missing points.", "100nm")

    def value(self, body: ProfileBody | None) -> dict[str, float]:
        """Return the load in SI units, by its name.

        Raises
        ------
        UsageError
            If it is a tension.
        """
        given = asdict(self)
        name = options.only_one(given, "one load")
        text, said = given[name], flag(name)
        value = parse(text, kinds_of(body)[name], said)
        if name in _PULLS and value < 0:
            raise UsageError(
                f"{said} {text} pulls, and this command computes an approach: a tension needs a retreat",
                f"give 'adhesion curve {said}s 0,{text}'",
            )
        return {name: value}


@dataclass(frozen=True, slots=True)
class AdhesiveLoads:
    """Loads of surfaces that attract each other, of either sign, up and down, as the user gave them."""

    PANEL: ClassVar = "Loads (one of them)"
    depths: str | None = option(
        "Indentation depths since first touch, up and down, of either sign: a comma list of values and of ranges "
        "from:to:count, evenly spaced.",
        "-20nm:20nm:9,-20nm",
    )
    forces: str | None = option("Normal forces, likewise; the first is 0 or more.", "0N,1mN,-1mN")
    pressures: str | None = option("Nominal pressures, likewise.", "0Pa,1kPa,-1kPa")
    mean_gaps: str | None = option(
        "Mean gaps, on a periodic map without missing points, likewise.", "100nm:20nm:9"
    )

    def values(self, body: ProfileBody | None) -> Loads:
        """Return the loads.

        Raises
        ------
        UsageError
            If not one kind is named, or its text is none.
        """
        return _loads(self, parse_path, body)


@dataclass(frozen=True, slots=True)
class FallingLoads:
    """Loads on the way back from a larger one, as the user gave them."""

    PANEL: ClassVar = "Retreat (at most one of them)"
    depths: str | None = option(
        "Falling indentation depths, of either sign: a comma list of values and of ranges from:to:count, evenly "
        "spaced (default: until no cell is in contact).",
        "50nm:-50nm:11",
    )
    forces: str | None = option("Falling normal forces, likewise.", "1mN,0N,-1mN")
    pressures: str | None = option("Falling nominal pressures, likewise.", "1kPa,0Pa,-1kPa")

    def values(self, body: ProfileBody | None) -> Loads | None:
        """Return the loads; None where they were left out.

        Raises
        ------
        UsageError
            If several are named, or their text is none.
        """
        return None if _left_out(self) else _loads(self, parse_path, body)


def unit_of_loads(loads: Loads, body: ProfileBody | None) -> str:
    """Return the SI unit of loads."""
    return kinds_of(body)[loads.kind.replace(" ", "_")].unit


def _left_out(given: RisingLoads | FallingLoads) -> bool:
    return all(text is None for text in asdict(given).values())


def _loads(
    group: RisingLoads | AdhesiveLoads | FallingLoads,
    parsed: Callable[[str, Kind, str], npt.NDArray[np.float64]],
    body: ProfileBody | None,
) -> Loads:
    """Return the loads of the one kind that is named."""
    from roughcontact.solver.loads import Loads

    given = asdict(group)
    name = options.only_one(given, "the loads")
    return Loads.of(**{name: parsed(given[name], kinds_of(body)[name.removesuffix("s")], flag(name))})
