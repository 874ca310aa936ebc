"""Outputs beside the numbers of a contact: theories, errors, tables for other programs, units."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any, ClassVar

from roughcontact.errors import InputError
from roughcontact.files import quantity
from roughcontact.files.quantity import AREA, LENGTH, PRESSURE, STIFFNESS_PER_AREA, Kind
from roughcontact.recipe.bodies import Bodies
from roughcontact.recipe.job_calls import Call, Name
from roughcontact.recipe.recipe_fields import check, described, value_of
from roughcontact.recipe.texts import Amount, Choice, Names, PureNumber

__all__ = [
    "OUTPUTS",
    "TABLES",
    "THEORIES",
    "Errors",
    "InterfaceTables",
    "PressureTheory",
    "Theories",
    "Units",
]

# Those of `theory.laws`, which imports NumPy: help and completion must be fast.
THEORIES = (
    *("persson", "finite-size", "gw", "gw-exponential", "bgt", "cgp", "mikic", "cmy", "ceb", "kogut-etsion"),
    *("persson-plastic", "pullen-williamson", "power-law", "rough-square-interior", "rough-square-period"),
    *("rough-square-patch", "hertz", "rough-sphere"),
)
TABLES = ("csv", "abaqus", "abaqus-mm", "calculix", "calculix-mm", "lammps", "moose", "text")
_LENGTH = Amount(LENGTH)


@dataclass(frozen=True, slots=True, kw_only=True)
class Theories:
    """Theories to overlay on a curve."""

    TITLE: ClassVar = "Theories"
    theory: str | None = described(
        f"Theories to overlay on the curve: {', '.join(THEORIES)}. They take spectrum and moments from the surface; "
        "these numbers are printed.",
        "persson,gw,...",
        read=Names("theory", THEORIES),
        needs_whole=True,
        everyday=True,
    )
    hurst: str | None = described(
        "Hurst exponent for theories (default: fitted to the spectrum).",
        "0.8",
        read=PureNumber(-1, 3, "the Hurst exponent", "0.8"),
        needs="theory",
    )
    rolloff: str | None = described(
        "Roll-off wavelength for the theory finite-size.", "20um", read=_LENGTH, needs="theory"
    )
    radius: str | None = described(
        "Radius of curvature for the theories hertz and rough-sphere.", "5mm", read=_LENGTH, needs="theory"
    )

    def __post_init__(self) -> None:
        check(self)

    def names(self) -> tuple[str, ...]:
        """Return the names of the theories."""
        return value_of(self, "theory") or ()

    def known(self) -> dict[str, float]:
        """Return the numbers that the user gives in place of those of the surface."""
        found = {name: value_of(self, name) for name in ("hurst", "rolloff", "radius")}
        return {name: value for name, value in found.items() if value is not None}


@dataclass(frozen=True, slots=True, kw_only=True)
class PressureTheory:
    """A theory for one load."""

    TITLE: ClassVar = "Theories"
    theory: str | None = described(
        "Draw the distribution of pressure together with that of a theory.",
        read=Choice(("persson",)),
        needs_whole=True,
    )

    def __post_init__(self) -> None:
        check(self)


@dataclass(frozen=True, slots=True, kw_only=True)
class Errors:
    """Errors of the numbers, and the bandwidth of the instrument."""

    TITLE: ClassVar = "Errors"
    errors: bool = described(
        "Estimate the error of every number and its sources: half the cells, no short waves, other levelling, other "
        "maps. This takes as long as three or four more loads. For a curve: at its first and last resolved load.",
        default=False,
        needs_whole=True,
    )
    shortest_wave: str | None = described(
        "The shortest wave that the instrument records (default: four cells).",
        "5um",
        read=Amount(LENGTH, "a wavelength"),
        needs="errors",
    )
    noise: str | None = described(
        "Rms noise of one height of the map, for its share of the errors; needs a force or a pressure. This takes as "
        "long as about thirty more loads.",
        "3nm",
        read=Amount(LENGTH, "an rms noise"),
        needs="errors",
    )
    noise_length: str | None = described(
        "Distance at which the correlation of the noise is 1/e (default: 0, the noise of all cells is independent).",
        "2um",
        read=Amount(LENGTH, "a correlation length"),
        needs="noise",
    )

    def __post_init__(self) -> None:
        check(self)

    def call(self) -> Call:
        """Return the call that estimates the errors of a solution."""
        named: dict[str, Any] = {"short_cutoff": value_of(self, "shortest_wave")}
        if self.noise is not None:
            size = {
                "rms": value_of(self, "noise"),
                "correlation_length": value_of(self, "noise_length") or 0.0,
            }
            named["noise"] = Call("rc.Noise", (), size)
        asked = {name: value for name, value in named.items() if value is not None}
        return Call("rc.error_budget", (Name("solution"),), asked, result="budget", place="budget")


@dataclass(frozen=True, slots=True, kw_only=True)
class InterfaceTables:
    """Tables of the interface for other programs."""

    TITLE: ClassVar = "Tables"
    table: str | None = described(
        "Write tables of pressure, stiffness and area against gap, per nominal area, for other programs: "
        "csv, abaqus (SI), abaqus-mm (mm, N, MPa), calculix (SI), calculix-mm (mm, N, MPa), lammps, moose, text.",
        "abaqus,lammps,...",
        read=Names("table", TABLES),
        needs_whole=True,
    )
    table_area: str | None = described(
        "Nominal area for the forces in a table for LAMMPS (default: area of the map).",
        "1mm^2",
        read=Amount(AREA),
        needs="table",
    )
    friction: str | None = described(
        "Coefficient of friction in the tables for Abaqus and CalculiX; the tables csv, moose and text get a column "
        "for the tangential stiffness per area, which follows from both bodies.",
        "0.3",
        read=PureNumber(0, 10, "the coefficient of friction", "0.3", ends=False),
        needs="table",
    )

    def __post_init__(self) -> None:
        check(self)
        if self.friction is not None and self.names() == ("lammps",):
            raise InputError(
                "`friction` is for other tables than lammps, which is of normal forces",
                "leave it out",
                "friction",
            )
        if self.table_area is not None and "lammps" not in self.names():
            raise InputError(
                "`table_area` is for the table lammps: all other tables are per area",
                "leave it out",
                "table_area",
            )

    def names(self) -> tuple[str, ...]:
        """Return the names of the tables."""
        return value_of(self, "table") or ()

    def require(self, bodies: Bodies) -> None:
        """Raise an error if a friction is given without the elastic constants of the bodies."""
        if self.friction is not None and not bodies.elastic():
            raise InputError(
                "`friction` needs the bodies: E* does not determine how they shear",
                "name both by `materials`, such as steel,aluminium",
                "tables.friction",
            )

    def calls(self, curve: str, bodies: Bodies, conducting: Mapping[str, Any]) -> Iterator[Call]:
        """Yield the call that returns the table of a curve, if the job names one."""
        if self.names():
            named = {**conducting, "area": value_of(self, "table_area")}
            if self.friction is not None:
                named |= {"bodies": bodies.elastic(), "friction": value_of(self, "friction")}
            given = {name: value for name, value in named.items() if value is not None}
            yield Call("rc.interface_table", (Name(curve),), given, result="table", place="table")


def _unit(kind: Kind) -> Callable[[str], float]:
    """Return a reader of units of a kind, which returns their value in SI."""
    example = kind.example.lstrip("0123456789")

    def read(text: str) -> float:
        refusal = InputError(f"{text!r} is not a unit of {kind.name}", f"give one such as {example}")
        if not text.strip():
            raise refusal
        try:
            return quantity.parse(f"1 {text}", kind)
        except ValueError as error:
            raise refusal from error

    return read


@dataclass(frozen=True, slots=True, kw_only=True)
class Units:
    """Units of numbers per area: in print, and in picture, CSV and NetCDF of a curve."""

    TITLE: ClassVar = "Units"
    unit_stiffness: str | None = described(
        "Unit of the interfacial stiffness per area K/A0 in print, and in picture, CSV and NetCDF of a curve "
        "(default: N/um/mm^2, in CSV and NetCDF Pa/m).",
        "N/um/mm^2",
        read=_unit(STIFFNESS_PER_AREA),
    )
    unit_pressure: str | None = described(
        "Unit of the nominal pressure in the same places (default: with a suitable prefix, in CSV and NetCDF Pa).",
        "MPa",
        read=_unit(PRESSURE),
    )

    def __post_init__(self) -> None:
        check(self)


OUTPUTS = (Errors, PressureTheory, InterfaceTables, Theories, Units)
"""The parts of a job for its output: no state depends on them."""
