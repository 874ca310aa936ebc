"""The current or heat through a contact as labelled data: maps, spots and numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from roughcontact.evaluation.contact_flux import ContactFlux
from roughcontact.labels.flux_columns import FLUX, FLUX_NAMES
from roughcontact.labels.labelled import centres, dataframe_of, dataset_of, variables_of

if TYPE_CHECKING:
    import pandas
    import xarray

__all__ = ["flux_dataframe", "flux_dataset"]


def flux_dataset(flux: ContactFlux) -> xarray.Dataset:
    """Return the current or heat as a dataset: the density as a map, a value of each spot along ``spot``.

    This computes `resistances_alone`, with a solve for each spot.

    Parameters
    ----------
    flux : ContactFlux

    Returns
    -------
    xarray.Dataset
        Variables with units and long names. For a current: ``current_density``, ``spot_current``, ``spot_share``,
        ``spot_resistance``, ``spot_resistance_alone``, ``spot_resistance_holm``, ``current`` and ``voltage``. For heat:
        ``heat_flux``, ``spot_heat_flow``, ``spot_thermal_resistance`` and so on.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> dataset = rc.contact_flux(solution, conductivities=(400.0, 50.0), drop=10.0).to_dataset()
    >>> dataset["heat_flux"].dims, dataset["spot_thermal_resistance"].attrs["units"]
    (('y', 'x'), 'K W-1')
    """
    kind, problem = flux.solution.problem.geometry, flux.solution.problem
    spot = (("spot",), np.arange(1, flux.spots.count + 1), {"long_name": "number of the spot"})
    title = f"flux through a contact of rough surfaces; the drop lies across the {flux.of}"
    data = variables_of(flux, FLUX[flux.kind], kind, FLUX_NAMES)
    return dataset_of(data, centres(problem.grid, kind) | {"spot": spot}, title, kind)


def flux_dataframe(flux: ContactFlux) -> pandas.DataFrame:
    """Return the spots as a table of pandas: one row for each spot, in SI units.

    Parameters
    ----------
    flux : ContactFlux

    Returns
    -------
    DataFrame
        The columns of `to_dataset` along ``spot``; ``attrs["units"]`` holds the unit of each.

    Examples
    --------
    >>> import roughcontact as rc
    >>> solution = rc.press(rc.shapes.paraboloid(rc.Grid((32, 32), 1e-6), radius=1e-4), 1e9, force=1e-3)
    >>> frame = rc.contact_flux(solution, resistivities=(1.7e-8, 1.7e-8)).to_dataframe()
    >>> frame["spot_share"].tolist(), frame.attrs["units"]["spot_resistance"]
    ([1.0], 'ohm')
    """
    return dataframe_of(flux_dataset(flux), "spot")
