"""The law of an interface as lines for Abaqus and as a table of forces for LAMMPS, and the parts of such texts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from textwrap import wrap

import numpy as np

from roughcontact.evaluation.interface_table import InterfaceTable
from roughcontact.labels.contact_columns import TANGENTIAL
from roughcontact.validation import Array

__all__ = [
    *("UNIT_SYSTEMS", "abaqus_text", "as_comments", "facts", "friction_facts", "lammps_text"),
    *("stick_slope", "unloaded"),
]

# For each system: its units in words, then the factors from SI of a pressure, a length, and a thermal and an electrical
# conductance per area. With mm, N, s and t (tonnes) stresses are in MPa and powers in mW, so that amperes require mV.
UNIT_SYSTEMS = {
    "SI": ("m, N, Pa, W/m2/K, A/V/m2", (1.0, 1.0, 1.0, 1.0)),
    "mm": ("mm, N, MPa, mW/mm2/K, A/mV/mm2", (1e-6, 1e3, 1e-3, 1e-9)),
}
_WIDTH = 120  # characters of a comment; Abaqus reads at most 256
_LINES = 1001  # of a table for LAMMPS: evenly spaced, as its interpolation requires
_OF_SPOTS, _OF_JOINT = "spots_conductance_per_area", "joint_conductance_per_area"
_GAP_CONDUCTANCES = (
    ("thermal_conductance_per_area", "*GAP CONDUCTANCE, PRESSURE"),
    (_OF_JOINT, "*GAP CONDUCTANCE, PRESSURE"),
    ("electrical_conductance_per_area", "*GAP ELECTRICAL CONDUCTANCE, PRESSURE"),
)


def abaqus_text(table: InterfaceTable, remarks: Iterable[str] = (), *, units: str = "SI") -> str:
    """Return a surface interaction for Abaqus: pressure against overclosure, friction, conductances of the gap.

    Parameters
    ----------
    table : InterfaceTable
    remarks : iterable of str
        Additional comments.
    units : {"SI", "mm"}
        Metres, newtons, pascals; or millimetres, newtons, megapascals.

    Returns
    -------
    str
        The text, with a line end at its end.
    """
    words, (stress, length, *conduction) = UNIT_SYSTEMS[units]
    head = [
        f"units: {words}",
        *facts(table, units),
        f"overclosure 0 is a mean gap of {table.zero_gap * length!r}: bodies meshed in touch carry nothing yet",
        "between two lines Abaqus interpolates linearly: at most "
        f"{table.chord_error:.2%} above a pressure that grows exponentially; beyond the last line it is straight",
    ]
    interaction = ["*SURFACE INTERACTION, NAME=ROUGH"]
    if table.friction is not None:
        slip = table.friction * table.middle_pressure / stick_slope(table)
        head += [
            *friction_facts(table, units),
            "the elastic slip of Abaqus/Standard makes the stick slope proportional to the pressure",
        ]
        interaction += [f"*FRICTION, ELASTIC SLIP={slip * length!r}", repr(table.friction)]
    lines = [*as_comments([*head, *remarks], "**"), *interaction]
    lines.append("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR")
    lines += _pairs(table.pressure * stress, table.overclosure * length)
    thermal, electrical = conduction
    for name, keyword in _GAP_CONDUCTANCES:
        if name in table.conductances:
            factor = electrical if "electrical" in name else thermal
            numbers = (table.conductances[name] * factor, table.pressure * stress)
            lines += [keyword, *_pairs(*numbers, unloaded(table, name) * factor)]
    return "\n".join(lines) + "\n"


def lammps_text(table: InterfaceTable, remarks: Iterable[str] = ()) -> str:
    """Return a table of energy and force against distance, for ``fix wall/table`` and ``pair_style table``.

    The distance is the mean gap. Between the loads the logarithm of the pressure is interpolated by monotone cubics.

    Parameters
    ----------
    table : InterfaceTable
    remarks : iterable of str
        Additional comments.

    Returns
    -------
    str
        The text, with a line end at its end.
    """
    gap, pressure, energy = _evenly(table)
    head = [
        "UNITS: si",
        *facts(table),
        f"force and energy of a nominal area of {table.area!r} m2 (r, energy, force in m, J, N)",
        f"r is the mean gap; the force begins at {table.zero_gap!r} m",
        f"the table ends at {float(gap[0])!r} m: LAMMPS stops where a wall comes nearer",
        f"fix ID group wall/table linear {len(gap)} zlo POSITION FILE INTERFACE {table.zero_gap!r}",
        *remarks,
    ]
    rows = zip(gap.tolist(), (table.area * energy).tolist(), (table.area * pressure).tolist(), strict=True)
    lines = [*as_comments(head, "#"), "", "INTERFACE", f"N {len(gap)}", ""]
    lines += [f"{k} {r!r} {e!r} {f!r}" for k, (r, e, f) in enumerate(rows, start=1)]
    return "\n".join(lines) + "\n"


def facts(table: InterfaceTable, units: str = "SI") -> Iterator[str]:
    """Yield the facts that users of a table need, with pressures in the units of a system."""
    words, (stress, *_) = UNIT_SYSTEMS[units]
    unit = words.split(", ")[2]
    low, high = (stress * each for each in table.validity)
    yield "law of a rough interface, per nominal area; the compliance of the bodies is not in it: the model has it"
    yield f"valid from {low:.6g} to {high:.6g} {unit}, {len(table)} resolved loads; below: a straight line to zero"
    kind = (
        "periodic map"
        if table.periodic
        else "free patch, which is not pressed evenly (docs/concepts/joints.md)"
    )
    if _OF_JOINT in table.conductances:
        yield "the gap conductance is that of spots, gas and radiation together; without load: of gas and radiation"
    flows = math.isfinite(table.hardness)
    body = "elastic and perfectly plastic" if flows else "elastic"
    yield f"computed on a {kind}; {body}, normal load, no friction, no adhesion"
    if flows:
        limit = f"{table.hardness * stress:.6g} {unit}"
        yield f"no cell bears more than {limit}: for loading only, the law of unloading differs"


def friction_facts(table: InterfaceTable, units: str) -> Iterator[str]:
    """Yield the stick slope that a code with a single one takes, and the tangential stiffness over the table."""
    words, (stress, length, *_) = UNIT_SYSTEMS[units]
    metre, _, pascal, *_ = words.split(", ")
    slope, every = stick_slope(table) * stress / length, table.tangential[TANGENTIAL.name] * stress / length
    yield (
        f"friction {table.friction!r}; the stick slope is K_t/A0 = {slope:.6g} {pascal}/{metre} at "
        f"{table.middle_pressure * stress:.6g} {pascal}, the geometric mean of the pressures"
    )
    yield (
        f"a single stick slope belongs to one pressure: in the table K_t/A0, which is K/A0 over E*/G*, goes from "
        f"{every.min():.6g} to {every.max():.6g} {pascal}/{metre}"
    )


def stick_slope(table: InterfaceTable) -> float:
    """Return K_t/A0 [Pa/m] at the geometric mean of the pressures, interpolated by powers."""
    logs = np.log(table.pressure), np.log(table.tangential[TANGENTIAL.name])
    return math.exp(np.interp(math.log(table.middle_pressure), *logs))


def unloaded(table: InterfaceTable, name: str) -> float:
    """Return a conductance without load: that of gas and radiation, as at the lowest load; otherwise 0."""
    if name != _OF_JOINT:
        return 0.0
    return max(float(table.conductances[name][0] - table.conductances[_OF_SPOTS][0]), 0.0)


def _pairs(first: Array, second: Array, start: float = 0.0) -> Iterator[str]:
    """Yield lines of two numbers, those without load first."""
    yield f"{start!r}, 0.0"
    yield from (f"{a!r}, {b!r}" for a, b in zip(first.tolist(), second.tolist(), strict=True))


def _evenly(table: InterfaceTable) -> tuple[Array, Array, Array]:
    """Return evenly spaced gaps with the pressure and the stored energy per area."""
    from scipy.interpolate import PchipInterpolator

    log_pressure = PchipInterpolator(table.gap[::-1], np.log(table.pressure[::-1]))

    def pressure(gap: Array) -> Array:
        line = table.stiffness[0] * (table.zero_gap - gap)
        return np.where(gap > table.gap[0], line, np.exp(log_pressure(np.minimum(gap, table.gap[0]))))

    gaps = np.linspace(table.gap[-1], table.zero_gap, _LINES)
    there = pressure(gaps)
    there[-1] = 0.0
    between = pressure((gaps[1:] + gaps[:-1]) / 2)
    # Simpson's rule on each step; the energy is that of closing the gap from the begin of the force.
    steps = np.diff(gaps) * (there[1:] + 4 * between + there[:-1]) / 6
    return gaps, there, np.append(np.cumsum(steps[::-1])[::-1], 0.0)


def as_comments(lines: Iterable[str], mark: str) -> list[str]:
    """Return remarks as comments in short lines of ASCII characters."""
    plain = (" | ".join(line.splitlines()).encode("ascii", "replace").decode("ascii") for line in lines)
    return [f"{mark} {part}" for line in plain for part in wrap(line, _WIDTH, break_on_hyphens=False)]
