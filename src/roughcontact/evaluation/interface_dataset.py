"""The law of an interface as labelled data."""

from __future__ import annotations

from typing import TYPE_CHECKING

from roughcontact.evaluation.interface_table import InterfaceTable
from roughcontact.halfspace.operators.geometry import Geometry
from roughcontact.labels.contact_columns import INTERFACE
from roughcontact.labels.labelled import variable, variables_of

if TYPE_CHECKING:
    import xarray

__all__ = ["interface_dataset"]


def interface_dataset(table: InterfaceTable) -> xarray.Dataset:
    """Return the law of an interface as an `xarray.Dataset` with units and long names.

    Parameters
    ----------
    table : InterfaceTable

    Returns
    -------
    xarray.Dataset
        One value of each quantity for each load; ``zero_gap`` has no dimension.

    Examples
    --------
    >>> import roughcontact as rc
    >>> surface = rc.examples.surface("ground")
    >>> table = rc.interface_table(rc.loading_curve(surface, 1e11, pressures=[1e7, 3e7, 1e8]))
    >>> table.to_dataset()["mean_gap"].attrs["units"]
    'm'
    """
    import xarray

    names = {
        "nominal_pressure": "pressure",
        "mean_gap": "gap",
        "interfacial_stiffness_per_area": "stiffness",
    }
    data = variables_of(table, INTERFACE, Geometry.SURFACE, names)
    more = table.tangential | table.flow | table.conductances
    data |= {name: variable(name, ("load",), values) for name, values in more.items()}
    low, high = table.validity
    words = {
        "title": "law of a rough interface, per nominal area",
        "validity": f"nominal pressure from {low:.6g} to {high:.6g} Pa",
    }
    return xarray.Dataset(data, attrs={"Conventions": "CF-1.11", **words})
