"""The loads on a surface: one load, increasing loads, or loads up and down."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any, ClassVar

from roughcontact.errors import InputError, placed
from roughcontact.files.quantity import FORCE, FORCE_PER_LENGTH, LENGTH, PRESSURE, Kind
from roughcontact.recipe.job_calls import Call
from roughcontact.recipe.recipe_fields import check, described, given
from roughcontact.recipe.texts import Amount, linear_loads, rising_loads

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

__all__ = [
    *("AdhesiveLoad", "AdhesiveLoads", "FallingLoads", "OneLoad"),
    *("RisingLoads", "kinds_of", "numbers", "one_load"),
]


def kinds_of(profile: str | None) -> dict[str, Kind]:
    """Return the kinds of force, pressure, depth and mean gap, by their names.

    Forces of a line contact are per unit length across the profile. On springs, the force is a force, and the
    pressure a force per length.
    """
    kinds = {"force": FORCE, "pressure": PRESSURE, "depth": LENGTH, "mean_gap": LENGTH}
    if profile == "line":
        return kinds | {"force": FORCE_PER_LENGTH}
    return kinds if profile is None else kinds | {"pressure": replace(FORCE_PER_LENGTH, example="1N/mm")}


def _of(part: Any) -> tuple[str, str] | None:
    """Return name and text of the one load that is given."""
    found = given(part)
    return next(iter(found.items())) if found else None


def one_load(text: str, kind: Kind, name: str) -> float:
    """Return one load in SI: a force or pressure above 0, a depth of at least 0."""
    if kind is LENGTH:
        with placed(name):
            value = Amount(kind, positive=False)(text)
            if value < 0:
                raise InputError(
                    f"the depth is measured from first touch, and {text!r} is negative", "give 0 or more"
                )
            return value
    with placed(name):
        return Amount(kind)(text)


@dataclass(frozen=True, slots=True, kw_only=True)
class OneLoad:
    """One load."""

    TITLE: ClassVar = "Load (one of them)"
    ONE_OF: ClassVar = ("force", "pressure", "depth")
    force: str | None = described("Normal force.", "10N", everyday=True)
    pressure: str | None = described("Nominal pressure: force over area.", "1MPa", everyday=True)
    depth: str | None = described("Indentation depth: approach since first touch.", "1um", everyday=True)

    def __post_init__(self) -> None:
        check(self)

    def named(self, profile: str | None) -> dict[str, float]:
        """Return the load in SI, by the name of its argument."""
        [(name, text)] = given(self).items()
        return {name: one_load(text, kinds_of(profile)[name], name)}


@dataclass(frozen=True, slots=True, kw_only=True)
class RisingLoads:
    """Increasing loads; by default, a search finds forces that suit the surface."""

    TITLE: ClassVar = "Loads (at most one of them)"
    AT_MOST: ClassVar = ("forces", "pressures", "depths")
    forces: str | None = described(
        "Normal forces: from:to:count with equal ratios, or a comma list "
        "(default, if no loads are given: a search finds 24 forces that suit the surface).",
        "1N:100N:30",
        everyday=True,
    )
    pressures: str | None = described("Nominal pressures, in the same form.", "1kPa:1MPa:100", everyday=True)
    depths: str | None = described(
        "Indentation depths since first touch, in the same form.", "1nm:1um:100", everyday=True
    )

    def __post_init__(self) -> None:
        check(self)

    def named(self, profile: str | None) -> dict[str, Call | list[float]]:
        """Return the loads in SI, by the name of their argument; empty if a search must find them."""
        if (found := _of(self)) is None:
            return {}
        name, text = found
        with placed(name):
            return {name: rising_loads(text, kinds_of(profile)[name.removesuffix("s")])}


@dataclass(frozen=True, slots=True, kw_only=True)
class AdhesiveLoad:
    """One load of adhesive surfaces."""

    TITLE: ClassVar = OneLoad.TITLE
    ONE_OF: ClassVar = ("force", "pressure", "depth", "mean_gap")
    force: str | None = described("Normal force, 0 or more.", "10mN", everyday=True)
    pressure: str | None = described("Nominal pressure (force over area), 0 or more.", "1kPa", everyday=True)
    depth: str | None = described(
        "Indentation depth: approach since first touch; negative where the undeformed surfaces are apart.",
        "-2nm",
        everyday=True,
    )
    mean_gap: str | None = described("Mean gap, on a periodic map without missing points.", "100nm")

    def __post_init__(self) -> None:
        check(self)

    def named(self, profile: str | None) -> dict[str, float]:
        """Return the load in SI, by the name of its argument."""
        [(name, text)] = given(self).items()
        with placed(name):
            value = Amount(kinds_of(profile)[name], "the mean gap", positive=name == "mean_gap")(text)
            if name in ("force", "pressure") and value < 0:
                raise InputError(
                    f"{text} is a tension, which needs a retreat, but one state is the end of an approach",
                    f"compute an adhesion curve with `{name}s` 0,{text}",
                )
        return {name: value}


@dataclass(frozen=True, slots=True, kw_only=True)
class AdhesiveLoads:
    """Loads of adhesive surfaces, of either sign, up and down."""

    TITLE: ClassVar = "Loads (one of them)"
    ONE_OF: ClassVar = ("depths", "forces", "pressures", "mean_gaps")
    depths: str | None = described(
        "Indentation depths since first touch, up and down, of either sign: a comma list of values and of ranges "
        "from:to:count, evenly spaced.",
        "-20nm:20nm:9,-20nm",
        everyday=True,
    )
    forces: str | None = described(
        "Normal forces, in the same form; the first is 0 or more.", "0N,1mN,-1mN", everyday=True
    )
    pressures: str | None = described(
        "Nominal pressures, in the same form; the first is 0 or more.", "0Pa,1kPa,-1kPa", everyday=True
    )
    mean_gaps: str | None = described(
        "Mean gaps, on a periodic map without missing points, in the same form.", "100nm:20nm:9"
    )

    def __post_init__(self) -> None:
        check(self)

    def named(self, profile: str | None) -> dict[str, list[float]]:
        """Return the loads in SI, by the name of their argument."""
        found = _up_and_down(self, profile)
        [(name, loads)] = found.items()
        with placed(name):
            if name in ("forces", "pressures") and loads[0] < 0:
                raise InputError(
                    f"a path begins with an approach, not with the tension {loads[0]:g}",
                    "begin with 0, followed by the tension",
                )
            if name == "mean_gaps" and min(loads) <= 0:
                raise InputError(
                    f"a mean gap of {min(loads):g} m is full contact or beyond it",
                    "give mean gaps such as 100nm",
                )
        return found


@dataclass(frozen=True, slots=True, kw_only=True)
class FallingLoads:
    """Loads of the retreat from a larger load; by default, it ends when no cell is in contact."""

    TITLE: ClassVar = "Retreat (at most one of them)"
    AT_MOST: ClassVar = ("depths", "forces", "pressures")
    depths: str | None = described(
        "Decreasing indentation depths, of either sign: a comma list of values and of ranges from:to:count, evenly "
        "spaced (default: until no cell is in contact).",
        "50nm:-50nm:11",
        everyday=True,
    )
    forces: str | None = described(
        "Decreasing normal forces, in the same form.", "1mN,0N,-1mN", everyday=True
    )
    pressures: str | None = described(
        "Decreasing nominal pressures, in the same form.", "1kPa,0Pa,-1kPa", everyday=True
    )

    def __post_init__(self) -> None:
        check(self)

    def named(self, profile: str | None) -> dict[str, list[float]]:
        """Return the loads in SI, by the name of their argument; empty if they are left out."""
        found = _up_and_down(self, profile)
        for name, loads in found.items():
            for before, after in pairwise(loads):
                if after > before:
                    raise InputError(
                        f"the {name} of a retreat must decrease, but {after:g} follows {before:g}",
                        "leave it out, or compute an adhesion curve",
                        name,
                    )
        return found


def _up_and_down(part: AdhesiveLoads | FallingLoads, profile: str | None) -> dict[str, list[float]]:
    if (found := _of(part)) is None:
        return {}
    name, text = found
    with placed(name):
        return {name: linear_loads(text, kinds_of(profile)[name.removesuffix("s")])}


def numbers(named: Mapping[str, Any]) -> npt.NDArray[np.float64]:
    """Return the loads of arguments, shape (n,)."""
    import numpy as np

    [loads] = named.values()
    return np.atleast_1d(np.asarray(loads.value({"np": np}) if isinstance(loads, Call) else loads))
