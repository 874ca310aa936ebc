"""The loads that commands take, as options and in SI units."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, ClassVar

from roughcontact.cli import options
from roughcontact.cli.messages import UsageError
from roughcontact.cli.option_groups import option
from roughcontact.cli.profile_options import ProfileBody, kinds_of
from roughcontact.cli.unit_options import LENGTH, parse, parse_load, parse_loads, parse_path

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

__all__ = ["Load", "Loads"]


@dataclass(frozen=True, slots=True)
class Load:
    """One load, as the user gave it."""

    PANEL: ClassVar = "Load (one of them)"
    force: str | None = option("Normal force.", "10N")
    pressure: str | None = option("Nominal pressure: force over area.", "1MPa")
    depth: str | None = option(
        "Indentation depth: approach since first touch; with --work also negative.", "1um"
    )

    def value(self, body: ProfileBody | None) -> dict[str, float]:
        """Return the load in SI units, by its name."""
        given = asdict(self)
        name = options.only_one(given, "one load")
        return {name: parse_load(given[name], kinds_of(body)[name], f"--{name}")}

    def signed(self, body: ProfileBody | None) -> dict[str, float]:
        """Return a depth of either sign or a force of at least 0, of surfaces that stick."""
        given = asdict(self)
        name = options.only_one(given, "one load")
        if name == "pressure":
            raise UsageError(
                "--pressure does not go with --work: give --force, pressure times area, or --depth"
            )
        value = parse(given[name], kinds_of(body)[name], f"--{name}")
        if name == "force" and value < 0:
            raise UsageError(
                f"--force {given[name]} pulls, and a press is the end of an approach: a tension comes on the way back; "
                f"give 'curve --forces 0N,{given[name]}'"
            )
        return {name: value}


@dataclass(frozen=True, slots=True)
class Loads:
    """Loads, as the user gave them: rising, with adhesion of either sign, up and down."""

    PANEL: ClassVar = "Loads (at most one of them)"
    forces: str | None = option(
        "Normal forces: from:to:count, evenly spaced in the logarithm, or a comma list "
        "(default, if no loads are named: 24 forces that suit the surface, found by a search).",
        "1N:100N:30",
    )
    pressures: str | None = option("Nominal pressures, likewise.", "1kPa:1MPa:100")
    depths: str | None = option(
        "Indentation depths since first touch, likewise. With --work depths and forces go up and down and may be "
        "negative, and from:to:count is evenly spaced; with --work and --loop one depth, where it turns.",
        "1nm:1um:100",
    )
    mean_gaps: str | None = option(
        "Mean gaps of surfaces that stick (--work), on whole periodic maps, likewise.", "100nm:20nm:9"
    )

    def values(self, body: ProfileBody | None) -> tuple[str, npt.NDArray[np.float64] | None]:
        """Return what the loads are, and their values in SI units; None where they were left out.

        Raises
        ------
        UsageError
            If several are named, or their text is none.
        ValueError
            If they are mean gaps.
        """
        given = asdict(self)
        if (gaps := given.pop("mean_gaps")) is not None:
            from roughcontact.contact.mean_gaps import refuse_gaps

            refuse_gaps(parse_path(gaps, LENGTH, "--mean-gaps"))
        if not any(text is not None for text in given.values()):
            return "forces", None
        name = options.only_one(given, "the loads")
        return name, parse_loads(given[name], kinds_of(body)[name.removesuffix("s")], f"--{name}")

    def path(self, body: ProfileBody | None) -> tuple[str, npt.NDArray[np.float64]]:
        """Return what the loads of surfaces that stick are, and their values: of either sign, up and down.

        Raises
        ------
        UsageError
            If they are pressures, or none are named: no search finds them.
        """
        if self.pressures is not None:
            raise UsageError(
                "--pressures does not go with --work: give --forces, pressures times area, or --depths"
            )
        given = {"depths": self.depths, "forces": self.forces, "mean-gaps": self.mean_gaps}
        option = options.only_one(given, "the loads of surfaces that stick")
        name, text = option.replace("-", "_"), given[option]
        assert text is not None
        return name, parse_path(text, kinds_of(body)[name.removesuffix("s")], f"--{option}")
