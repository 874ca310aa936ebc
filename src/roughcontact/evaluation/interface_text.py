"""The law of an interface in the formats of other programs: lines for Abaqus, a table of forces for LAMMPS."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from textwrap import wrap

import numpy as np

from roughcontact.evaluation.interface_table import InterfaceTable
from roughcontact.validation import Array

__all__ = ["UNIT_SYSTEMS", "abaqus_text", "lammps_text"]

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
    """Return a surface interaction for Abaqus: pressure against overclosure, and the conductances of the gap.

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
    zero = f"overclosure 0 is a mean gap of {table.zero_gap * length!r}: bodies meshed in touch carry nothing yet"
    head = [
        f"units: {words}",
        *_facts(table, "Pa" if stress == 1 else "MPa", stress),
        zero,
        "between two lines Abaqus interpolates linearly: at most "
        f"{table.chord_error:.2%} above a pressure that grows exponentially; beyond the last line it is straight",
        *remarks,
    ]
    lines = [*(f"** {line}" for line in _plain(head)), "*SURFACE INTERACTION, NAME=ROUGH"]
    lines.append("*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TABULAR")
    lines += _pairs(table.pressure * stress, table.overclosure * length)
    thermal, electrical = conduction
    for name, keyword in _GAP_CONDUCTANCES:
        if name in table.conductances:
            factor, start = (electrical if "electrical" in name else thermal), 0.0
            if name == _OF_JOINT:  # without load: gas and radiation, as at the lowest load
                start = float(table.conductances[name][0] - table.conductances[_OF_SPOTS][0])
            numbers = (table.conductances[name] * factor, table.pressure * stress)
            lines += [keyword, *_pairs(*numbers, max(start, 0.0) * factor)]
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
        *_facts(table, "Pa", 1.0),
        f"force and energy of a nominal area of {table.area!r} m2 (r, energy, force in m, J, N)",
        f"r is the mean gap; the force begins at {table.zero_gap!r} m",
        f"the table ends at {float(gap[0])!r} m: LAMMPS stops where a wall comes nearer",
        f"fix ID group wall/table linear {len(gap)} zlo POSITION FILE INTERFACE {table.zero_gap!r}",
        *remarks,
    ]
    rows = zip(gap.tolist(), (table.area * energy).tolist(), (table.area * pressure).tolist(), strict=True)
    lines = [*(f"# {line}" for line in _plain(head)), "", "INTERFACE", f"N {len(gap)}", ""]
    lines += [f"{k} {r!r} {e!r} {f!r}" for k, (r, e, f) in enumerate(rows, start=1)]
    return "\n".join(lines) + "\n"


def _facts(table: InterfaceTable, unit: str, stress: float) -> Iterator[str]:
    """Yield the facts that users of a table need, with pressures in `unit`; a pascal is `stress` of it."""
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


def _plain(lines: Iterable[str]) -> Iterator[str]:
    """Yield remarks in short lines of ASCII characters."""
    for line in lines:
        plain = " | ".join(line.splitlines()).encode("ascii", "replace").decode("ascii")
        yield from wrap(plain, _WIDTH, break_on_hyphens=False)
