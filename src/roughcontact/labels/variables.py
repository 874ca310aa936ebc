"""One table of every quantity that leaves the library: its unit, its name in words, its name in a picture.

Datasets, files and pictures take units and names from here and from nowhere else.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import Any

from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.halfspace.operators.operator import geometry_of

__all__ = [
    *("CONDUCTION", "CONDUCTION_PER_AREA", "CURVE_POINTS", "CURVE_SCALES", "FLOW_POINTS"),
    *("VARIABLES", "Variable", "force_unit", "unit_of"),
]

# What a curve takes over from each state, and what it is measured by.
CURVE_POINTS = (
    *("force", "depth", "stiffness", "interfacial_stiffness"),
    *("contact_area", "mean_gap", "elastic_energy"),
)
# What it takes over besides where a hardness limits the pressure.
FLOW_POINTS = (
    *("plastic_area", "flow_volume", "flow_energy"),
    *("unloading_stiffness", "unloading_interfacial_stiffness"),
)
# What it conducts, as a patch and over its nominal area.
CONDUCTION = ("electrical_conductance", "electrical_resistance", "thermal_conductance", "thermal_resistance")
CONDUCTION_PER_AREA = tuple(f"{name}_per_area" for name in CONDUCTION)
CURVE_SCALES = ("modulus", "rms", "full_contact_stiffness", "cell_stiffness", "nominal_area")


@dataclass(frozen=True, slots=True)
class Variable:
    """What is said about one quantity wherever it appears.

    Parameters
    ----------
    unit : str
        Unit in UDUNITS style, as the CF conventions want it: ``"N m-1"``; ``"1"`` for a pure number.
        Empty for words.
    long_name : str
        The quantity in words, complete enough to stand alone in a file.
    label : str
        The quantity on the axis of a picture, without its unit; by default its name.
    """

    unit: str
    long_name: str
    label: str = ""


_VARIABLES = {
    # control and answer
    "force": Variable("N", "normal force"),
    "depth": Variable("m", "approach of the bodies since first touch"),
    "stiffness": Variable("N m-1", "normal stiffness dF/dd of the contact region held fixed"),
    "interfacial_stiffness": Variable(
        "N m-1", "normal stiffness against the mean gap, contact region held fixed"
    ),
    "interfacial_stiffness_per_area": Variable(
        "Pa m-1", "interfacial stiffness over the nominal area", "interfacial stiffness per area K/A0"
    ),
    "secant_stiffness": Variable(
        "N m-1", "difference of force over difference of depth between one load and the next"
    ),
    "contact_area": Variable("m2", "real contact area"),
    "contact_fraction": Variable(
        "1", "relative real contact area, real over nominal", "relative real contact area A/A0"
    ),
    "corrected_contact_area": Variable(
        "m2", "real contact area, corrected for the perimeter of its cells", "contact area, corrected"
    ),
    "corrected_contact_fraction": Variable(
        "1", "relative real contact area, corrected for the perimeter of its cells", "A/A0, corrected"
    ),
    "mean_gap": Variable("m", "gap averaged over the measured cells"),
    "overclosure": Variable("m", "closing of the mean gap from where the pressure of the table begins"),
    "zero_gap": Variable("m", "mean gap at which the pressure of the table begins"),
    "elastic_energy": Variable("J", "elastic energy of the bodies"),
    "spots": Variable("1", "number of connected contact spots", "contact spots"),
    "dimensionless_force": Variable("1", "force over modulus, length and rms height", "force / (E* L h)"),
    "dimensionless_stiffness": Variable("1", "stiffness over modulus and length", "stiffness / (E* L)"),
    # plastic flow
    "plastic_area": Variable("m2", "area of the cells whose pressure is the hardness"),
    "flow_depth": Variable("m", "depth by which the surface has flowed", "depth of flow"),
    "flow_volume": Variable("m3", "volume that has flowed", "volume of flow"),
    "flow_energy": Variable("J", "work that first loading spent on flow", "energy of flow"),
    "flow_rise": Variable("m", "rise of the whole surface by what has flowed", "rise"),
    "unloading_stiffness": Variable(
        "N m-1", "normal stiffness dF/dd as the load is reduced, contact region held fixed"
    ),
    "unloading_interfacial_stiffness": Variable(
        "N m-1", "normal stiffness against the mean gap as the load is reduced, contact region held fixed"
    ),
    "flattened_heights": Variable("m", "height of the surface after flow, positive toward the other body"),
    "residual_depth": Variable("m", "approach at which the flattened surface is touched without force"),
    "residual_gap": Variable("m", "mean gap of the flattened surface that is touched without force"),
    "branch": Variable("", "branch of the loop: first loading, unloading or reloading"),
    "work": Variable("J", "work of first loading up to the largest load"),
    "dissipated_work": Variable("J", "work of loading that unloading does not give back"),
    # adhesion
    "work_of_adhesion": Variable("J m-2", "work of adhesion, to part a unit area", "work of adhesion w"),
    "adhesion_range": Variable("m", "length over which the attraction falls", "range of the attraction"),
    "allow_unresolved": Variable("", "whether an attraction that varies from cell to cell was allowed"),
    "unresolved": Variable("", "attraction varies from cell to cell: states are those of the lattice"),
    "adhesive_energy": Variable("J", "energy of the adhesion"),
    "energy": Variable("J", "elastic and adhesive energy; its slope with the depth is the force"),
    "contact_stiffness": Variable(
        "N m-1", "slope of the force with the depth, contact and attraction held fixed"
    ),
    "stability": Variable(
        "1", "smallest eigenvalue found of the Hessian over that without attraction, as it is controlled"
    ),
    "stability_residual": Variable(
        "1", "residual of the eigenvector of the stability: some eigenvalue lies within it of the stability"
    ),
    "attracted": Variable("", "whether the cell is apart from the wall by no more than the range"),
    "largest_tension": Variable("Pa", "largest tension of a cell"),
    "lowest_force": Variable(
        "N", "lowest force since the body is drawn back, between the loads and in jumps"
    ),
    "pull_off_force": Variable("N", "largest tension of the retreat, between the loads and in jumps"),
    "jump_in_force": Variable(
        "N", "tension from which the body first jumped on the approach, negative where it was pressed"
    ),
    "lost_energy": Variable("J", "energy lost in all jumps", "energy lost"),
    "jumped": Variable("1", "load, counted from 0, that the jump came on the way to"),
    "jump_depth": Variable("m", "last depth of the branch that ends"),
    "jump_depth_after": Variable("m", "depth after the jump"),
    "jump_force_before": Variable("N", "force before the jump"),
    "jump_force_after": Variable("N", "force after the jump"),
    "jump_depth_bracket": Variable("m", "depth between the last state of the branch and the first beyond it"),
    "jump_force_bracket": Variable("N", "force between the last state of the branch and the first beyond it"),
    "jump_lost": Variable("J", "energy lost in the jump"),
    "jump_approach": Variable("", "whether the depth or the force was growing"),
    "jump_ambiguous": Variable("", "whether two integrations of the flow after the jump end apart"),
    # detachment of stuck surfaces
    "detached_at": Variable("1", "load, counted from 0, that the detachment came on the way to"),
    "detachment_depth": Variable("m", "depth at which cells let go"),
    "detachment_depth_after": Variable("m", "depth after cells let go"),
    "detachment_force_before": Variable("N", "force before cells let go"),
    "detachment_force_after": Variable("N", "force after cells let go"),
    "detachment_cells": Variable("1", "number of cells that let go"),
    "detachment_lost": Variable("J", "elastic energy set free less the work of adhesion"),
    "lowest_force_area": Variable("m2", "area in contact under the lowest force"),
    "preload_too_small": Variable("", "whether a larger preload may raise the pull-off force"),
    # tangential loading
    "tangential_force": Variable("N", "tangential force that body 2 exerts upon body 1"),
    "tangential_displacement": Variable(
        "m", "tangential displacement of body 2 against body 1 since the start"
    ),
    "tangential_stiffness": Variable(
        "N m-1", "tangential force per displacement of the cells that hold, moved as one"
    ),
    "stick_area": Variable("m2", "area of the cells in contact that hold"),
    "slip_area": Variable("m2", "area of the cells in contact that slip"),
    "dissipated": Variable("J", "energy that friction took in the step", "dissipated in a step"),
    "dissipated_energy": Variable("J", "energy that friction has taken since the start"),
    "tangential_elastic_energy": Variable("J", "elastic energy of the tangential displacement"),
    "friction": Variable("1", "coefficient of friction", "friction coefficient"),
    "capacity": Variable("N", "largest tangential force that friction holds"),
    # what it conducts
    "electrical_conductance": Variable("S", "electrical conductance of the contact", "conductance"),
    "electrical_resistance": Variable("ohm", "electrical resistance of the contact", "resistance"),
    "thermal_conductance": Variable("W K-1", "thermal conductance of the contact"),
    "thermal_resistance": Variable("K W-1", "thermal resistance of the contact"),
    "electrical_conductance_per_area": Variable("S m-2", "electrical conductance over the nominal area"),
    "electrical_resistance_per_area": Variable("m2 ohm", "electrical resistance times the nominal area"),
    "thermal_conductance_per_area": Variable(
        "W m-2 K-1", "thermal conductance over the nominal area", "thermal conductance per area h_c"
    ),
    "thermal_resistance_per_area": Variable("m2 K W-1", "thermal resistance times the nominal area"),
    # how far the answer can be trusted
    "residual": Variable("1", "violation of the contact conditions, recomputed on the answer"),
    "stiffness_residual": Variable("1", "residual of the linear problem of the stiffness"),
    "resolved": Variable("", "contact stands above twenty cells and below the full-contact stiffness"),
    "status": Variable("", "how the solver ended"),
    "steps": Variable("1", "steps of the solver"),
    "missing": Variable("1", "number of cells without a height; they never touch", "missing cells"),
    "touches_edge": Variable("", "contact reaches the edge of the map", "contact at the edge"),
    # scales
    "modulus": Variable("Pa", "reduced modulus E* of the pair of solids", "reduced modulus"),
    "hardness": Variable("Pa", "pressure that no cell exceeds"),
    "rms": Variable("m", "root mean square height about the mean", "rms height"),
    "full_contact_stiffness": Variable(
        "N m-1", "stiffness with every measured cell in contact", "full-contact stiffness"
    ),
    "cell_stiffness": Variable("N m-1", "stiffness with one cell in contact", "one cell"),
    "lengths": Variable("m", "side lengths of the map, cells times spacing", "length"),
    "spacing": Variable("m", "size of a cell"),
    "nominal_area": Variable("m2", "area of all cells"),
    "shape": Variable("1", "number of cells", "cells"),
    "periodic": Variable("", "whether the surface repeats itself"),
    # maps
    "x": Variable("m", "position along the rows of the picture, centre of the cell"),
    "y": Variable("m", "position down the picture from its top, centre of the cell"),
    "r": Variable("m", "distance from the axis, mean radius of the ring"),
    "heights": Variable("m", "height of the surface, positive toward the other body", "height"),
    "pressure": Variable("Pa", "contact pressure"),
    "displacement": Variable("m", "normal displacement of the half-space"),
    "gap": Variable("m", "gap between the bodies"),
    "contact": Variable("", "whether the cell is in contact"),
    "traction": Variable("Pa", "tangential traction upon body 1"),
    "slip": Variable("m", "slip of surface 1 over surface 2 since the start"),
    "slipping": Variable("", "whether the cell bears all the traction that friction holds"),
    "largest_pressure": Variable("Pa", "largest contact pressure of a cell"),
    "nominal_pressure": Variable("Pa", "force over the nominal area"),
    "spot_label": Variable("1", "number of the contact spot a cell belongs to, 0 outside contact", "spot"),
    "spot_area": Variable("m2", "area of a contact spot"),
    "spot_load": Variable("N", "force carried by a contact spot"),
}
VARIABLES: Mapping[str, Variable] = MappingProxyType(
    {
        name: each if each.label else replace(each, label=name.replace("_", " "))
        for name, each in _VARIABLES.items()
    }
)

# On a line all that adds up over the contact is per unit length.
_ON_A_LINE = {"N": "N m-1", "N m-1": "N m-2", "m2": "m", "m3": "m2", "J": "J m-1"}
# Springs feel a force per length, and touch over a length; their modulus stays a pressure.
_ON_SPRINGS = {"Pa": "N m-1", "m2": "m", "m3": "m2", "Pa m-1": "N m-2"}


def unit_of(name: str, geometry: Geometry = Geometry.SURFACE) -> str:
    """Return the unit of a quantity in a geometry."""
    unit = VARIABLES[name].unit
    if geometry is Geometry.LINE:
        return _ON_A_LINE.get(unit, unit)
    if geometry is Geometry.FOUNDATION and name != "modulus":
        return _ON_SPRINGS.get(unit, unit)
    return unit


def force_unit(arguments: Mapping[str, Any]) -> str:
    """Return the unit of the forces among the arguments of a function or method: per length along a line."""
    operator = arguments.get("operator")
    geometry = Geometry.SURFACE if operator is None else geometry_of(operator)
    return unit_of("force", getattr(arguments.get("self"), "geometry", geometry))
