"""One table of every quantity that leaves the library: its unit, its name in words, its name in a picture.

Datasets, files and pictures take units and names from here and from nowhere else.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType

from roughcontact.halfspace.operators.geometry import Geometry

__all__ = ["VARIABLES", "Variable", "unit_of"]


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
        The quantity on the axis of a picture, without its unit.
    """

    unit: str
    long_name: str
    label: str


VARIABLES: Mapping[str, Variable] = MappingProxyType(
    {
        # control and answer
        "force": Variable("N", "normal force", "force"),
        "depth": Variable("m", "approach of the bodies since first touch", "depth"),
        "stiffness": Variable(
            "N m-1", "normal stiffness dF/dd of the contact region held fixed", "stiffness"
        ),
        "interfacial_stiffness": Variable(
            "N m-1",
            "normal stiffness against the mean gap, contact region held fixed",
            "interfacial stiffness",
        ),
        "secant_stiffness": Variable(
            "N m-1",
            "difference of force over difference of depth between one load and the next",
            "secant stiffness",
        ),
        "contact_area": Variable("m2", "real contact area", "contact area"),
        "contact_fraction": Variable("1", "real contact area over nominal area", "contact fraction"),
        "mean_gap": Variable("m", "gap averaged over the measured cells", "mean gap"),
        "elastic_energy": Variable("J", "elastic energy of the bodies", "elastic energy"),
        "spots": Variable("1", "number of connected contact spots", "contact spots"),
        "dimensionless_force": Variable("1", "force over modulus, length and rms height", "force / (E* L h)"),
        "dimensionless_stiffness": Variable("1", "stiffness over modulus and length", "stiffness / (E* L)"),
        # tangential loading
        "tangential_force": Variable(
            "N", "tangential force that body 2 exerts upon body 1", "tangential force"
        ),
        "tangential_displacement": Variable(
            "m", "tangential displacement of body 2 against body 1 since the start", "tangential displacement"
        ),
        "tangential_stiffness": Variable(
            "N m-1",
            "tangential force per displacement of the cells that hold, moved as one",
            "tangential stiffness",
        ),
        "stick_area": Variable("m2", "area of the cells in contact that hold", "stick area"),
        "slip_area": Variable("m2", "area of the cells in contact that slip", "slip area"),
        "dissipated": Variable("J", "energy that friction took in the step", "dissipated in a step"),
        "dissipated_energy": Variable(
            "J", "energy that friction has taken since the start", "dissipated energy"
        ),
        "tangential_elastic_energy": Variable(
            "J", "elastic energy of the tangential displacement", "tangential elastic energy"
        ),
        "friction": Variable("1", "coefficient of friction", "friction coefficient"),
        "capacity": Variable("N", "largest tangential force that friction holds", "capacity"),
        # what it conducts
        "electrical_conductance": Variable("S", "electrical conductance of the contact", "conductance"),
        "electrical_resistance": Variable("ohm", "electrical resistance of the contact", "resistance"),
        "thermal_conductance": Variable("W K-1", "thermal conductance of the contact", "thermal conductance"),
        "thermal_resistance": Variable("K W-1", "thermal resistance of the contact", "thermal resistance"),
        # how far the answer can be trusted
        "residual": Variable(
            "1", "violation of the contact conditions, recomputed on the answer", "residual"
        ),
        "stiffness_residual": Variable(
            "1", "residual of the linear problem of the stiffness", "stiffness residual"
        ),
        "resolved": Variable(
            "", "contact stands above twenty cells and below the full-contact stiffness", "resolved"
        ),
        "status": Variable("", "how the solver ended", "status"),
        "steps": Variable("1", "steps of the solver", "steps"),
        "missing": Variable("1", "number of cells without a height; they never touch", "missing cells"),
        "touches_edge": Variable("", "contact reaches the edge of the map", "contact at the edge"),
        # scales
        "modulus": Variable("Pa", "reduced modulus E* of the pair of solids", "reduced modulus"),
        "hardness": Variable("Pa", "pressure that no cell exceeds", "hardness"),
        "rms": Variable("m", "root mean square height about the mean", "rms height"),
        "full_contact_stiffness": Variable(
            "N m-1", "stiffness with every measured cell in contact", "full-contact stiffness"
        ),
        "cell_stiffness": Variable("N m-1", "stiffness with one cell in contact", "one cell"),
        "lengths": Variable("m", "side lengths of the map, cells times spacing", "length"),
        "spacing": Variable("m", "size of a cell", "spacing"),
        "nominal_area": Variable("m2", "area of all cells", "nominal area"),
        "shape": Variable("1", "number of cells", "cells"),
        "periodic": Variable("", "whether the surface repeats itself", "periodic"),
        # maps
        "x": Variable("m", "position along the rows of the picture, centre of the cell", "x"),
        "y": Variable("m", "position down the picture from its top, centre of the cell", "y"),
        "r": Variable("m", "distance from the axis, mean radius of the ring", "r"),
        "heights": Variable("m", "height of the surface, positive toward the other body", "height"),
        "pressure": Variable("Pa", "contact pressure", "pressure"),
        "displacement": Variable("m", "normal displacement of the half-space", "displacement"),
        "gap": Variable("m", "gap between the bodies", "gap"),
        "contact": Variable("", "whether the cell is in contact", "contact"),
        "traction": Variable("Pa", "tangential traction upon body 1", "traction"),
        "slip": Variable("m", "slip of surface 1 over surface 2 since the start", "slip"),
        "slipping": Variable("", "whether the cell bears all the traction that friction holds", "slipping"),
        "largest_pressure": Variable("Pa", "largest contact pressure of a cell", "largest pressure"),
        "nominal_pressure": Variable("Pa", "force over the area of the whole map", "nominal pressure"),
        "spot_label": Variable(
            "1", "number of the contact spot a cell belongs to, 0 outside contact", "spot"
        ),
        "spot_area": Variable("m2", "area of a contact spot", "spot area"),
        "spot_load": Variable("N", "force carried by a contact spot", "spot load"),
    }
)

# On a line all that adds up over the contact is per unit length.
_OF_A_LINE = {
    "force": "N m-1",
    "stiffness": "N m-2",
    "interfacial_stiffness": "N m-2",
    "secant_stiffness": "N m-2",
    "full_contact_stiffness": "N m-2",
    "cell_stiffness": "N m-2",
    "contact_area": "m",
    "nominal_area": "m",
    "spot_area": "m",
    "spot_load": "N m-1",
    "elastic_energy": "J m-1",
}
# Springs feel a force per length, and touch over a length.
_OF_SPRINGS = {
    "pressure": "N m-1",
    "largest_pressure": "N m-1",
    "nominal_pressure": "N m-1",
    "hardness": "N m-1",
    "contact_area": "m",
    "nominal_area": "m",
    "spot_area": "m",
}


def unit_of(name: str, geometry: Geometry = Geometry.SURFACE) -> str:
    """Return the unit of a quantity in a geometry."""
    others = {Geometry.LINE: _OF_A_LINE, Geometry.FOUNDATION: _OF_SPRINGS}.get(geometry, {})
    return others.get(name, VARIABLES[name].unit)
